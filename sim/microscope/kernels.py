"""Compiled loops over pixels. Distances are in px, light in photoelectrons, single precision.

They release the interpreter lock. Otherwise a window would stutter while a picture is drawn.
"""

import numba
import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float32]
PixelValues = NDArray[np.uint16]

#: A blurred edge is drawn up to this distance from it, in standard deviations of the blur.
BLUR_REACH_SIGMAS = 4.0

_BLUR_REACH_SIGMAS = np.float32(BLUR_REACH_SIGMAS)
# Pixels of a row that are drawn or skipped together.
_BLOCK_PX = 32

_ROOT_HALF = np.float32(0.7071067811865476)
_ONE, _HALF, _ZERO, _MAX_ERF_ARGUMENT = (
    np.float32(1.0),
    np.float32(0.5),
    np.float32(0.0),
    np.float32(4.0),
)
# Coefficients of the error function by Abramowitz and Stegun, Handbook of Mathematical Functions
# (1964), 7.1.28. The error is below 3e-7.
_ERF_COEFFICIENTS = tuple(
    np.float32(a)
    for a in (0.0705230784, 0.0422820123, 0.0092705272, 0.0001520143, 0.0002765672, 0.0000430638)
)


@numba.njit(cache=True, inline="always", error_model="numpy", fastmath=True)
def _erf(x: np.float32) -> np.float32:
    """Return the error function.

    It has no branch, so that the compiler can vectorise the loop around it.
    """
    # Beyond this argument the result stays the same. The limit keeps the powers finite.
    y = min(abs(x), _MAX_ERF_ARGUMENT)
    p = y * (
        _ERF_COEFFICIENTS[0]
        + y
        * (
            _ERF_COEFFICIENTS[1]
            + y
            * (
                _ERF_COEFFICIENTS[2]
                + y * (_ERF_COEFFICIENTS[3] + y * (_ERF_COEFFICIENTS[4] + y * _ERF_COEFFICIENTS[5]))
            )
        )
    )
    p = p + _ONE
    p2 = p * p
    p4 = p2 * p2
    p8 = p4 * p4
    value = _ONE - _ONE / (p8 * p8)
    return value if x >= _ZERO else -value


