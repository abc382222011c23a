"""The interface called in any order that its description allows: what a call makes, others are asked of.

Schemathesis writes the calls after the OpenAPI document and its links, and checks each answer against it: no
failure of the server, no undescribed status, media type, header or body, nothing there that has been ended,
nothing gone that has just been made.
"""

from __future__ import annotations

import itertools
from collections import Counter
from typing import TYPE_CHECKING, Any

import schemathesis
from hypothesis import HealthCheck, Phase, settings
from hypothesis.errors import Flaky
from schemathesis import GenerationMode
from schemathesis.specs.openapi import checks
from tests.integration.scores import scale

if TYPE_CHECKING:
    from collections.abc import Callable

SESSIONS = "/api/v1/sessions"
SCORE = scale(8)
TRACKS = ("camera/fov", "lights/key/intensity", "blocks/color", "camera/position")
FREELY_CHOSEN = ("public", "octave_fit", "written", "title")
"""The fields of an upload that any score takes."""
_checks: Any = checks
NOT_JUDGED = [
    # Who may what has a test of its own.
    _checks.ignored_auth,
    # A document can be right by its schema and not fit the piece.
    _checks.positive_data_acceptance,
]
CALLS_A_ROUND = 30

schemathesis.serializer.alias("audio/wav", "application/octet-stream")


class CallsInAnyOrder:
    """Calls a server in any order.

    Args:
        address: Where it answers.
    """

    def __init__(self, address: str) -> None:
        self.calls: Counter[tuple[str, str, int]] = Counter()
        """How often what was answered how: method, path, status."""
        self._failures: list[BaseException] = []
        self._tokens: dict[str, str] = {}
        self._machine = self._made(address)

    def run(self, calls: int) -> None:
        """Call so often, at least.

        Raises:
            FailureGroup: An answer is not as described; it says how to ask the same again.
        """
        while self.calls.total() < calls:
            try:
                self._machine.run(
                    settings=settings(
                        max_examples=10,
                        stateful_step_count=CALLS_A_ROUND,
                        deadline=None,
                        database=None,
                        phases=[Phase.generate],
                        suppress_health_check=[
                            HealthCheck.too_slow,
                            HealthCheck.filter_too_much,
                            HealthCheck.data_too_large,
                            HealthCheck.large_base_example,
                        ],
                    )
                )
            except Flaky:
                # A song is made meanwhile: the same calls are not answered the same a moment later.
                if self._failures:
                    raise self._failures[0] from None

    def _made(self, address: str) -> Any:
        document: Any = schemathesis.openapi.from_url(f"{address}/openapi.json")
        schema = document.include(path_regex="/sessions")
        schema.config.generation.update(modes=[GenerationMode.POSITIVE])
        tracks = itertools.cycle(TRACKS)

        def map_body(_: Any, body: Any) -> Any:
            chosen = {name: value for name, value in body.items() if name in FREELY_CHOSEN}
            return {**chosen, "score": SCORE}

        def map_path_parameters(_: Any, parameters: dict[str, Any] | None) -> dict[str, Any] | None:
            if parameters and "path" in parameters:
                parameters["path"] = next(tracks)
            return parameters

        schema.hook.apply_to(path=SESSIONS, method="POST")(map_body)
        schema.hook(map_path_parameters)
        return _machine(schema.as_state_machine(), self._tokens, self._answered)

    def _answered(self, response: Any, case: Any, check: Callable[[], None]) -> None:
        self.calls[case.method, case.operation.path, response.status_code] += 1
        try:
            check()
        except BaseException as failure:
            self._failures.append(failure)
            raise


def _machine(base: Any, tokens: dict[str, str], answered: Callable[..., None]) -> Any:
    class Calls(base):
        def before_call(self, case: Any) -> None:
            parameters: dict[str, str] = case.path_parameters or {}
            token = tokens.get(parameters.get("session_id", ""))
            if token is not None:
                case.headers = {**(case.headers or {}), "Authorization": f"Bearer {token}"}

        def after_call(self, response: Any, case: Any) -> None:
            if response.status_code == 201 and case.operation.path == SESSIONS:
                made = response.json()
                tokens[made["id"]] = made["control_token"]

        def validate_response(self, response: Any, case: Any, **_: Any) -> None:
            answered(response, case, lambda: case.validate_response(response, excluded_checks=NOT_JUDGED))

    return Calls
