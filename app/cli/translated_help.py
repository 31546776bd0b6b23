"""Help and error messages of the options, translated from the catalogue ``help``."""

import argparse
from collections.abc import Callable, Sequence

#: Context of the catalogue. Its texts are those of the parsers, and argparse's own.
CONTEXT = "help"


def language_asked(arguments: Sequence[str] | None) -> str | None:
    """Return the value of ``--language`` before the parser is built."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--language", nargs="?")
    asked: str | None = parser.parse_known_args(arguments)[0].language
    return asked


def translate_argparse(text: Callable[[str], str]) -> None:
    """Translate argparse's own texts in all parsers made from now on."""
    vars(argparse).update(_=text, ngettext=lambda one, many, n: text(one if n == 1 else many))


def translate_parser(parser: argparse.ArgumentParser, text: Callable[[str], str]) -> None:
    """Translate descriptions, headings and help of a parser and of its subcommands."""
    if parser.description:
        parser.description = text(parser.description)
    for group in parser._action_groups:
        if group.title:
            group.title = text(group.title)
    for action in parser._actions:
        if action.help:
            action.help = text(action.help)
        if isinstance(action, argparse._SubParsersAction):
            for listed in action._choices_actions:
                listed.help = text(listed.help or "")
            for own in action.choices.values():
                translate_parser(own, text)
