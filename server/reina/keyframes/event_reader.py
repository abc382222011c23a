"""Reads what a track does at events from JSON, and writes it."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, cast

from reina.keyframes.event_response import BLENDS, EventResponse, NoteFilter
from reina.keyframes.parameter import Parameter
from reina.keyframes.place import Json, Place
from reina.keyframes.triggers import OCCASIONS
from reina.keyframes.value_types import parse_number, parse_numbers, value_items

EVENT_FIELDS = tuple(field.name for field in fields(EventResponse))
FILTER_FIELDS = tuple(field.name for field in fields(NoteFilter))


def read_events(document: object, parameter: Parameter) -> EventResponse:
    """Read the ``events`` of a parameter's track.

    Raises:
        ShowError: A field is not as it should be.
    """
    place = Place(parameter.path)
    if not isinstance(document, Mapping):
        raise place.error(f"it is a JSON object, not {type(document).__name__}", "events")
    given = place.fields(cast("Json", document), EVENT_FIELDS, what="what a track does at events")
    if ("amount" in given) == ("cycle" in given):
        raise place.error("it has either an amount, for a swell, or a cycle of values", "events")
    on = place.choice(given, "on", OCCASIONS)
    if on != "notes" and ("where" in given or "by_velocity" in given):
        raise place.error(f"only notes are told apart; {on} have neither where nor by_velocity", "on")
    blend = place.choice(given, "blend", BLENDS, "replace")
    if blend != "replace" and parameter.type not in ("number", "vector", "color"):
        raise place.error(f"a {parameter.type} can only be replaced", "blend")
    read: dict[str, Any] = {"on": on, "blend": blend, "by_velocity": place.flag(given, "by_velocity")}
    field = ""
    try:
        for field in ("attack", "hold", "decay"):
            read[field] = _length(given.get(field, 0.0))
        field = "every"
        read[field] = _count(given.get(field, 1))
        field = "where"
        read[field] = _read_filter(given.get(field, {}), place)
        field = "amount"
        if field in given:
            read[field] = _read_amount(given[field], parameter, blend)
        field = "cycle"
        if field in given:
            items = value_items(given[field])
            if not items:
                raise ValueError("a list of one value at least is needed here")  # noqa: TRY301
            read[field] = tuple(parameter.parse(item) for item in items)
    except ValueError as error:
        raise place.error(str(error), f"events/{field}") from None
    if read.get("amount") is not None and not read["attack"] + read["hold"] + read["decay"] > 0.0:
        raise place.error("a swell lasts longer than 0; give it a hold or a decay", "events")
    return EventResponse(**read)


def _length(value: object) -> float:
    number = parse_number(value)
    if number < 0.0:
        raise ValueError(f"{number:g} is no length; it is 0 or more")
    return number


def _count(value: object) -> int:
    number = parse_number(value)
    if number < 1 or number != int(number):
        raise ValueError(f"{number:g} is no count; it is 1, 2, 3 and so on")
    return int(number)


def _read_amount(value: object, parameter: Parameter, blend: str) -> Any:
    """A value of the parameter; what is added or multiplied may lie outside of its range."""
    if blend == "replace":
        return parameter.parse(value)
    if parameter.type == "number":
        return parse_number(value)
    return parse_numbers(value, 3)


def _read_filter(document: object, place: Place) -> NoteFilter:
    given = place.fields(document, FILTER_FIELDS, what="where")
    read: dict[str, Any] = {}
    if "part" in given:
        read["part"] = _count(parse_number(given["part"]) + 1.0) - 1
    for field in ("pitch", "velocity"):
        if field in given:
            read[field] = parse_numbers(given[field], 2)
    if "valves" in given:
        items = value_items(given["valves"])
        if items is None:
            raise ValueError("valves are a list of their numbers, [] for open notes")
        read["valves"] = tuple(sorted(_count(item) for item in items))
    return NoteFilter(**read)


def events_document(response: EventResponse) -> dict[str, Any]:
    """What a track does at events as JSON, without what is so anyway."""
    document: dict[str, Any] = {}
    for field in fields(EventResponse):
        value = getattr(response, field.name)
        if value != field.default:
            document[field.name] = value
    if "where" in document:
        where = response.where
        document["where"] = {
            name: getattr(where, name) for name in FILTER_FIELDS if getattr(where, name) is not None
        }
    return document
