"""What a tapering pipette looks like near its tip: the model that the tip is found by.

With l along the body from the tip and n across it (px), a half width ``h = r + t l`` and the blur
of a body that climbs out of focus::

    σ(l)² = σ₀² + β² (z + c l)²
    body(l, n) = ½ [erf((n + h)/√2σ) − erf((n − h)/√2σ)] · ½ [1 + erf((l − e)/√2σ)]

with l no less than 0 in h and σ. z is the tip's distance from the focal plane (m; positive where
the body leads away from focus), c what the body climbs per px of the image, β the blur of a defocus
(px/m). Through the bore, a body of ``bore · h``, comes back the share ``lumen`` of the light. e
(px) makes the square end of this model stand where a rounded end of the same light does.
"""

from dataclasses import dataclass
from math import cos, erf, exp, pi, sin, sqrt, tan
from typing import Self

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.vision.errors import VisionError

_STEEPEST = np.radians(80.0)
_ROOT_PI = 1.0 / sqrt(pi)


@dataclass(frozen=True, slots=True)
class Pipette:
    """A pipette as the camera sees it.

    Attributes
    ----------
    direction : float
        Where the body leads in the image, seen from the tip, rad, from columns towards rows.
    radius : float
        At the tip, px.
    taper : float
        By which the half width grows per px of the image along the body.
    climb : float
        By how much the body's depth changes per px of the image, m.
    sharpest : float
        Blur (σ) in focus, px.
    defocus : float
        What a distance from focus adds, far from it, px/m.
    bore : float
        Radius of the bore, over that of the tube.
    lumen : float
        What comes back through it, as a share of the light that the tube takes; 0 for a solid pin.
    end : float
        Where a square end would stand, px from the tip, for the light of the true one.
    yielding : float
        How far about the tip a cell that it presses on gives way, px.
    """

    direction: float
    radius: float
    taper: float
    climb: float
    sharpest: float = 1.0
    defocus: float = 0.0
    bore: float = 0.6
    lumen: float = 0.5
    end: float = 0.0
    yielding: float = 45.0

    def __post_init__(self) -> None:
        least = {"radius": self.radius, "sharpest": self.sharpest}
        for name, value in least.items():
            if not 0.0 < value < float("inf"):
                raise VisionError(
                    message("engine", "pipette: {name} = {value} px: must be more than 0").fill(
                        name=name, value=value
                    )
                )

    @classmethod
    def seen(
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
        yielding_m: float = 15e-6,
    ) -> Self:
        """Return how a pipette of this make is seen.

        Parameters
        ----------
        direction : float
            rad in the image.
        pixel_m : float
            m/px.
        approach : float
            Angle between the body and the focal plane, rad.
        aperture : float
            Numerical aperture: blur far from focus is 0.45 NA z, in focus 0.225 λ/NA (B. Zhang,
            J. Zerubia, J.-C. Olivo-Marin, Appl. Opt. 46 (2007)) and a pixel's own √(1/12).
        tip_radius_m, taper : float
            Radius at the tip, and its growth per length of the body.
        wavelength_m, bore, lumen : float
        yielding_m : float
            How far about the tip a cell gives way.

        Raises
        ------
        VisionError
            If it is seen so much from its end that no body shows.
        """
        if not abs(approach) <= _STEEPEST:
            raise VisionError(
                message(
                    "engine",
                    "pipette: its angle to the focal plane is {angle}°, must be at most "
                    "{most}°; seen from its end it has no recognisable shape: tilt the view",
                ).fill(
                    angle=fixed(np.degrees(approach), 0),
                    most=fixed(np.degrees(_STEEPEST), 0),
                )
            )
        radius = tip_radius_m / pixel_m
        return cls(
            direction=direction,
            radius=radius,
            taper=taper / cos(approach),
            climb=pixel_m * tan(approach),
            sharpest=sqrt((0.225 * wavelength_m / aperture / pixel_m) ** 2 + 1.0 / 12.0),
            defocus=0.45 * aperture / pixel_m,
            bore=bore,
            lumen=lumen,
            yielding=yielding_m / pixel_m,
        )

    def blur(self, depth: FloatArray | float) -> FloatArray:
        """Return the blur (...), px, at distances from focus (...), m."""
        return np.asarray(np.hypot(self.sharpest, self.defocus * np.asarray(depth)))

    def depth_of(self, blur: float) -> float:
        """Return the distance from focus, m and never negative, that blurs so much (px)."""
        return sqrt(max(blur**2 - self.sharpest**2, 0.0)) / self.defocus if self.defocus else 0.0

    def drawn(
        self, place: FloatArray, depth: float, shape: tuple[int, int], stride: int = 1
    ) -> FloatArray:
        """Return the pipette and how it changes, (6, rows, columns).

        Parameters
        ----------
        place : (2,)
            Column and row of the tip, px.
        depth : float
            z of the tip, m.
        shape : (int, int)
            Rows and columns.
        stride : int
            Distance between them, px.

        Returns
        -------
        (6, rows, columns)
            Body less what its bore lets through; the bore; the first one's derivatives by column
            and row of the tip (1/px), by the depth (1/m) and by the direction (1/rad).
        """
        figures = np.array(
            [
                cos(self.direction),
                sin(self.direction),
                self.radius,
                self.taper,
                self.climb,
                self.sharpest,
                self.defocus,
                self.bore,
                self.lumen,
                self.end,
            ]
        )
        out = np.empty((6, *shape))
        _draw(out, float(place[0]), float(place[1]), depth, figures, float(stride))
        return out


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def _strip(across: float, half: float, share: float) -> tuple[float, float, float, float]:
    """Return a strip −half…half seen at ``across`` and its derivatives by all three."""
    upper, lower = (across + half) * share, (across - half) * share
    rise, fall = _ROOT_PI * exp(-upper * upper), _ROOT_PI * exp(-lower * lower)
    return (
        0.5 * (erf(upper) - erf(lower)),
        share * (rise - fall),
        share * (rise + fall),
        (across + half) * rise - (across - half) * fall,
    )


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def _draw(
    out: FloatArray, column: float, row: float, depth: float, figures: FloatArray, stride: float
) -> None:
    cosine, sine, radius, taper, climb, sharpest, defocus, bore, lumen, end = figures
    for i in range(out.shape[1]):
        down = i * stride - row
        for j in range(out.shape[2]):
            right = j * stride - column
            along = cosine * right + sine * down
            across = cosine * down - sine * right
            inside = max(along, 0.0)
            growth = 1.0 if along > 0.0 else 0.0
            half = radius + taper * inside
            away = depth + climb * inside
            variance = sharpest * sharpest + defocus * defocus * away * away
            share = 1.0 / sqrt(2.0 * variance)
            by_depth = -share * defocus * defocus * away / variance  # of share
            wall, wall_n, wall_h, wall_s = _strip(across, half, share)
            hole, hole_n, hole_h, hole_s = _strip(across, bore * half, share)
            body, body_n = wall - lumen * hole, wall_n - lumen * hole_n
            body_h, body_s = wall_h - lumen * bore * hole_h, wall_s - lumen * hole_s
            ahead = (along - end) * share
            begun, edge = 0.5 + 0.5 * erf(ahead), _ROOT_PI * exp(-ahead * ahead)
            by_share = begun * body_s + body * (along - end) * edge
            by_along = (
                body * share * edge
                + growth * begun * body_h * taper
                + growth * by_share * by_depth * climb
            )
            by_across = begun * body_n
            out[0, i, j] = begun * body
            out[1, i, j] = begun * hole
            out[2, i, j] = sine * by_across - cosine * by_along
            out[3, i, j] = -cosine * by_across - sine * by_along
            out[4, i, j] = by_share * by_depth
            out[5, i, j] = across * by_along - along * by_across
