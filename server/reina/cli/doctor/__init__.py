"""`reina doctor`: whether all is there that the server needs, and what to do about what is not."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from reina.api.settings import Settings
from reina.cli.doctor.data import data_checks
from reina.cli.doctor.database import database_finding
from reina.cli.doctor.machine import machine_checks
from reina.cli.doctor.network import network_checks
from reina.cli.doctor.parts import parts_checks
from reina.cli.doctor.redis_bus import bus_finding
from reina.cli.doctor.scheduler import scheduler_finding
from reina.cli.score_tables import table
from reina.cli.serve import HOST, PORT
from reina.errors import InputError
from reina.system.json_text import json_text

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator

    from reina.cli.doctor.finding import Finding


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes: what `reina serve` would be given."""
    environment = os.environ
    parser.add_argument("--host", default=environment.get("REINA_HOST", HOST), help=f"as of `serve` ({HOST})")
    parser.add_argument(
        "--port", type=int, default=environment.get("REINA_PORT", str(PORT)), help=f"as of `serve` ({PORT})"
    )
    parser.add_argument("--data-dir", type=Path, default=None, help="as of `serve` (data)")
    parser.add_argument("--json", action="store_true", help="print a JSON list instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Print what was found; return 1 if something is missing without which the server does not work."""
    try:
        settings = _settings(arguments)
    except InputError as error:
        print(f"reina doctor: {error}", file=sys.stderr)
        return 1
    found = list(findings(settings, arguments.host, arguments.port))
    if arguments.json:
        print(json_text([finding.document() for finding in found]).decode())
    else:
        rows = [(finding.status, finding.what, finding.detail) for finding in found]
        for line in table(("", "what", "found"), rows):
            print(line)
        for finding in found:
            if finding.to_do:
                print(f"\n{finding.what}: {finding.to_do}")
    return 1 if any(finding.status == "fail" for finding in found) else 0


def findings(settings: Settings, host: str, port: int) -> Iterator[Finding]:
    """Everything that is looked at, in the order in which it is told.

    Args:
        settings: As the server would be started with.
        host: Where it would listen.
        port: The same.
    """
    yield from network_checks(host, port)
    if settings.scheduler:
        yield scheduler_finding(settings)
    yield from data_checks(settings.data_dir)
    yield database_finding(settings.data_dir.absolute(), settings.database)
    if settings.bus:
        yield bus_finding(settings)
    yield from parts_checks(settings)
    yield from machine_checks()


def _settings(arguments: argparse.Namespace) -> Settings:
    settings = Settings()
    return settings if arguments.data_dir is None else replace(settings, data_dir=arguments.data_dir)
