"""The command ``rotemina``: the window, and subcommands that do its work without one.

Exit status: 0 done · 2 bad input, one clear line on stderr · 1 a fault of the program · 128 + its
number for a signal that asked for an end, such as 130 for Ctrl-C.
"""

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from importlib.metadata import version
from typing import NoReturn

from rotemina.app.cli import window
from rotemina.app.cli.language import wording
from rotemina.app.cli.termination import interrupted_by_signals
from rotemina.app.cli.translated_help import (
    CONTEXT,
    language_asked,
    translate_argparse,
    translate_parser,
)
from rotemina.sim.errors import InputError
from rotemina.sim.messages import Wording, message

#: Each is a module of this package with a function ``add_parser``.
SUBCOMMANDS = (
    "play", "simulate", "compare", "gap", "compensate", "convert", "excite", "effect", "driver",
    "board", "stage", "recording", "plate", "plugin", "calibrate", "tune", "doctor",
)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    spoken = Wording()
    with interrupted_by_signals() as signals:
        try:
            spoken = wording(language_asked(arguments))
            return _run(arguments, spoken)
        except KeyboardInterrupt:
            said = message("cli", "interrupted")
            print(f"rotemina: {spoken.of(said)}", file=sys.stderr)
            return 128 + (signals[-1] if signals else signal.SIGINT)


def _run(arguments: Sequence[str] | None, spoken: Wording) -> int:
    text = partial(spoken.text, CONTEXT)
    translate_argparse(text)
    parser = build_parser(_needed(sys.argv[1:] if arguments is None else arguments))
    translate_parser(parser, text)
    options = parser.parse_args(arguments)
    # The window translates its messages itself.
    options.wording = Wording() if options.run is window.run else spoken
    try:
        status = int(options.run(options))
        sys.stdout.flush()
        return status
    except InputError as error:
        print(f"rotemina: {options.wording.shown(str(error))}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # whoever read our output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        if error.filename is None:
            raise
        said = message("cli", "{file}: {reason}; check its name and folder").fill(
            file=str(error.filename), reason=str(error.strerror)
        )
        print(f"rotemina: {options.wording.of(said)}", file=sys.stderr)
        return 2


def _needed(arguments: Sequence[str]) -> Sequence[str]:
    """Return the subcommands that the arguments name, all where one may want a list of them.

    To load the modules of all takes longer than the window needs to open.
    """
    named = [one for one in SUBCOMMANDS if one in arguments]
    if named:
        return named
    of_window = argparse.ArgumentParser(add_help=False, exit_on_error=False)
    window.add_options(of_window)
    try:
        return SUBCOMMANDS if of_window.parse_known_args(arguments)[1] else ()
    except argparse.ArgumentError:  # the whole parser says what is wrong
        return SUBCOMMANDS


class CommandParser(argparse.ArgumentParser):
    """A parser whose errors quote an argument as messages do."""

    def error(self, message: str) -> NoReturn:
        """Print the usage and an error, and exit with status 2."""
        super().error(Wording().quoted(message))


def build_parser(subcommands: Sequence[str] = SUBCOMMANDS) -> argparse.ArgumentParser:
    """Return the parser of the command line; without a subcommand the window opens."""
    parser = CommandParser(
        prog="rotemina",
        description="Control, simulation and sim-to-real diagnosis of the RoTeMiNa robot. Without"
        " a subcommand the operator's window opens.",
    )
    parser.add_argument("--version", action="version", version=f"rotemina {version('rotemina')}")
    window.add_options(parser)
    if subcommands:
        commands = parser.add_subparsers(title="subcommands", metavar="")
        for name in subcommands:
            import_module(f"rotemina.app.cli.{name}").add_parser(commands)
    return parser


if __name__ == "__main__":
    sys.exit(main())
