"""The command ``rotemina``: the window, and subcommands that work without it.

Exit status: 0 success; 1 a check failed, or an error of the program; 2 invalid input, with one line
on stderr; 128 + the number of a signal that ended the program, such as 130 for Ctrl-C.
"""

import argparse
import os
import signal
import sys
from collections.abc import Collection, Sequence
from functools import partial
from importlib import import_module
from importlib.metadata import version
from typing import NoReturn

from rotemina.app.cli import window
from rotemina.app.cli.terminal import (
    HELP_CONTEXT,
    interrupt_on_signals,
    load_wording,
    parse_language_option,
    translate_argparse,
    translate_parser,
)
from rotemina.sim.errors import InputError
from rotemina.sim.messages import MessageWording, message

#: The folder that contains the module of each subcommand, which has a function ``add_parser``.
SUBCOMMANDS = {
    "play": "records", "simulate": "records", "compare": "records", "gap": "gap",
    "compensate": "control", "convert": "records", "excite": "records", "effect": "plugins",
    "driver": "plugins", "board": "machine", "stage": "machine", "recording": "records",
    "plate": "machine", "plugin": "plugins", "calibrate": "machine", "tune": "control",
    "doctor": "machine",
}  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    wording = MessageWording()
    with interrupt_on_signals() as signals:
        try:
            wording = load_wording(parse_language_option(arguments))
            return _run(arguments, wording)
        except KeyboardInterrupt:
            text = message("cli", "interrupted")
            print(f"rotemina: {wording.format_message(text)}", file=sys.stderr)
            return 128 + (signals[-1] if signals else signal.SIGINT)


def _run(arguments: Sequence[str] | None, wording: MessageWording) -> int:
    translate = partial(wording.localize_text, HELP_CONTEXT)
    translate_argparse(translate)
    parser = build_parser(
        _find_needed_subcommands(sys.argv[1:] if arguments is None else arguments)
    )
    translate_parser(parser, translate)
    options = parser.parse_args(arguments)
    # The window translates its messages itself.
    options.wording = MessageWording() if options.run is window.run else wording
    try:
        status = int(options.run(options))
        sys.stdout.flush()
        return status
    except InputError as error:
        print(f"rotemina: {options.wording.format_field(str(error))}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # The reader of the output has closed it, as `head` does. Python would raise again when it
        # flushes stdout at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        if error.filename is None:
            raise
        error_text = message("cli", "{file}: {reason}; check its name and folder").fill(
            file=str(error.filename), reason=str(error.strerror)
        )
        print(f"rotemina: {options.wording.format_message(error_text)}", file=sys.stderr)
        return 2


def _find_needed_subcommands(arguments: Sequence[str]) -> Collection[str]:
    """Return the subcommands whose modules are needed to parse the arguments.

    All subcommands are needed if the arguments may ask for help or are wrong. Otherwise, loading
    them is avoided, because it takes longer than opening the window.
    """
    candidates = [name for name in SUBCOMMANDS if name in arguments]
    if candidates:
        return candidates
    window_parser = argparse.ArgumentParser(add_help=False, exit_on_error=False)
    window.add_options(window_parser)
    try:
        return SUBCOMMANDS if window_parser.parse_known_args(arguments)[1] else ()
    except argparse.ArgumentError:
        # The complete parser then reports the error.
        return SUBCOMMANDS


class CommandParser(argparse.ArgumentParser):
    """An argument parser whose errors quote arguments like other messages."""

    def error(self, message: str) -> NoReturn:
        """Print the usage and the error, and exit with status 2."""
        super().error(MessageWording().quote(message))


def build_parser(subcommands: Collection[str] = SUBCOMMANDS) -> argparse.ArgumentParser:
    """Return the parser of the command line; without a subcommand, the window opens."""
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
            import_module(f"rotemina.app.cli.{SUBCOMMANDS[name]}.{name}").add_parser(commands)
    return parser


if __name__ == "__main__":
    sys.exit(main())
