"""What a file of a form is called, as browsers and other programs write it."""

import re
from urllib.parse import unquote_to_bytes

MAX_CHARACTERS = 255
"""No file system in use has longer names."""
ENCODED = {"%22": '"', "%0D": "\r", "%0A": "\n"}
"""What browsers encode in a name, and all that they do: ``100%25.mid`` is a file's own name (WHATWG HTML,
multipart/form-data encoding algorithm)."""
_ENCODED = re.compile("|".join(ENCODED))
_EXTENDED = re.compile(rb""";\s*filename\*\s*=\s*["']?[\w-]+'[^';]*'([^;"\s]+)""", re.IGNORECASE)
_DRIVE = re.compile(r"([A-Za-z]:|\\)\\.*")
_CONTROLS = re.compile(r"[\x00-\x1f\x7f-\x9f]")


def filename_of(plain: bytes | None, disposition: bytes = b"") -> str | None:
    """The name of a file as a person reads it.

    Args:
        plain: The parameter `filename` of the part's `Content-Disposition`, without its quotes.
        disposition: The whole header. Its `filename*` has no place in a form (RFC 7578, 4.2), but some
            programs send nothing else: it is read where there is no `filename`.

    Returns:
        The last part of a path, on one line; None when there is no name.
    """
    if plain:
        name = _ENCODED.sub(lambda match: ENCODED[match[0]], _text(plain))
    elif extended := _EXTENDED.search(disposition):
        name = _text(unquote_to_bytes(extended[1]))
    else:
        return None
    name = name.rsplit("/", 1)[-1]
    # Elsewhere than after a drive or a host a backslash is a character as any other.
    if _DRIVE.fullmatch(name):
        name = name.rsplit("\\", 1)[-1]
    name = _CONTROLS.sub("", " ".join(name.split())).strip()
    if len(name) > MAX_CHARACTERS:
        stem, dot, ending = name.rpartition(".")
        kept = f"{dot}{ending}" if stem and len(ending) < 8 else ""
        name = name[: MAX_CHARACTERS - len(kept)] + kept
    return name or None


def _text(data: bytes) -> str:
    """UTF-8, or what old programs send in its place."""
    try:
        return data.decode()
    except UnicodeDecodeError:
        return data.decode("latin-1")
