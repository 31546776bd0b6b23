"""Drawing of the pin: a tapering tube, each part blurred by its distance from focus.

At n across the body and t along it, with radius R(t), blur s(t), opacity w of the wall, brightening
l by the lumen, and ratio b of inner to outer radius::

    light = 1 − ½ (1 + erf(t / √2 s)) (w C(R) − l C(b R))
    C(R)  = ½ (erf((R − n) / √2 s) + erf((R + n) / √2 s))

This strip model is exact for constant radius and blur, and accurate for a slight taper. A pin seen
within 3° of its axis is drawn as blurred discs; each pixel takes the darkest of them.
"""

from math import cos, exp, hypot, sin, sqrt

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.kernels import Image
from rotemina.sim.microscope.optics import PIXEL_VARIANCE_PX2, MicroscopeOptics
from rotemina.sim.microscope.scene import TaperedPin

# The pin is drawn as discs if the sine of the angle between pin and line of sight is below this.
_END_ON_MAX_SINE = 0.05
# Distances of the discs from the tip. Discs farther away would be too blurred to be seen.
_DISC_DISTANCES_M = (0.0, 5e-6, 10e-6, 20e-6, 40e-6)
_PROFILE_VALUES_PER_PX = 4


def body_direction(pin: TaperedPin, tool_axis: FloatArray) -> FloatArray:
    """Return the unit vector (3,) from the tip along the body.

    The body leans from the tool axis (3,) towards +x by π/2 less the approach angle. It turns with
    the tool axis, by the smallest rotation that takes the z axis to it.
    """
    axis = np.asarray(tool_axis, dtype=np.float64)
    body_of_vertical_tool = np.array([cos(pin.approach_rad), 0.0, sin(pin.approach_rad)])
    # Rodrigues' formula for the rotation e_z → axis, in the form without 1/sin²: it is singular
    # only for axis = −e_z. The rotation vector is e_z × axis.
    rotation = np.array([-axis[1], axis[0], 0.0])
    crossed = np.cross(rotation, body_of_vertical_tool)
    return np.asarray(
        body_of_vertical_tool + crossed + np.cross(rotation, crossed) / (1.0 + axis[2])
    )


def draw_pin(
    light: Image,
    optics: MicroscopeOptics,
    pin: TaperedPin,
    tip_m: FloatArray,
    tool_axis: FloatArray,
    focus_m: float,
) -> None:
    """Darken ``light`` (height, width) by the pin, in place."""
    body = body_direction(pin, tool_axis)
    image_direction = optics.mapping @ body
    tip = optics.pixel_of(tip_m)
    depth = float(optics.depth_of(tip_m)) - focus_m
    foreshortening = hypot(*image_direction) * optics.pixel_m
    if foreshortening < _END_ON_MAX_SINE:
        _draw_discs(light, optics, pin, tip, depth, float(body @ optics.view[2]))
        return
    radius_per_px = pin.taper / foreshortening
    end_radii_px = (pin.tip_radius_m / optics.pixel_m, pin.shank_radius_m / optics.pixel_m)
    direction = image_direction / hypot(*image_direction)
    # Change of depth per px along the body.
    depth_per_px = float(body @ optics.view[2]) * optics.pixel_m / foreshortening
    half_depth = optics.depth_of_field_m / 2.0
    kernels.draw_tube(
        light,
        _float32_row(float(tip[0]), float(tip[1])),
        _float32_row(float(direction[0]), float(direction[1])),
        _float32_row(end_radii_px[0], radius_per_px, end_radii_px[1]),
        _float32_row(depth / half_depth, depth_per_px / half_depth),
        _float32_row(optics.min_blur_px**2, PIXEL_VARIANCE_PX2),
        _float32_row(pin.wall_opacity, pin.lumen_gain, pin.bore_ratio),
    )


def _clip_box(light: Image, first: FloatArray, last: FloatArray) -> tuple[int, int, int, int]:
    """Return row begin, row end, column begin and column end of a box, clipped to the picture.

    ``first`` and ``last`` are corners (u, v). The ends are exclusive.
    """
    limits = light.shape[::-1]
    low = np.floor(first).clip(0, limits).astype(int)
    high = np.ceil(last + 1.0).clip(0, limits).astype(int)
    return int(low[1]), int(high[1]), int(low[0]), int(high[0])


def _draw_discs(
    light: Image,
    optics: MicroscopeOptics,
    pin: TaperedPin,
    tip: FloatArray,
    depth: float,
    depth_per_m: float,
) -> None:
    """Draw a pin that is seen along its body as blurred discs; each pixel takes the darkest one."""
    distances_m = np.array(_DISC_DISTANCES_M)
    radii = (
        np.minimum(pin.tip_radius_m + pin.taper * distances_m, pin.shank_radius_m) / optics.pixel_m
    )
    blurs = optics.blur_px(depth + depth_per_m * distances_m)
    outer_radius_px = float((radii + kernels.BLUR_REACH_SIGMAS * blurs).max())
    distance = np.arange(0.0, outer_radius_px, 1.0 / _PROFILE_VALUES_PER_PX)
    coverage = np.max(
        [
            _compute_disc_coverage(distance, float(r), float(s))
            for r, s in zip(radii, blurs, strict=True)
        ],
        axis=0,
    )
    bore = _compute_disc_coverage(distance, float(radii[0]) * pin.bore_ratio, float(blurs[0]))
    # The interpolation needs two more values without attenuation.
    profile = np.append(1.0 - pin.wall_opacity * coverage + pin.lumen_gain * bore, [1.0, 1.0])
    kernels.draw_radial(
        light,
        _clip_box(light, tip - outer_radius_px, tip + outer_radius_px),
        _float32_row(float(tip[0]), float(tip[1])),
        profile.astype(np.float32),
        np.float32(_PROFILE_VALUES_PER_PX),
    )


def _compute_disc_coverage(distance: FloatArray, radius: float, blur: float) -> FloatArray:
    """Return the coverage by a disc with Gaussian blur at distances (n,) from its centre.

    It is exact at the centre, ``1 − exp(−R²/2σ²)``, and at the edge for R ≫ σ, where it becomes
    that of a half plane.
    """
    scale = 1.0 / (sqrt(2.0) * blur)
    strip = 0.5 * (
        scipy.special.erf((radius - distance) * scale)
        + scipy.special.erf((radius + distance) * scale)
    )
    return np.asarray(
        strip * (1.0 - exp(-((radius * scale) ** 2))) / scipy.special.erf(radius * scale)
    )


def _float32_row(*values: float) -> Image:
    return np.array(values, dtype=np.float32)
