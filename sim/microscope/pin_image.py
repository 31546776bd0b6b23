"""The pin as it is seen: a tapering tube, blurred by how far each part is from focus.

At n across the body and t along it, with radius R(t), blur s(t), wall w, lumen l and bore b::

    light = 1 − ½ (1 + erf(t / √2 s)) (w C(R) − l C(b R))
    C(R)  = ½ (erf((R − n) / √2 s) + erf((R + n) / √2 s))

The strip is exact for constant radius and blur, and close for a slight taper. A pin seen within 3°
of its axis is drawn as blurred discs, of which the darkest counts.
"""

from math import cos, exp, hypot, sin, sqrt

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.kernels import Image
from rotemina.sim.microscope.optics import PIXEL_VARIANCE, Optics
from rotemina.sim.microscope.scene import Pin

_END_ON = 0.05  # sine of the angle between pin and view below which it is drawn as rings
_SECTIONS_M = (0.0, 5e-6, 10e-6, 20e-6, 40e-6)  # farther ones are no more than a shade
_FINE = 4  # values of the rings' profile per px


def body_direction(pin: Pin, tool_axis: FloatArray) -> FloatArray:
    """Return the unit vector (3,) from the tip along the body.

    The body leans from the tool axis (3,) towards +x by what the approach angle lacks to a right
    one, and turns with the axis: by the smallest rotation that takes the z axis to it.
    """
    axis = np.asarray(tool_axis, dtype=np.float64)
    rest = np.array([cos(pin.approach_rad), 0.0, sin(pin.approach_rad)])
    # Rodrigues' formula for the rotation e_z → axis, without its singular form.
    turn = np.array([-axis[1], axis[0], 0.0])  # e_z × axis
    crossed = np.cross(turn, rest)
    return np.asarray(rest + crossed + np.cross(turn, crossed) / (1.0 + axis[2]))


def draw_pin(
    light: Image, optics: Optics, pin: Pin, tip_m: FloatArray, tool_axis: FloatArray, focus_m: float
) -> None:
    """Darken ``light`` (height, width) by the pin, in place."""
    body = body_direction(pin, tool_axis)
    way = optics.mapping @ body
    tip = optics.pixel_of(tip_m)
    away = float(optics.depth_of(tip_m)) - focus_m
    seen = hypot(*way) * optics.pixel_m  # foreshortening
    if seen < _END_ON:
        _draw_rings(light, optics, pin, tip, away, float(body @ optics.view[2]))
        return
    growth = pin.taper / seen
    ends = (pin.tip_radius_m / optics.pixel_m, pin.shank_radius_m / optics.pixel_m)
    direction = way / hypot(*way)
    rise = float(body @ optics.view[2]) * optics.pixel_m / seen  # depth per px
    half_depth = optics.depth_of_field_m / 2.0
    kernels.draw_tube(
        light,
        _row(float(tip[0]), float(tip[1])),
        _row(float(direction[0]), float(direction[1])),
        _row(ends[0], growth, ends[1]),
        _row(away / half_depth, rise / half_depth),
        _row(optics.sharpest_px**2, PIXEL_VARIANCE),
        _row(pin.wall, pin.lumen, pin.bore),
    )


def _clipped(light: Image, first: FloatArray, last: FloatArray) -> tuple[int, int, int, int]:
    """Return what of a box between two places (u, v) is in the picture: rows and columns."""
    most = light.shape[::-1]
    low = np.floor(first).clip(0, most).astype(int)
    high = np.ceil(last + 1.0).clip(0, most).astype(int)
    return int(low[1]), int(high[1]), int(low[0]), int(high[0])


def _draw_rings(
    light: Image, optics: Optics, pin: Pin, tip: FloatArray, away: float, along: float
) -> None:
    """Draw a pin that is seen along its body: each section a blurred disc, the darkest counts."""
    sections = np.array(_SECTIONS_M)
    radii = np.minimum(pin.tip_radius_m + pin.taper * sections, pin.shank_radius_m) / optics.pixel_m
    blurs = optics.blur_px(away + along * sections)
    reach = float((radii + kernels.REACH * blurs).max())
    distance = np.arange(0.0, reach, 1.0 / _FINE)
    covered = np.max(
        [_disc(distance, float(r), float(s)) for r, s in zip(radii, blurs, strict=True)], axis=0
    )
    bore = _disc(distance, float(radii[0]) * pin.bore, float(blurs[0]))
    profile = np.append(1.0 - pin.wall * covered + pin.lumen * bore, [1.0, 1.0])
    kernels.draw_radial(
        light,
        _clipped(light, tip - reach, tip + reach),
        _row(float(tip[0]), float(tip[1])),
        profile.astype(np.float32),
        np.float32(_FINE),
    )


def _disc(distance: FloatArray, radius: float, blur: float) -> FloatArray:
    """Return a disc blurred by a Gaussian, at distances (n,) from its middle.

    Exact in the middle, ``1 − exp(−R²/2σ²)``, and the edge of a half plane for R ≫ σ.
    """
    share = 1.0 / (sqrt(2.0) * blur)
    strip = 0.5 * (
        scipy.special.erf((radius - distance) * share)
        + scipy.special.erf((radius + distance) * share)
    )
    return np.asarray(
        strip * (1.0 - exp(-((radius * share) ** 2))) / scipy.special.erf(radius * share)
    )


def _row(*values: float) -> Image:
    return np.array(values, dtype=np.float32)
