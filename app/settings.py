"""Display preferences, stored between starts. A bad value falls back; start never fails.

A file that cannot be read is set aside under a name of its own before anything is written.
"""

import json
import logging
import os
import threading
from itertools import count
from pathlib import Path
from typing import TypeVar

from platformdirs import user_config_path

from rotemina.app.files import write_text
from rotemina.sim.errors import InputError
from rotemina.sim.input_files import parse_json, read_text
from rotemina.sim.messages import message
from rotemina.sim.whole_files import FileWriteError

logger = logging.getLogger(__name__)

LANGUAGE = "window.language"  # a preference that the command line keeps to as well
_MOST_BYTES = 1_000_000
Value = TypeVar("Value", str, bool, int, float)


class Settings:
    """A small JSON file of preferences: ``section.key`` → text, number or switch. For any thread.

    Parameters
    ----------
    path : where the file is; by default in the user's configuration folder.

    Attributes
    ----------
    fault : str
        Why the file could not be read; empty where it could, or there was none.
    aside : Path or None
        Where that file is kept; None where nothing was wrong, or it could not be moved.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path or user_config_path("rotemina", appauthor=False) / "settings.json"
        self.fault = ""
        self.aside: Path | None = None
        self._lock = threading.Lock()  # only one thread changes and writes
        self._values = self._load()

    @property
    def folder(self) -> Path:
        """Where the user's own files are kept, this one among them."""
        return self._path.parent

    @property
    def values(self) -> dict[str, object]:
        """All preferences that were ever set, by key."""
        return dict(self._values)

    def get(self, key: str, default: Value) -> Value:
        """Return a preference, or ``default`` where it is missing or of another type."""
        value = self._values.get(key, default)
        if type(value) is not type(default):
            logger.warning("%s: %s = %r is ignored, %r is used", self._path, key, value, default)
            return default
        return value

    def set(self, key: str, value: str | bool | int | float) -> None:
        """Keep a preference and write the file; a failure is logged, not raised."""
        with self._lock:
            self._values[key] = value
            if self.fault and self.aside is None:
                return  # the file that cannot be read is still in its place
            try:
                self._path.parent.mkdir(parents=True, exist_ok=True)
                write_text(self._path, json.dumps(self._values, indent=1, sort_keys=True))
            except (OSError, FileWriteError) as error:
                logger.warning("%s: preferences cannot be kept: %s", self._path, error)

    def _load(self) -> dict[str, object]:
        if not os.path.lexists(self._path):
            return {}
        try:
            text = read_text(self._path, InputError, _MOST_BYTES)
            values = parse_json(text, str(self._path), InputError)
            if not isinstance(values, dict):
                raise InputError(
                    message("engine", "{path} contains no table of preferences").fill(
                        path=self._path
                    )
                )
        except InputError as error:
            self.fault = str(error)
            self._set_aside()
            logger.warning("%s; defaults are used, it is kept as %s", error, self.aside)
            return {}
        return values

    def _set_aside(self) -> None:
        names = (
            self._path.with_name(f"{self._path.stem}.damaged-{number}{self._path.suffix}")
            for number in count(1)
        )
        free = next(name for name in names if not os.path.lexists(name))
        try:
            self._path.rename(free)
        except OSError as error:
            logger.warning("%s: it cannot be moved, so nothing is kept: %s", self._path, error)
        else:
            self.aside = free
