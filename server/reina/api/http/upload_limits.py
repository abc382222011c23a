"""How large an upload and its parts may be."""

MEGABYTE = 1_000_000

FILE_LIMITS = {"score": 20 * MEGABYTE, "song": 200 * MEGABYTE, "show": 20 * MEGABYTE}
"""Bytes, by the part's name."""
FIELD_LIMITS = {
    "title": 1000,
    "public": 5,
    "part": 10,
    "transposition": 10,
    "written": 5,
    "octave_fit": 5,
    "joined_parts": 10_000,
    "usual_fingerings": 5,
    "sequence": 10,
    "player": 200,
    "handedness": 10,
    "in_time": 5,
    "cast": 20_000,
}
LIMITS = FILE_LIMITS | FIELD_LIMITS
MAX_BYTES = sum(LIMITS.values()) + MEGABYTE
"""Of a whole form, with what stands between its parts."""
