"""The camera of a viewer that draws by itself: projection of points to pixels."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rotemina.app.scene.scene import Command
from rotemina.sim.arrays import FloatArray

_HALF_HEIGHT = np.tan(np.radians(62.0) / 2)  # of the picture, at unit distance
_STEEPEST = np.radians(89.9)  # exactly upright has no heading
_NEAREST_M, _FARTHEST_M = 2e-5, 2.0


@dataclass(frozen=True, eq=False)
class Camera:
    """Looks at ``target`` from ``offset`` away from it, both (3,), m, z up.

    What is closer to the eye than ``near``, m, is not drawn.
    """

    target: FloatArray
    offset: FloatArray
    near: float

    @classmethod
    def of(cls, command: Command) -> "Camera":
        """Return the camera that a ``view`` command asks for."""
        target, offset = np.array(command["target"]), np.array(command["eye"])
        return cls(target, offset, command["near"])

    @property
    def eye(self) -> FloatArray:
        """The position of the camera, (3,), m."""
        return self.target + self.offset

    @cached_property
    def axes(self) -> FloatArray:
        """Right, up and ahead, the rows of (3, 3)."""
        ahead = -self.offset / np.linalg.norm(self.offset)
        right = np.cross(ahead, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(right, ahead), ahead])

    def seen(self, points: FloatArray) -> FloatArray:
        """Return points (n, 3), m, of the room along the camera's axes, from the eye."""
        return (points - self.eye) @ self.axes.T

    def turned(self, right: float, up: float) -> "Camera":
        """Return the camera after it went about its target, rad."""
        x, y, z = self.offset
        flat = np.hypot(x, y)
        heading = np.arctan2(y, x) + right
        pitch = np.clip(np.arctan2(z, flat) + up, -_STEEPEST, _STEEPEST)
        distance = np.linalg.norm(self.offset)
        along = np.array([np.cos(heading), np.sin(heading)]) * np.cos(pitch)
        return replace(self, offset=distance * np.array([*along, np.sin(pitch)]))

    def nearer(self, factor: float) -> "Camera":
        """Return the camera that many times as near to its target, within bounds."""
        distance = float(np.linalg.norm(self.offset))
        goal = float(np.clip(distance / factor, _NEAREST_M, _FARTHEST_M))
        ratio = goal / distance
        return replace(self, offset=ratio * self.offset, near=ratio * self.near)

    def shifted(self, right: float, up: float, height: float) -> "Camera":
        """Return the camera moved by pixels at its target, in a picture of this height, px."""
        scale = np.linalg.norm(self.offset) / focal(height)
        return replace(
            self, target=self.target + scale * (right * self.axes[0] + up * self.axes[1])
        )


def focal(height: float) -> float:
    """Return the focal length, px, of a picture of this height, px."""
    return float(height / (2 * _HALF_HEIGHT))


def pixels(seen: FloatArray, width: float, height: float) -> FloatArray:
    """Return where points (n, 3) along the camera's axes are, (n, 2), px from the upper left."""
    scale = focal(height) / seen[:, 2]
    return np.column_stack([width / 2 + scale * seen[:, 0], height / 2 - scale * seen[:, 1]])
