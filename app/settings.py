"""Preferences of the screen, kept between starts. A bad value falls back; start never fails."""

import json
import logging
import threading
from pathlib import Path
from typing import TypeVar

from platformdirs import user_config_path

from rotemina.app.files import write_text
from rotemina.sim.whole_files import FileWriteError

logger = logging.getLogger(__name__)

Value = TypeVar("Value", str, bool, int, float)


class Settings:
    """A small JSON file of preferences: ``section.key`` → text, number or switch. For any thread.

    Parameters
    ----------
    path : where the file is; by default in the user's configuration folder.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path or user_config_path("rotemina", appauthor=False) / "settings.json"
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
            try:
                self._path.parent.mkdir(parents=True, exist_ok=True)
                write_text(self._path, json.dumps(self._values, indent=1, sort_keys=True))
            except (OSError, FileWriteError) as error:
                logger.warning("%s: preferences cannot be kept: %s", self._path, error)

    def _load(self) -> dict[str, object]:
        try:
            values = json.loads(self._path.read_text("utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, RecursionError) as error:
            logger.warning(
                "%s: preferences cannot be read, defaults are used: %s", self._path, error
            )
            return {}
        return values if isinstance(values, dict) else {}
