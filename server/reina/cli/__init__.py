"""The command `reina`."""

import argparse
import gc
import importlib
import sys
from collections.abc import Sequence
from types import ModuleType

COMMANDS = {
    "serve": ("reina.cli.serve", "start the server and print its address"),
    "migrate": ("reina.cli.migrate", "take over the sessions that an earlier version kept"),
    "inspect": ("reina.cli.inspect", "say what is in a score and how it is fingered"),
    "align": ("reina.cli.align", "say where a score is heard in a recording"),
    "transcribe": ("reina.cli.transcribe", "find the notes of a recording of one line"),
    "doctor": ("reina.cli.doctor", "look whether all is there that the server needs"),
    "backup": ("reina.cli.backup", "copy what the server keeps, while it runs"),
    "restore": ("reina.cli.restore", "put back what was backed up"),
    "password": ("reina.cli.password", "make a line for the file that says who may upload"),
    "bake": ("reina.cli.bake", "make beforehand what a whole library of scores needs"),
    "film": ("reina.cli.film", "make a film of a score, without a window"),
}
"""Each command's module, which is imported when it is asked for, and what it does."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command that the arguments name; return its exit status."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    parser = argparse.ArgumentParser(
        prog="reina", description="A music visualizer with a player in it.", allow_abbrev=False
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, (module, what) in COMMANDS.items():
        command = commands.add_parser(name, help=what, description=f"{what[0].upper()}{what[1:]}.")
        if arguments[:1] == [name]:
            _imported(module).add_arguments(command)
    chosen = parser.parse_args(arguments)
    return int(_imported(COMMANDS[chosen.command][0]).run(chosen))


def _imported(module: str) -> ModuleType:
    """A module; what it imports stays, so that the collector need not look through it, now or ever."""
    gc.disable()
    try:
        return importlib.import_module(module)
    finally:
        gc.freeze()
        gc.enable()
