"""A browser's test that fails is tried once more, and few may need it.

A picture drawn in software on two busy cores may come later than anything expects of it; what is wrong with
the page fails twice. Nothing is hidden: what failed first is printed with all that was known of it, and a run
in which more than `MOST` tests took a second try has failed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import pytest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from _pytest.terminal import TerminalReporter

MOST = 2
"""So many tests of a run may pass on their second try."""


def pytest_collection_modifyitems(items: Sequence[pytest.Item]) -> None:
    """Have the browser's tests tried once more when they fail."""
    for item in items:
        if item.get_closest_marker("browser") is not None:
            item.add_marker(pytest.mark.flaky(reruns=1))


def _first_tries(session: pytest.Session) -> list[pytest.TestReport]:
    """The reports of what failed at first."""
    reporter = cast("TerminalReporter | None", session.config.pluginmanager.get_plugin("terminalreporter"))
    return [] if reporter is None else list(reporter.stats.get("rerun", ()))


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    """Fail a run in which too many tests took a second try."""
    if exitstatus == pytest.ExitCode.OK and len(_first_tries(session)) > MOST:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: TerminalReporter) -> None:
    """Print what failed at first, as what failed for good is printed."""
    failed = list(terminalreporter.stats.get("rerun", ()))
    if not failed:
        return
    verdict = "" if len(failed) <= MOST else ": too many, the run has failed"
    terminalreporter.section(f"failed at first, {len(failed)} where {MOST} may{verdict}")
    for report in failed:
        terminalreporter.write_line(report.nodeid, bold=True)
        terminalreporter.write_line(report.longreprtext)
        for name, text in report.sections:
            terminalreporter.write_line(f"{name}: {text}")
