"""Optics of the simulated microscope: the image position and the blur of a point.

The view is orthographic, as through a telecentric objective. A point p is seen at the pixel
``(u, v) = middle + offset + R(rotation) S(skew) H (right·(p − centre), down·(p − centre)) / pitch``
and lies at the depth ``forward·(p − centre)``. The unit vectors right, down, forward of the view
form a right-handed frame. R turns right towards down, ``S = [[1, sin skew], [0, cos skew]]``, and H
mirrors u. Pixel (0, 0) is the centre of the first pixel; u counts columns, v rows.
"""

from dataclasses import dataclass
from functools import cached_property
from math import cos, isfinite, pi, sin
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.errors import SceneError
from rotemina.sim.kinematics import KinematicChain, compute_tip_position
from rotemina.sim.robot import Robot

WAVELENGTH_M = 550e-9
# Standard deviation of the Gaussian that best fits the Airy disc, in units of wavelength /
# aperture: Zhang, Zerubia and Olivo-Marin, Appl. Opt. 46 (2007) 1819, for a wide field and a small
# aperture.
_AIRY_SIGMA_RATIO = 0.225
#: Variance of a uniform distribution over one pixel, px².
PIXEL_VARIANCE_PX2 = 1.0 / 12.0

#: Camera and objective if the robot file names none: AxioCam HRm behind 20× / 0.4.
DEFAULT_WIDTH_PX, DEFAULT_HEIGHT_PX = 1300, 1030
DEFAULT_PIXEL_SIZE_M, DEFAULT_MAGNIFICATION, DEFAULT_APERTURE = 6.7e-6, 20.0, 0.4

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class MicroscopeOptics:
    """View of a microscope and its camera on the specimen.

    Attributes
    ----------
    centre_m : tuple of float
        Point in the middle of the picture of an unshifted camera, at depth 0, m.
    axis : tuple of float
        Direction of view, of any length; (0, 0, 1) for an inverted microscope, from below.
    pixel_m : float
        Distance in the specimen from pixel to pixel, m: pixel size over magnification.
    aperture : float
        Numerical aperture.
    depth_of_field_m : float
        Twice the distance from the focal plane at which the blur has grown by √2, m.
    width, height : int
        Size of the picture, px.
    rotation_rad, skew_rad, mirrored, offset_px
        Mounting of the camera, which a calibration has to determine.
    """

    centre_m: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    pixel_m: float = DEFAULT_PIXEL_SIZE_M / DEFAULT_MAGNIFICATION
    aperture: float = DEFAULT_APERTURE
    depth_of_field_m: float = WAVELENGTH_M / DEFAULT_APERTURE**2
    width: int = DEFAULT_WIDTH_PX
    height: int = DEFAULT_HEIGHT_PX
    rotation_rad: float = 0.0
    skew_rad: float = 0.0
    mirrored: bool = False
    offset_px: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        for name in ("pixel_m", "aperture", "depth_of_field_m", "width", "height"):
            value = getattr(self, name)
            if not (isfinite(value) and value > 0):
                raise SceneError(
                    "microscope: {name} = {value}: must be more than 0", name=name, value=value
                )
        if not 0.0 < float(np.linalg.norm(self.axis)) < float("inf"):
            raise SceneError(
                "microscope: optical_axis = {axis}: must be a direction, for example [0.0, "
                "0.0, 1.0] for a view from below",
                axis=str(list(self.axis)),
            )
        if not abs(self.skew_rad) < pi / 4:
            raise SceneError(
                "microscope: skew {skew_rad} rad: must be within ±{pi}",
                skew_rad=self.skew_rad,
                pi=pi / 4,
            )

    @classmethod
    def of(cls, robot: Robot, **mounting: object) -> Self:
        """Return the microscope of a robot file, with defaults for values that the file leaves out.

        The centre is the position of the tip with every joint at mid-range. Fields given by name
        take precedence. The default depth of field is ``λ / NA²`` (Inoué and Spring, Video
        Microscopy, 2nd ed. (1997), ch. 2).

        Raises
        ------
        ChainError
            If the robot has no tip.
        SceneError
            If a value is out of range.
        """
        section = robot.microscope
        chain = KinematicChain.of(robot)
        aperture = section.numerical_aperture or DEFAULT_APERTURE
        pixel_m = (section.pixel_size or DEFAULT_PIXEL_SIZE_M) / (
            section.magnification or DEFAULT_MAGNIFICATION
        )
        values: dict[str, object] = {
            "centre_m": tuple(float(x) for x in compute_tip_position(chain, chain.centre)),
            "axis": section.optical_axis or (0.0, 0.0, 1.0),
            "pixel_m": pixel_m,
            "aperture": aperture,
            "depth_of_field_m": section.depth_of_field or WAVELENGTH_M / aperture**2,
        }
        # The constructor checks the names, which mypy cannot do here.
        return cls(**(values | mounting))  # type: ignore[arg-type]

    @cached_property
    def view(self) -> FloatArray:
        """The unit vectors right, down, forward of the view, (3, 3), one in each row."""
        forward = np.array(self.axis, dtype=np.float64)
        forward /= np.linalg.norm(forward)
        # The x table moves to the right in the picture, or the y table if the view is along x.
        reference = np.eye(3)[0] if abs(forward[0]) < 0.99 else np.eye(3)[1]
        right = reference - (reference @ forward) * forward
        right /= np.linalg.norm(right)
        return make_read_only(np.stack([right, np.cross(forward, right), forward]))

    @cached_property
    def mapping(self) -> FloatArray:
        """Derivative (2, 3), px/m, of the image position by the position of a point."""
        c, s = cos(self.rotation_rad), sin(self.rotation_rad)
        skew = np.array([[1.0, sin(self.skew_rad)], [0.0, cos(self.skew_rad)]])
        mirror = np.diag([-1.0 if self.mirrored else 1.0, 1.0])
        mounting = np.array([[c, -s], [s, c]]) @ skew @ mirror
        return make_read_only(mounting @ self.view[:2] / self.pixel_m)

    @property
    def middle_px(self) -> FloatArray:
        """Image position (2,), px, of ``centre_m``."""
        half = (np.array([self.width, self.height], dtype=np.float64) - 1.0) / 2.0
        return np.asarray(half + np.array(self.offset_px))

    def pixel_of(self, point_m: FloatArray) -> FloatArray:
        """Return the pixels (u, v) (..., 2) at which points (..., 3), m, are seen."""
        offset = np.asarray(point_m, dtype=np.float64) - np.array(self.centre_m)
        return np.asarray(self.middle_px + offset @ self.mapping.T)

    def depth_of(self, point_m: FloatArray) -> FloatArray:
        """Return the depths (...), m, of points (..., 3) behind ``centre_m`` along the view."""
        offset = np.asarray(point_m, dtype=np.float64) - np.array(self.centre_m)
        return np.asarray(offset @ self.view[2])

    def blur_px(self, distance_m: FloatArray | float) -> FloatArray:
        """Return the blur (...), px, of a point at distances from the focal plane.

        The blur is the standard deviation
        ``σ² = σ₀² (1 + (2 z / depth of field)²) + 1/12``, ``σ₀ = 0.225 λ / NA``. The last term is
        the variance of the pixel. Far from focus σ is 0.45 NA |z|, which is close to NA |z| / 2,
        the standard deviation of a disc in geometrical optics.
        """
        defocus = 2.0 * np.asarray(distance_m, dtype=np.float64) / self.depth_of_field_m
        return np.asarray(np.sqrt(self.min_blur_px**2 * (1.0 + defocus**2) + PIXEL_VARIANCE_PX2))

    @property
    def min_blur_px(self) -> float:
        """Blur that diffraction alone causes in the focal plane, px."""
        return _AIRY_SIGMA_RATIO * WAVELENGTH_M / self.aperture / self.pixel_m
