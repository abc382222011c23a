"""Reads what a track does at events from JSON, and writes it."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, cast

from reina.curves.parameter import Parameter
from reina.curves.value_types import parse_number, parse_numbers, value_items
from reina.show.event_response import BLENDS, EventResponse, NoteFilter
from reina.show.location import Json, Location
from reina.show.triggers import OCCASIONS

EVENT_FIELDS = tuple(field.name for field in fields(EventResponse))
FILTER_FIELDS = tuple(field.name for field in fields(NoteFilter))


def read_events(document: object, parameter: Parameter) -> EventResponse:
    """Read the ``events`` of a parameter's track.

    Raises:
        ShowError: A field is not as it should be.
    """
    location = Location(parameter.path)
    if not isinstance(document, Mapping):
        raise location.error(f"it is a JSON object, not {type(document).__name__}", "events")
    given = location.fields(cast("Json", document), EVENT_FIELDS, what="what a track does at events")
    if ("amount" in given) == ("cycle" in given):
        raise location.error("it has either an amount, for a swell, or a cycle of values", "events")
    on = location.choice(given, "on", OCCASIONS)
    if on != "notes" and ("where" in given or "by_velocity" in given):
        raise location.error(f"only notes are told apart; {on} have neither where nor by_velocity", "on")
    blend = location.choice(given, "blend", BLENDS, "replace")
    if blend != "replace" and parameter.type not in ("number", "vector", "color"):
        raise location.error(f"a {parameter.type} can only be replaced", "blend")
    read: dict[str, Any] = {"on": on, "blend": blend, "by_velocity": location.flag(given, "by_velocity")}
    field = ""
    try:
        for field in ("attack", "hold", "decay"):
            read[field] = _length(given.get(field, 0.0))
        field = "every"
        read[field] = _count(given.get(field, 1))
        field = "where"
        read[field] = _read_filter(given.get(field, {}), location)
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
        raise location.error(str(error), f"events/{field}") from None
    if read.get("amount") is not None and not read["attack"] + read["hold"] + read["decay"] > 0.0:
        raise location.error("a swell lasts longer than 0; give it a hold or a decay", "events")
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


def _read_filter(document: object, location: Location) -> NoteFilter:
    given = location.fields(document, FILTER_FIELDS, what="where")
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
