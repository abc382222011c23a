"""Which character set the texts of a MIDI file are in, which the file nowhere declares."""

import re
import unicodedata
from collections import Counter
from collections.abc import Iterable
from functools import cache
from itertools import islice

from reina.music.instrument_names import spellings
from reina.music.midi.languages import DOUBLE_BYTE, languages
from reina.music.midi.spelling import spelling_likelihood
from reina.music.midi.unicode_text import decode_unicode, decode_whole, without_end

MAX_TEXTS, SAMPLE_BYTES = 1000, 1024
"""How many texts beyond ASCII are looked at, and how much of them is examined."""

STRANGE, TOO_SHORT = -4.3, 8
"""Texts of a lower log-likelihood a byte than this are in no set of languages.toml; of fewer bytes
beyond ASCII than that one cannot tell."""

RARE = ("euc_jp", "koi8_r", "cp866", "iso8859_5", "cp1256")
"""Character sets that charset-normalizer is asked about then."""

CUT = -8.0
"""Each byte of a character that is cut off at a text's end."""

INSTRUMENT = 5.0
"""What an instrument's name adds."""

_WORD = re.compile(r"[^\W\d_]+(?:’[^\W\d_]+)*")


def decide_encoding(texts: Iterable[bytes]) -> str:
    """Tell the character set of a file's texts by what they would say in each.

    The log-likelihoods of the characters in each language of a set (`Language`), of the places of its letters
    (`spelling_likelihood`) and of instruments' names are added; the highest sum counts.

    Args:
        texts: The texts of one file, those first that matter most.

    Returns:
        Python's name of the character set; ``"utf-8"`` if all texts are in Unicode.
    """
    sample = _sample(texts)
    if not sample:
        return "utf-8"
    likelihood, encoding = max((_likelihood(sample, encoding), encoding) for encoding in languages())
    beyond_ascii = sum(byte > 0x7F for data in sample for byte in data)
    if beyond_ascii >= TOO_SHORT and likelihood < STRANGE * sum(map(len, sample)):
        return _rare_encoding(sample) or encoding
    return encoding


def _rare_encoding(sample: list[bytes]) -> str | None:
    from charset_normalizer import from_bytes  # It takes 25 ms to import, and few files need it.

    best = from_bytes(b"\n".join(sample), cp_isolation=list(RARE), enable_fallback=False).best()
    return best.encoding if best else None


def _sample(texts: Iterable[bytes]) -> list[bytes]:
    """Return different texts in no Unicode form, `SAMPLE_BYTES` at most."""
    sample: dict[bytes, None] = {}
    left = SAMPLE_BYTES
    for data in islice((data for data in texts if not data.isascii()), MAX_TEXTS):
        text = without_end(data)[:left]
        if text in sample or decode_unicode(text) is not None:
            continue
        sample[text] = None
        left -= len(text)
        if left <= 0:
            break
    return list(sample)


def _likelihood(sample: list[bytes], encoding: str) -> float:
    decoded = [decode_whole(data, encoding) for data in sample]
    texts = [text for text, _ in decoded]
    counts = Counter("".join(texts))
    plain = unicodedata.normalize("NFKC", "\n".join(texts)) if encoding in DOUBLE_BYTE else "\n".join(texts)
    words = {word.casefold() for word in _WORD.findall(plain) if not word.isascii()}
    total = CUT * sum(cut for _, cut in decoded)
    if encoding not in DOUBLE_BYTE:
        total += spelling_likelihood(texts)
    total += INSTRUMENT * _instruments(words, anywhere=encoding in DOUBLE_BYTE)
    return total + max(language.likelihood(counts, words) for language in languages()[encoding])


def _instruments(words: Iterable[str], *, anywhere: bool) -> int:
    """Return how many of the words begin with an instrument's name, or hold one if `anywhere`."""
    names, whole, longest = _names()
    found = 0
    for word in words:
        starts = range(len(word)) if anywhere else range(1)
        found += word in whole or any(
            word[start:end] in names for start in starts for end in range(start + 2, start + longest + 1)
        )
    return found


@cache
def _names() -> tuple[frozenset[str], frozenset[str], int]:
    """Return instruments' names beyond ASCII: beginnings of words, whole words, and the longest's length."""
    names = [name.casefold() for of_one in spellings().values() for name in of_one if not name.isascii()]
    beginnings = frozenset(name for name in names if not name.endswith(".") and len(name) > 1)
    whole = frozenset(name[:-1] for name in names if name.endswith(".") and len(name) > 2)
    return beginnings, whole, max(map(len, names))
