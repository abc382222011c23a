"""What the environment sets, and what it cannot be."""

from __future__ import annotations

import pytest

from reina.cli.environment import seconds, switch, whole_number
from reina.errors import InputError


@pytest.mark.parametrize("text", ["1", "yes", "true", "on", "ON", " True "])
def test_on(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_LAB", text)
    assert switch("REINA_LAB") is True


@pytest.mark.parametrize("text", ["0", "no", "false", "off", "No"])
def test_off(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_LAB", text)
    assert switch("REINA_LAB") is False


def test_what_is_not_set(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_LAB", "")
    assert switch("REINA_LAB") is None
    assert whole_number("REINA_NOTHING", 7) == 7
    assert seconds("REINA_NOTHING", 7.5) == 7.5


@pytest.mark.parametrize("text", ["2", "maybe", "yes please", "-1"])
def test_neither_on_nor_off(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_LAB", text)
    with pytest.raises(InputError, match="REINA_LAB is one of 1, yes"):
        switch("REINA_LAB")


@pytest.mark.parametrize("text", ["0", "-5", "1.5", "many", "٣"])
def test_no_whole_number(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_MOST_CONNECTIONS", text)
    with pytest.raises(InputError, match="REINA_MOST_CONNECTIONS is a whole number"):
        whole_number("REINA_MOST_CONNECTIONS", 1)


@pytest.mark.parametrize("text", ["0", "-5", "soon", "nan", "inf"])
def test_no_length_of_time(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_HEADER_S", text)
    with pytest.raises(InputError, match="REINA_HEADER_S is a number of seconds"):
        seconds("REINA_HEADER_S", 1.0)
