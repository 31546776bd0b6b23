"""The drawing commands for viewers: the newest one of each kind and path, with its revision.

Commands have the form that meshcat's viewer decodes: ``set_object``, ``set_transform`` and
``set_property`` on a path of its scene tree. The page of this program also decodes ``view``,
``note`` and ``alive``. A viewer that connects late or is slow receives only the newest commands.
"""

import threading
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rotemina.sim.arrays import FloatArray

SceneCommand = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class SceneChanges:
    """The commands since an earlier revision, in an order in which they can be drawn."""

    commands: tuple[SceneCommand, ...]
    revision: int


class SceneCommandStore:
    """Stores the newest commands; every method may be called from any thread."""

    def __init__(self) -> None:
        # The newest command and its revision, by kind, path and property.
        self._newest: dict[tuple[str, str, str], tuple[int, SceneCommand]] = {}
        self._revision = 0
        self._lock = threading.Lock()

    def put(self, *commands: SceneCommand, again: bool = False) -> None:
        """Replace the earlier commands of the same kind and path, all in one step.

        A command that changes nothing is ignored, unless ``again`` is true.
        """
        with self._lock:
            for command in commands:
                key = (command["type"], command.get("path", ""), command.get("property", ""))
                _, previous = self._newest.get(key, (0, None))
                if again or command != previous:
                    self._revision += 1
                    self._newest[key] = (self._revision, command)

    def get_changes(self, since: int = 0) -> SceneChanges:
        """Return the commands after a revision; after 0, the whole scene."""
        with self._lock:
            commands = tuple(
                command for revision, command in self._newest.values() if revision > since
            )
            return SceneChanges(commands, self._revision)


def set_transform(path: str, matrix: FloatArray) -> SceneCommand:
    """Return the command that sets the pose (4, 4) of ``path`` in the frame of its parent."""
    return {"type": "set_transform", "path": path, "matrix": matrix.T.ravel().tolist()}


def set_property(path: str, name: str, value: object) -> SceneCommand:
    """Return the command that changes a property, such as ``visible``, of ``path``."""
    return {"type": "set_property", "path": path, "property": name, "value": value}
