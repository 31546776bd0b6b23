"""Translation of the help and the error messages of the command line."""

import argparse
from collections.abc import Callable, Sequence

#: Context, in the translation catalogue, of the texts of the parsers and of argparse itself.
HELP_CONTEXT = "help"


def parse_language_option(arguments: Sequence[str] | None) -> str | None:
    """Return the value of ``--language``, which is needed before the parser can be built."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--language", nargs="?")
    language: str | None = parser.parse_known_args(arguments)[0].language
    return language


def translate_argparse(translate: Callable[[str], str]) -> None:
    """Translate argparse's own texts in all parsers that are made afterwards."""
    # argparse looks up these two functions in its own module.
    vars(argparse).update(
        _=translate,
        ngettext=lambda singular, plural, n: translate(singular if n == 1 else plural),
    )


def translate_parser(parser: argparse.ArgumentParser, translate: Callable[[str], str]) -> None:
    """Translate descriptions, headings and help of a parser and of its subcommands."""
    if parser.description:
        parser.description = translate(parser.description)
    for group in parser._action_groups:
        if group.title:
            group.title = translate(group.title)
    for action in parser._actions:
        if action.help:
            action.help = translate(action.help)
        if isinstance(action, argparse._SubParsersAction):
            for entry in action._choices_actions:
                entry.help = translate(entry.help or "")
            for subparser in action.choices.values():
                translate_parser(subparser, translate)
