"""The camera of a viewer that draws without a GPU; projects points to pixels."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rotemina.app.scene.scene import SceneCommand
from rotemina.sim.arrays import FloatArray

# Half the height of the picture at unit distance, for a vertical field of view of 62°.
_HALF_HEIGHT_RATIO = np.tan(np.radians(62.0) / 2)
# A camera that looks straight down or up has no defined heading.
_MAX_PITCH_RAD = np.radians(89.9)
_MIN_DISTANCE_M, _MAX_DISTANCE_M = 2e-5, 2.0


@dataclass(frozen=True, eq=False)
class SceneCamera:
    """A perspective camera at ``target`` + ``offset`` that looks at ``target``.

    ``target`` and ``offset`` are (3,), m, with z up. Points closer to the eye than ``near_m``, m,
    are not drawn.
    """

    target: FloatArray
    offset: FloatArray
    near_m: float

    @classmethod
    def from_command(cls, command: SceneCommand) -> "SceneCamera":
        """Return the camera of a ``view`` command."""
        target, offset = np.array(command["target"]), np.array(command["eye"])
        return cls(target, offset, command["near"])

    @property
    def eye(self) -> FloatArray:
        """The position of the camera, (3,), m."""
        return self.target + self.offset

    @cached_property
    def axes(self) -> FloatArray:
        """Unit vectors to the right, upwards and forwards, as the rows of a matrix (3, 3)."""
        forward = -self.offset / np.linalg.norm(self.offset)
        right = np.cross(forward, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(right, forward), forward])

    def to_camera_frame(self, points: FloatArray) -> FloatArray:
        """Convert points (n, 3), m, from scene coordinates to camera coordinates.

        The origin of the camera coordinates is the eye; the axes point right, up and forward.
        """
        return (points - self.eye) @ self.axes.T

    def orbit(self, right: float, up: float) -> "SceneCamera":
        """Return the camera after a rotation around its target by two angles, rad."""
        x, y, z = self.offset
        horizontal = np.hypot(x, y)
        heading = np.arctan2(y, x) + right
        pitch = np.clip(np.arctan2(z, horizontal) + up, -_MAX_PITCH_RAD, _MAX_PITCH_RAD)
        distance = np.linalg.norm(self.offset)
        horizontal_direction = np.array([np.cos(heading), np.sin(heading)]) * np.cos(pitch)
        return replace(self, offset=distance * np.array([*horizontal_direction, np.sin(pitch)]))

    def zoom(self, factor: float) -> "SceneCamera":
        """Return the camera at 1/``factor`` of its distance from the target, within bounds."""
        distance = float(np.linalg.norm(self.offset))
        new_distance = float(np.clip(distance / factor, _MIN_DISTANCE_M, _MAX_DISTANCE_M))
        ratio = new_distance / distance
        return replace(self, offset=ratio * self.offset, near_m=ratio * self.near_m)

    def pan(self, right: float, up: float, height: float) -> "SceneCamera":
        """Return the camera shifted by ``right`` and ``up`` pixels of the picture.

        ``height`` is the height of the picture, px.
        """
        metres_per_px = np.linalg.norm(self.offset) / compute_focal_length_px(height)
        return replace(
            self, target=self.target + metres_per_px * (right * self.axes[0] + up * self.axes[1])
        )


def compute_focal_length_px(height: float) -> float:
    """Compute the focal length, px, for a picture of the given height, px."""
    return float(height / (2 * _HALF_HEIGHT_RATIO))


def project_to_pixels(points: FloatArray, width: float, height: float) -> FloatArray:
    """Project points (n, 3) in camera coordinates to pixels (n, 2) from the upper left corner."""
    px_per_m = compute_focal_length_px(height) / points[:, 2]
    x_px, y_px = width / 2 + px_per_m * points[:, 0], height / 2 - px_per_m * points[:, 1]
    return np.column_stack([x_px, y_px])