@numba.njit(cache=True, inline="always", error_model="numpy", fastmath=True)
def _strip_coverage(across: np.float32, radius: np.float32, scale: np.float32) -> np.float32:
    """Return the coverage at ``across`` by a blurred strip ±radius; ``scale`` is 1/(√2 σ)."""
    return np.float32(_HALF * (_erf((radius - across) * scale) + _erf((radius + across) * scale)))


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def draw_tube(
    light: Image,
    tip: Image,
    direction: Image,
    radius: Image,
    depth: Image,
    blur: Image,
    opacity: Image,
) -> None:
    """Darken ``light`` (rows, columns) by a tapering tube, in place.

    Pixels far from the tube are skipped.

    Parameters
    ----------
    light : (rows, columns)
    tip : (2,)
        Column and row of the tip.
    direction : (2,)
        Unit vector of the body in the image.
    radius : (3,)
        Radius at the tip, its growth per px, and its maximum, px.
    depth : (2,)
        Depth of the tip in units of half the depth of field, and its change per px.
    blur : (2,)
        Variance of the blur in focus without the pixel, and that of the pixel, px².
    opacity : (3,)
        Share of the light lost in the tube, share regained through its bore, and ratio of the
        radius of the bore to that of the tube.
    """
    # The arrays are unpacked before the loop, because the compiler could not exclude that they
    # change inside it.
    u0, v0, eu, ev = tip[0], tip[1], direction[0], direction[1]
    tip_radius, radius_per_px, max_radius = radius[0], radius[1], radius[2]
    tip_depth, depth_per_px, airy_variance, pixel_variance = depth[0], depth[1], blur[0], blur[1]
    wall_opacity, lumen_gain, bore_ratio = opacity[0], opacity[1], opacity[2]
    # An edge can be nearer to a pixel of a block than to the middle of the block by this much.
    block_slack = (
        _HALF
        * np.float32(_BLOCK_PX)
        * (_ONE + radius_per_px + _BLUR_REACH_SIGMAS * np.sqrt(airy_variance) * abs(depth_per_px))
    )
    for row in range(light.shape[0]):
        dv = np.float32(row) - v0
        for first in range(0, light.shape[1], _BLOCK_PX):
            du = np.float32(first + _BLOCK_PX // 2) - u0
            along, across = du * eu + dv * ev, abs(dv * eu - du * ev) - block_slack
            distance = max(along, _ZERO)
            z = tip_depth + depth_per_px * distance
            blur_reach = _BLUR_REACH_SIGMAS * np.sqrt(
                airy_variance * (_ONE + z * z) + pixel_variance
            )
            if (
                along + block_slack < -blur_reach
                or across > min(tip_radius + radius_per_px * distance, max_radius) + blur_reach
            ):
                continue
            line = light[row][first : first + _BLOCK_PX]
            u = np.float32(first) - u0
            # Indices of 64 bits would prevent vectorisation.
            for column in range(np.int32(line.shape[0])):
                du = np.float32(np.int32(column)) + u
                along = du * eu + dv * ev
                across = dv * eu - du * ev
                distance = max(along, _ZERO)
                local_radius = min(tip_radius + radius_per_px * distance, max_radius)
                z = tip_depth + depth_per_px * distance
                scale = _ROOT_HALF / np.sqrt(airy_variance * (_ONE + z * z) + pixel_variance)
                tube = _strip_coverage(across, local_radius, scale)
                bore = _strip_coverage(across, local_radius * bore_ratio, scale)
                end_coverage = _HALF * (_ONE + _erf(along * scale))
                line[column] *= _ONE - end_coverage * (wall_opacity * tube - lumen_gain * bore)


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def draw_radial(
    light: Image,
    box: tuple[int, int, int, int],
    centre: Image,
    profile: Image,
    per_px: np.float32,
) -> None:
    """Darken ``light`` (rows, columns) by a ``profile`` (n,) of the distance from ``centre``.

    Parameters
    ----------
    light : (rows, columns)
    box : (int, int, int, int)
        First and last row, first and last column to draw. The last ones are excluded.
    centre : (2,)
        Column and row.
    profile : (n,)
        Transmission over the distance. Its last value holds for larger distances.
    per_px : float
        Values of the profile per px.
    """
    last_position = np.float32(profile.shape[0] - 2)
    for row in range(box[0], box[1]):
        dv = np.float32(row) - centre[1]
        for column in range(box[2], box[3]):
            du = np.float32(column) - centre[0]
            position = min(np.sqrt(du * du + dv * dv) * per_px, last_position)
            index = np.int32(position)
            fraction = position - np.float32(index)
            light[row, column] *= profile[index] * (_ONE - fraction) + profile[index + 1] * fraction


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def distance_outside(outline: Image, centre: Image, shape: tuple[int, int]) -> Image:
    """Return the distances (shape), px, of pixels from an outline; negative inside.

    ``outline`` (n,) contains its distances from ``centre`` at n equally spaced angles from 0 on.
    """
    out = np.empty(shape, np.float32)
    count = outline.shape[0]
    per_rad = np.float32(count / (2.0 * np.pi))
    for row in range(shape[0]):
        dv = np.float32(row) - centre[1]
        for column in range(shape[1]):
            du = np.float32(column) - centre[0]
            position = np.arctan2(dv, du) * per_rad
            if position < _ZERO:
                position += np.float32(count)
            index = np.int32(position)
            fraction = position - np.float32(index)
            before, after = outline[index % count], outline[(index + 1) % count]
            radius = before * (_ONE - fraction) + after * fraction
            out[row, column] = np.sqrt(du * du + dv * dv) - radius
    return out


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def expose(
    light: Image,
    noise: Image,
    begins: NDArray[np.int64],
    scale: np.float32,
    full_well: np.float32,
    read_variance: np.float32,
    gain: np.float32,
    black: np.float32,
    max_value: np.float32,
) -> PixelValues:
    """Return the pixel values for ``light`` (rows, columns).

    ``light`` times ``scale`` is in photoelectrons. Shot noise has a normal distribution of variance
    N, which is close to Poisson's distribution for the hundreds of electrons in a pixel. The noise
    of a row begins at the index ``begins`` (rows,) of the sequence ``noise``.
    """
    pixel_values = np.empty(light.shape, np.uint16)
    for row in range(light.shape[0]):
        line, row_values, row_noise = light[row], pixel_values[row], noise[begins[row] :]
        for column in range(line.shape[0]):
            electrons = line[column] * scale
            electrons += np.sqrt(electrons + read_variance) * row_noise[column]
            pixel_value = min(electrons, full_well) * gain + black + _HALF
            row_values[column] = np.uint16(np.int32(min(max(pixel_value, _ZERO), max_value)))
    return pixel_values
