"""Image model of a tapering pipette near its tip, which is fitted to find the tip.

Let l be the distance along the body from the tip and n the distance across it (px). With the half
width ``h = r + t l`` and the blur σ of a body that leaves the focal plane::

    σ(l)² = σ₀² + β² (z + c l)²
    body(l, n) = ½ [erf((n + h)/√2σ) − erf((n − h)/√2σ)] · ½ [1 + erf((l − e)/√2σ)]

where l is replaced by 0 in h and σ if it is negative. z is the distance of the tip from the focal
plane (m; positive if the body leads away from focus), c is the change of the body's depth per px of
the image, and β is the blur per distance from focus (px/m). The bore is a body of half width
``bore · h``, through which the share ``lumen`` of the absorbed light returns. e (px) shifts the
square end of this model so that it absorbs as much light as the true, rounded end.
"""

from dataclasses import dataclass
from math import cos, erf, exp, pi, sin, sqrt, tan
from typing import Self

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import VisionError
from rotemina.sim.messages import format_fixed

_MAX_APPROACH_RAD = np.radians(80.0)
_INVERSE_ROOT_PI = 1.0 / sqrt(pi)


@dataclass(frozen=True, slots=True)
class Pipette:
    """A pipette in the image of the camera.

    Attributes
    ----------
    direction : float
        Direction of the body from the tip in the image, rad, from columns towards rows.
    radius : float
        Half width at the tip, px.
    taper : float
        Growth of the half width per px of the image along the body.
    climb : float
        Change of the body's depth per px of the image, m.
    sharpest : float
        Blur (σ) in focus, px.
    defocus : float
        Growth of the blur with the distance from focus, far from focus, px/m.
    bore : float
        Ratio of the radius of the bore to that of the tube.
    lumen : float
        Light that returns through the bore, as a share of the light that the tube absorbs; 0 for a
        solid pin.
    end : float
        Distance from the tip, px, of a square end that absorbs as much light as the true end.
    indentation_radius : float
        Distance from the tip within which a cell yields to its pressure, px.
    """

    direction: float
    radius: float
    taper: float
    depth_per_px: float
    sharpest: float = 1.0
    defocus: float = 0.0
    bore: float = 0.6
    lumen: float = 0.5
    end: float = 0.0
    indentation_radius: float = 45.0

    def __post_init__(self) -> None:
        positive_values = {"radius": self.radius, "sharpest": self.sharpest}
        for name, value in positive_values.items():
            if not 0.0 < value < float("inf"):
                raise VisionError(
                    "pipette: {name} = {value} px: must be more than 0", name=name, value=value
                )

    @classmethod
    def from_optics(
        cls,
        direction: float,
        pixel_m: float,
        *,
        approach: float,
        aperture: float,
        tip_radius_m: float = 0.75e-6,
        taper: float = 0.06,
        wavelength_m: float = 550e-9,
        bore: float = 0.6,
        lumen: float = 0.5,
        indentation_radius_m: float = 15e-6,
    ) -> Self:
        """Return the image of a pipette from its dimensions and the optics.

        Parameters
        ----------
        direction : float
            Direction of the body in the image, rad.
        pixel_m : float
            Size of a pixel in the plane of the specimen, m/px.
        approach : float
            Angle between the body and the focal plane, rad.
        aperture : float
            Numerical aperture. The blur is 0.45 NA z far from focus. In focus it is 0.225 λ/NA
            (B. Zhang, J. Zerubia, J.-C. Olivo-Marin, Appl. Opt. 46 (2007)), combined with √(1/12)
            for the pixel.
        tip_radius_m, taper : float
            Radius at the tip, and its growth per length of the body.
        wavelength_m, bore, lumen : float
        indentation_radius_m : float
            Distance from the tip within which a cell yields.

        Raises
        ------
        VisionError
            If the pipette is seen from its end, so that its body is not visible.
        """
        if not abs(approach) <= _MAX_APPROACH_RAD:
            raise VisionError(
                "pipette: its angle to the focal plane is {angle}°, must be at most "
                "{most}°; seen from its end it has no recognisable shape: tilt the view",
                angle=format_fixed(np.degrees(approach), 0),
                most=format_fixed(np.degrees(_MAX_APPROACH_RAD), 0),
            )
        radius = tip_radius_m / pixel_m
        return cls(
            direction=direction,
            radius=radius,
            taper=taper / cos(approach),
            depth_per_px=pixel_m * tan(approach),
            sharpest=sqrt((0.225 * wavelength_m / aperture / pixel_m) ** 2 + 1.0 / 12.0),
            defocus=0.45 * aperture / pixel_m,
            bore=bore,
            lumen=lumen,
            indentation_radius=indentation_radius_m / pixel_m,
        )

    def blur_at(self, depth: FloatArray | float) -> FloatArray:
        """Return the blur (...), px, at distances from focus (...), m."""
        return np.asarray(np.hypot(self.sharpest, self.defocus * np.asarray(depth)))

    def depth_of(self, blur: float) -> float:
        """Return the distance from focus, m and never negative, that causes a blur, px."""
        return sqrt(max(blur**2 - self.sharpest**2, 0.0)) / self.defocus if self.defocus else 0.0

    def draw(
        self, place: FloatArray, depth: float, shape: tuple[int, int], stride: int = 1
    ) -> FloatArray:
        """Return the image of the pipette and its derivatives.

        Parameters
        ----------
        place : (2,)
            Column and row of the tip, px.
        depth : float
            z of the tip, m.
        shape : (int, int)
            Number of rows and columns.
        stride : int
            Distance between rows and between columns, px.

        Returns
        -------
        (6, rows, columns)
            The body minus the light that returns through its bore; the bore; the derivatives of the
            first with respect to column and row of the tip (1/px), depth (1/m) and direction
            (1/rad).
        """
        parameters = np.array(
            [
                cos(self.direction),
                sin(self.direction),
                self.radius,
                self.taper,
                self.depth_per_px,
                self.sharpest,
                self.defocus,
                self.bore,
                self.lumen,
                self.end,
            ]
        )
        out = np.empty((6, *shape))
        _draw_pipette(out, float(place[0]), float(place[1]), depth, parameters, float(stride))
        return out


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def _evaluate_strip(
    across: float, half_width: float, scale: float
) -> tuple[float, float, float, float]:
    """Return the coverage by a blurred strip ±half_width and its derivatives by all arguments."""
    upper, lower = (across + half_width) * scale, (across - half_width) * scale
    upper_slope, lower_slope = (
        _INVERSE_ROOT_PI * exp(-upper * upper),
        _INVERSE_ROOT_PI * exp(-lower * lower),
    )
    return (
        0.5 * (erf(upper) - erf(lower)),
        scale * (upper_slope - lower_slope),
        scale * (upper_slope + lower_slope),
        (across + half_width) * upper_slope - (across - half_width) * lower_slope,
    )


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def _draw_pipette(
    out: FloatArray, column: float, row: float, depth: float, parameters: FloatArray, stride: float
) -> None:
    cosine, sine, radius, taper, climb, sharpest, defocus, bore, lumen, end = parameters
    for i in range(out.shape[1]):
        down = i * stride - row
        for j in range(out.shape[2]):
            right = j * stride - column
            along = cosine * right + sine * down
            across = cosine * down - sine * right
            distance = max(along, 0.0)
            is_on_body = 1.0 if along > 0.0 else 0.0
            half_width = radius + taper * distance
            z = depth + climb * distance
            variance = sharpest * sharpest + defocus * defocus * z * z
            scale = 1.0 / sqrt(2.0 * variance)
            # Derivative of ``scale``, the reciprocal of √2 times the blur. The suffixes _n, _h and
            # _s mark derivatives by ``across``, half width and scale.
            scale_by_depth = -scale * defocus * defocus * z / variance
            wall, wall_n, wall_h, wall_s = _evaluate_strip(across, half_width, scale)
            hole, hole_n, hole_h, hole_s = _evaluate_strip(across, bore * half_width, scale)
            body, body_n = wall - lumen * hole, wall_n - lumen * hole_n
            body_h, body_s = wall_h - lumen * bore * hole_h, wall_s - lumen * hole_s
            end_argument = (along - end) * scale
            end_coverage, end_slope = (
                0.5 + 0.5 * erf(end_argument),
                _INVERSE_ROOT_PI * exp(-end_argument * end_argument),
            )
            by_scale = end_coverage * body_s + body * (along - end) * end_slope
            by_along = (
                body * scale * end_slope
                + is_on_body * end_coverage * body_h * taper
                + is_on_body * by_scale * scale_by_depth * climb
            )
            by_across = end_coverage * body_n
            out[0, i, j] = end_coverage * body
            out[1, i, j] = end_coverage * hole
            out[2, i, j] = sine * by_across - cosine * by_along
            out[3, i, j] = -cosine * by_across - sine * by_along
            out[4, i, j] = by_scale * scale_by_depth
            out[5, i, j] = across * by_along - along * by_across
