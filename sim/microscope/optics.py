"""From the specimen to the pixel: where a point is seen, and how blurred.

The view is orthographic, as through a telecentric objective. A point p is seen at the pixel
``(u, v) = middle + offset + R(rotation) S(skew) H (right·(p − centre), down·(p − centre)) / pitch``
and lies at the depth ``forward·(p − centre)``, with the view's unit vectors right, down, forward:
a right-handed frame. R turns right towards down, ``S = [[1, sin skew], [0, cos skew]]``, and H
mirrors u. Pixel (0, 0) is the middle of the first one; u counts columns, v rows.
"""

from dataclasses import dataclass
from functools import cached_property
from math import cos, isfinite, pi, sin
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.messages import message
from rotemina.sim.microscope.errors import SceneError
from rotemina.sim.robot.model import Robot

WAVELENGTH_M = 550e-9
# Standard deviation of the Gaussian nearest to the Airy disc, over wavelength / aperture: Zhang,
# Zerubia and Olivo-Marin, Appl. Opt. 46 (2007) 1819, for a wide field and a small aperture.
_AIRY_SIGMA = 0.225
#: Of light that falls anywhere on a pixel, px².
PIXEL_VARIANCE = 1.0 / 12.0

#: The camera and objective where a robot file names none: AxioCam HRm behind 20× / 0.4.
WIDTH, HEIGHT = 1300, 1030
PIXEL_SIZE_M, MAGNIFICATION, APERTURE = 6.7e-6, 20.0, 0.4

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Optics:
    """How a microscope with its camera looks at the specimen.

    Attributes
    ----------
    centre_m : tuple of float
        What is seen in the middle of an unshifted camera, and lies at depth 0, m.
    axis : tuple of float
        Which way it looks; (0, 0, 1) is an inverted microscope, from below. Of any length.
    pixel_m : float
        Distance in the specimen from pixel to pixel, m: pixel size over magnification.
    aperture : float
        Numerical aperture.
    depth_of_field_m : float
        Twice the distance from the focal plane at which the blur has grown by √2, m.
    width, height : int
        Of the picture, px.
    rotation_rad, skew_rad, mirrored, offset_px
        How the camera is mounted: what a calibration has to find out.
    """

    centre_m: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    pixel_m: float = PIXEL_SIZE_M / MAGNIFICATION
    aperture: float = APERTURE
    depth_of_field_m: float = WAVELENGTH_M / APERTURE**2
    width: int = WIDTH
    height: int = HEIGHT
    rotation_rad: float = 0.0
    skew_rad: float = 0.0
    mirrored: bool = False
    offset_px: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("pixel_m", "aperture", "depth_of_field_m", "width", "height"):
            value = getattr(self, name)
            if not (isfinite(value) and value > 0):
                raise SceneError(
                    message("engine", "microscope: {name} = {value}: must be more than 0").fill(
                        name=name, value=value
                    )
                )
        if not 0.0 < float(np.linalg.norm(self.axis)) < float("inf"):
            raise SceneError(
                message(
                    "engine",
                    "microscope: optical_axis = {axis}: must be a direction, for example [0.0, "
                    "0.0, 1.0] for a view from below",
                ).fill(axis=str(list(self.axis)))
            )
        if not abs(self.skew_rad) < pi / 4:
            raise SceneError(
                message("engine", "microscope: skew {skew_rad} rad: must be within ±{pi}").fill(
                    skew_rad=self.skew_rad, pi=pi / 4
                )
            )

    @classmethod
    def of(cls, robot: Robot, **mounting: object) -> Self:
        """Return the microscope of a robot file, with what it leaves out filled in.

        Its middle is where the tip is with every joint in mid-range; fields given by name take
        precedence. Without a depth of field it is ``λ / NA²`` (Inoué and Spring, Video Microscopy,
        2nd ed. (1997), ch. 2).

        Raises
        ------
        ChainError
            If the robot has no tip.
        SceneError
            If the values make no microscope.
        """
        given = robot.microscope
        chain = Chain.of(robot)
        aperture = given.numerical_aperture or APERTURE
        pixel_m = (given.pixel_size or PIXEL_SIZE_M) / (given.magnification or MAGNIFICATION)
        values: dict[str, object] = {
            "centre_m": tuple(float(x) for x in tip_position(chain, chain.centre)),
            "axis": given.optical_axis or (0.0, 0.0, 1.0),
            "pixel_m": pixel_m,
            "aperture": aperture,
            "depth_of_field_m": given.depth_of_field or WAVELENGTH_M / aperture**2,
        }
        return cls(**(values | mounting))  # type: ignore[arg-type]  # checked by their names

    @cached_property
    def view(self) -> FloatArray:
        """The unit vectors right, down, forward of the view, (3, 3) by rows."""
        forward = np.array(self.axis, dtype=np.float64)
        forward /= np.linalg.norm(forward)
        # The x table moves to the right, unless the view is along it; then y does.
        ahead = np.eye(3)[0] if abs(forward[0]) < 0.99 else np.eye(3)[1]
        right = ahead - (ahead @ forward) * forward
        right /= np.linalg.norm(right)
        return read_only(np.stack([right, np.cross(forward, right), forward]))

    @cached_property
    def mapping(self) -> FloatArray:
        """Pixels per metre (2, 3): how a pixel moves with a point of the specimen."""
        c, s = cos(self.rotation_rad), sin(self.rotation_rad)
        skew = np.array([[1.0, sin(self.skew_rad)], [0.0, cos(self.skew_rad)]])
        mirror = np.diag([-1.0 if self.mirrored else 1.0, 1.0])
        mounted = np.array([[c, -s], [s, c]]) @ skew @ mirror
        return read_only(mounted @ self.view[:2] / self.pixel_m)

    @property
    def middle_px(self) -> FloatArray:
        """Where ``centre_m`` is seen, (2,)."""
        half = (np.array([self.width, self.height], dtype=np.float64) - 1.0) / 2.0
        return np.asarray(half + np.array(self.offset_px))

    def pixel_of(self, point_m: FloatArray) -> FloatArray:
        """Return the pixels (u, v) (..., 2) at which points (..., 3), m, are seen."""
        away = np.asarray(point_m, dtype=np.float64) - np.array(self.centre_m)
        return np.asarray(self.middle_px + away @ self.mapping.T)

    def depth_of(self, point_m: FloatArray) -> FloatArray:
        """Return how far points (..., 3) lie behind ``centre_m``, along the view, (...), m."""
        away = np.asarray(point_m, dtype=np.float64) - np.array(self.centre_m)
        return np.asarray(away @ self.view[2])

    def blur_px(self, distance_m: FloatArray | float) -> FloatArray:
        """Return the standard deviation (...), px, of a point's image at distances from focus.

        ``σ² = σ₀² (1 + (2 z / depth of field)²) + 1/12``, ``σ₀ = 0.225 λ / NA``, the last term
        being the pixel itself. Far from focus this is 0.45 NA |z|, which is nearly the NA |z| / 2
        of a disc in geometrical optics.
        """
        spread = 2.0 * np.asarray(distance_m, dtype=np.float64) / self.depth_of_field_m
        return np.asarray(np.sqrt(self.sharpest_px**2 * (1.0 + spread**2) + PIXEL_VARIANCE))

    @property
    def sharpest_px(self) -> float:
        """The blur that diffraction alone leaves in the focal plane, px."""
        return _AIRY_SIGMA * WAVELENGTH_M / self.aperture / self.pixel_m
