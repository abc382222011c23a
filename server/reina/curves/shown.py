"""Values and names of a show as messages quote them: whatever was sent, in few words."""

import reprlib

LONGEST = 60
"""Characters of a value, a name or a path that are quoted."""

_quoting = reprlib.Repr()
_quoting.maxlevel = 4
_quoting.maxlist = _quoting.maxtuple = _quoting.maxdict = 8
_quoting.maxstring = _quoting.maxlong = _quoting.maxother = LONGEST


def shown(value: object) -> str:
    """A value of JSON as Python writes it, shortened where it is long, and never deep enough to fail."""
    return shortened(_quoting.repr(value))


def shortened(text: str) -> str:
    """A text, cut where it is long."""
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"
