"""What is said of a value that a model refuses: what was wrong with it, and what would be right."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

from reina.curves.shown import shown
from reina.curves.value_types import LARGEST

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails

_NO_NUMBER = "{given} is no number; write a finite number, as 0.5"
_NO_LIST = "{given} is no list; a list is needed here"
_NO_OBJECT = "it is a JSON object, not {type}"
_NO_TEXT = "a text in quotes is needed here"

_WORDS: Mapping[str, str] = {
    "missing": "it is missing",
    "finite_number": _NO_NUMBER,
    "none_required": "what only steps has no slopes; leave them out",
    "int_type": "{given} is no whole number; it is 1, 2, 3 and so on",
    "bool_type": "{given} is neither true nor false",
    "tuple_type": _NO_LIST,
    "list_type": _NO_LIST,
    "dict_type": _NO_OBJECT,
    "model_type": _NO_OBJECT,
    "string_type": _NO_TEXT,
    "string_unicode": "half a character (a lone surrogate) is no text",
    "string_too_short": "one character at least is needed here",
    "string_pattern_mismatch": "a key has 1 to 64 letters, digits, - and _",
}


def _too_short(_: "ErrorDetails", context: Mapping[str, Any]) -> str:
    if context["min_length"] == 1:
        return "a list of one value at least is needed here"
    return f"{context['actual_length']} numbers are given where {context['min_length']} are needed"


def _too_long(fault: "ErrorDetails", context: Mapping[str, Any]) -> str:
    given = fault["input"]
    count = len(cast("Sequence[object]", given)) if isinstance(given, list | tuple) else "more"
    return f"{count} numbers are given where {context['max_length']} are needed"


_SPECIAL: Mapping[str, Callable[["ErrorDetails", Mapping[str, Any]], str]] = {
    "float_type": lambda fault, _: (
        f"{shown(fault['input'])} is too large; numbers lie within ±{LARGEST:g}"
        if isinstance(fault["input"], int) and not isinstance(fault["input"], bool)
        else _NO_NUMBER.format(given=shown(fault["input"]))
    ),
    "too_short": _too_short,
    "too_long": _too_long,
    "literal_error": lambda fault, context: (
        f"{shown(fault['input'])} is none of {context['expected'].replace(' or ', ', ').replace(chr(39), '')}"
    ),
    "value_error": lambda _, context: str(context["error"]),
}


_HINTS: Mapping[int | str, str] = {
    "<linear>": "; a colour is #RRGGBB or three linear components in 0..1",
}
"""What is said besides where a fault lies within something."""


def _bounded(fault: "ErrorDetails", bound: float, words: str) -> str:
    if abs(bound) >= LARGEST:
        return f"{shown(fault['input'])} is too large; numbers lie within ±{LARGEST:g}"
    return f"{shown(fault['input'])} is out of range; it is {words} {bound:g}"


def fault_words(fault: "ErrorDetails", unit: str = "") -> str:
    """What is said of one fault that pydantic found.

    Args:
        fault: As `ValidationError.errors` gives it.
        unit: The unit of numbers, for their bounds.
    """
    hint = next((_HINTS[part] for part in fault["loc"] if part in _HINTS), "")
    return _said(fault, unit) + hint


def _said(fault: "ErrorDetails", unit: str) -> str:
    context = fault.get("ctx", {})
    special = _SPECIAL.get(fault["type"])
    if special is not None:
        return special(fault, context)
    for name, words in (("ge", "at least"), ("le", "at most")):
        if name in context:
            return _bounded(fault, context[name], words) + (f" {unit}" if unit else "")
    words = _WORDS.get(fault["type"], fault["msg"])
    given = fault["input"]
    return words.format(given=shown(given), type=type(given).__name__)
