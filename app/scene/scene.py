"""The drawing commands for viewers: the newest of each, numbered by age.

Commands are those of meshcat's viewer, as it decodes them: ``set_object``, ``set_transform`` and
``set_property`` on a path of its scene tree; our own page adds ``view`` and ``note``. Somebody who
comes late, or is slow, gets the newest of each and nothing in between.
"""

import threading
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rotemina.sim.arrays import FloatArray

Command = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Changes:
    """What is new since an earlier ``revision``, in an order in which it can be drawn."""

    commands: tuple[Command, ...]
    revision: int


class Scene:
    """Holds the commands; every method may be called from any thread."""

    def __init__(self) -> None:
        self._newest: dict[tuple[str, str, str], tuple[int, Command]] = {}
        self._revision = 0
        self._lock = threading.Lock()

    def put(self, *commands: Command, again: bool = False) -> None:
        """Replace earlier commands on the same path, all at once.

        What is no change is left out, unless it is to happen ``again``.
        """
        with self._lock:
            for command in commands:
                key = (command["type"], command.get("path", ""), command.get("property", ""))
                _, before = self._newest.get(key, (0, None))
                if again or command != before:
                    self._revision += 1
                    self._newest[key] = (self._revision, command)

    def changes(self, since: int = 0) -> Changes:
        """Return what came after a revision; since 0, the whole scene."""
        with self._lock:
            new = (command for revision, command in self._newest.values() if revision > since)
            return Changes(tuple(new), self._revision)


def set_transform(path: str, matrix: FloatArray) -> Command:
    """Place what is at ``path`` in the frame of what it hangs from; ``matrix`` is (4, 4)."""
    return {"type": "set_transform", "path": path, "matrix": matrix.T.ravel().tolist()}


def set_property(path: str, name: str, value: object) -> Command:
    """Change a property, such as ``visible``, of what is at ``path``."""
    return {"type": "set_property", "path": path, "property": name, "value": value}
