"""Removal of personal and machine names from texts that leave the computer. Does not use Qt."""

import getpass
import os
import platform
import re
from collections.abc import Iterable
from pathlib import Path

HOME_MARK, USER_MARK, HOST_MARK = "<home>", "<user>", "<host>"
# Shorter names are only replaced inside paths: "x", for example, is also the name of an axis.
_MIN_NAME_LENGTH = 3
# Matches the home folder of any user, with slashes or backslashes.
# JSON doubles backslashes, so both forms are accepted.
_HOME_FOLDER_PATTERN = re.compile(
    r"(?:(?<![\w.])/(?:home|Users)/|[A-Za-z]:(?:\\{1,2}|/)Users(?:\\{1,2}|/))[^/\\\s\"'<>|:,;]+",
    re.IGNORECASE,
)


class TextAnonymiser:
    """Anonymiser that replaces home folders, user names and host names by placeholders.

    Parameters
    ----------
    homes : iterable of str
        Home folders of this user, in every spelling that a text may contain.
    names : iterable of str
        Names of the user: the login and the full name known to the system.
    hosts : iterable of str
        Names of the machine.
    """

    def __init__(
        self, homes: Iterable[str], names: Iterable[str], hosts: Iterable[str] = ()
    ) -> None:
        self._rules: list[tuple[re.Pattern[str], str]] = []
        for home in sorted(set(homes), key=len, reverse=True):
            # The root folder contains no personal name.
            if len(home) > 1:
                self._rules.append((_make_path_pattern(home), HOME_MARK))
        self._rules.append((_HOME_FOLDER_PATTERN, HOME_MARK))
        for personal_names, placeholder in ((names, USER_MARK), (hosts, HOST_MARK)):
            long_names = {name for name in personal_names if len(name) >= _MIN_NAME_LENGTH}
            for name in sorted(long_names, key=len)[::-1]:
                pattern = rf"(?<![^\W_]){re.escape(name)}(?![^\W_])"
                self._rules.append((re.compile(pattern, re.IGNORECASE), placeholder))

    @classmethod
    def for_current_user(cls) -> "TextAnonymiser":
        """Return an anonymiser for the current user of this machine."""
        home = Path.home()
        homes = {str(home), str(home.resolve()), os.environ.get("USERPROFILE", "")}
        names = {home.name, os.environ.get("USER", ""), os.environ.get("USERNAME", "")}
        names |= _find_user_names()
        host = platform.node()
        return cls(homes - {""}, names, {host, host.partition(".")[0]})

    def anonymise(self, text: str) -> str:
        """Return a text in which placeholders stand for personal names."""
        for pattern, placeholder in self._rules:
            text = pattern.sub(placeholder, text)
        return text


def _make_path_pattern(path: str) -> re.Pattern[str]:
    parts = [re.escape(part) for part in re.split(r"[/\\]+", path)]
    return re.compile(r"(?:\\{1,2}|/)".join(parts) + r"(?![\w-])", re.IGNORECASE)


def _find_user_names() -> set[str]:
    names = set()
    try:
        names.add(getpass.getuser())
        import pwd

        full_name = pwd.getpwuid(os.getuid()).pw_gecos.partition(",")[0].strip()
        names |= {full_name, *full_name.split()}
    # Windows has no module pwd, and a user may have no entry.
    except (ImportError, KeyError, OSError):
        pass
    return names - {""}
