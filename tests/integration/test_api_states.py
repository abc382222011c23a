"""The interface answers as it is described, in whatever order it is called."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.integration.api_states import SESSIONS, CallsInAnyOrder
from tests.integration.server import serve

if TYPE_CHECKING:
    from pathlib import Path

CALLS = 120


def test_calls_in_any_order_are_answered_as_described(tmp_path: Path) -> None:
    with serve(tmp_path, "--no-page") as running:
        called = CallsInAnyOrder(running.address)
        called.run(CALLS)
    made = called.calls["POST", SESSIONS, 201]
    reached = {(method, path) for method, path, status in called.calls if status < 300}
    assert made > 0
    assert len(reached) >= 10, "what was made is asked for"
