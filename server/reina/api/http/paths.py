"""Parts of addresses that are more than one segment."""

from starlette.convertors import PathConvertor, register_url_convertor


class TrackPathConvertor(PathConvertor):
    """A parameter's path; what stands below its keyframes is none."""

    regex = "(?:(?!/keyframes(?:/|$)).)+"


register_url_convertor("track_path", TrackPathConvertor())

TRACK = "/sessions/{session_id}/show/tracks/{path:track_path}"
