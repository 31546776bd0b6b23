"""Names of people and machines taken out of texts before they are given away. Free of Qt."""

import getpass
import os
import platform
import re
from collections.abc import Iterable
from pathlib import Path

HOME, USER, HOST = "<home>", "<user>", "<host>"
_SHORTEST = 3  # a shorter name is found in paths only: "x" is an axis too
# Homes of anybody: what follows the folder of homes is a name, in either way of writing paths.
# Backslashes may be doubled, as JSON does.
_HOMES = re.compile(
    r"(?:(?<![\w.])/(?:home|Users)/|[A-Za-z]:(?:\\{1,2}|/)Users(?:\\{1,2}|/))[^/\\\s\"'<>|:,;]+",
    re.IGNORECASE,
)


class Anonymiser:
    """Replaces home folders, user names and the machine's name.

    Parameters
    ----------
    homes : paths
        Home folders of this user, as they are written.
    names : names
        Of the user: login, and as the system knows them in full.
    hosts : names
        Of the machine.
    """

    def __init__(
        self, homes: Iterable[str], names: Iterable[str], hosts: Iterable[str] = ()
    ) -> None:
        self._rules: list[tuple[re.Pattern[str], str]] = []
        for home in sorted(set(homes), key=len, reverse=True):
            if len(home) > 1:  # the root of the file system names nobody
                self._rules.append((_path_pattern(home), HOME))
        self._rules.append((_HOMES, HOME))
        for words, mark in ((names, USER), (hosts, HOST)):
            for word in sorted({word for word in words if len(word) >= _SHORTEST}, key=len)[::-1]:
                pattern = rf"(?<![^\W_]){re.escape(word)}(?![^\W_])"
                self._rules.append((re.compile(pattern, re.IGNORECASE), mark))

    @classmethod
    def of_this_user(cls) -> "Anonymiser":
        """Return one for whoever runs the program, on this machine."""
        home = Path.home()
        homes = {str(home), str(home.resolve()), os.environ.get("USERPROFILE", "")}
        names = {home.name, os.environ.get("USER", ""), os.environ.get("USERNAME", "")}
        names |= _names_of_system()
        host = platform.node()
        return cls(homes - {""}, names, {host, host.partition(".")[0]})

    def anonymise(self, text: str) -> str:
        """Return a text with marks in the place of what it must not tell."""
        for pattern, mark in self._rules:
            text = pattern.sub(mark, text)
        return text


def _path_pattern(path: str) -> re.Pattern[str]:
    """Return what finds a path, its separators written in any way."""
    parts = [re.escape(part) for part in re.split(r"[/\\]+", path)]
    return re.compile(r"(?:\\{1,2}|/)".join(parts) + r"(?![\w-])", re.IGNORECASE)


def _names_of_system() -> set[str]:
    """Return the login and the full name as the system knows them; nothing where it knows none."""
    names = set()
    try:
        names.add(getpass.getuser())
        import pwd

        full = pwd.getpwuid(os.getuid()).pw_gecos.partition(",")[0].strip()
        names |= {full, *full.split()}
    except (ImportError, KeyError, OSError):  # on Windows, or a user without an entry
        pass
    return names - {""}
