"""The loops over pixels, compiled. Distances in px, light in photoelectrons, single precision.

They leave the interpreter to other threads: a picture takes long enough for a window to stutter.
"""

import numba
import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float32]
Numbers = NDArray[np.uint16]

#: The edges of a blurred shape are drawn as far as this many standard deviations from it.
REACH = 4.0

_REACH = np.float32(REACH)
_BLOCK = 32  # pixels of a row that are drawn or left out together

_ROOT_HALF = np.float32(0.7071067811865476)
_ONE, _HALF, _ZERO, _FAR = np.float32(1.0), np.float32(0.5), np.float32(0.0), np.float32(4.0)
# Abramowitz and Stegun, Handbook of Mathematical Functions (1964), 7.1.28: within 3e-7.
_A = tuple(
    np.float32(a)
    for a in (0.0705230784, 0.0422820123, 0.0092705272, 0.0001520143, 0.0002765672, 0.0000430638)
)


@numba.njit(cache=True, inline="always", error_model="numpy", fastmath=True)
def _erf(x: np.float32) -> np.float32:
    """Return the error function; without a branch, so that the loop around it is vectorised."""
    y = min(abs(x), _FAR)  # beyond it nothing changes, and powers of it stay finite
    p = y * (_A[0] + y * (_A[1] + y * (_A[2] + y * (_A[3] + y * (_A[4] + y * _A[5])))))
    p = p + _ONE
    p2 = p * p
    p4 = p2 * p2
    p8 = p4 * p4
    value = _ONE - _ONE / (p8 * p8)
    return value if x >= _ZERO else -value


@numba.njit(cache=True, inline="always", error_model="numpy", fastmath=True)
def _between(across: np.float32, radius: np.float32, share: np.float32) -> np.float32:
    """Return how much of a strip −radius…radius is seen at ``across``; ``share``: 1/(√2 σ)."""
    return np.float32(_HALF * (_erf((radius - across) * share) + _erf((radius + across) * share)))


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def draw_tube(
    light: Image,
    tip: Image,
    way: Image,
    radius: Image,
    depth: Image,
    blur: Image,
    absorbed: Image,
) -> None:
    """Darken ``light`` (rows, columns) by a tapering tube, in place; its far parts stay untouched.

    Parameters
    ----------
    light : (rows, columns)
    tip : (2,)
        Column and row of the tip.
    way : (2,)
        The unit vector of the body, in px.
    radius : (3,)
        At the tip, growth per px, and the greatest.
    depth : (2,)
        Of the tip over half the depth of field, and its growth per px.
    blur : (2,)
        Variance in focus without the pixel, and that of the pixel.
    absorbed : (3,)
        Share lost in the tube, less through its bore, and the bore's radius over the tube's.
    """
    # Read once: were they arrays in the loop, the compiler could not rule out that it writes them.
    u0, v0, eu, ev = tip[0], tip[1], way[0], way[1]
    narrow, growth, widest = radius[0], radius[1], radius[2]
    away, rise, airy, pixel = depth[0], depth[1], blur[0], blur[1]
    wall, lumen, hollow = absorbed[0], absorbed[1], absorbed[2]
    # No edge is nearer to a pixel of a block than to its middle by more than this.
    slack = _HALF * np.float32(_BLOCK) * (_ONE + growth + _REACH * np.sqrt(airy) * abs(rise))
    for row in range(light.shape[0]):
        dv = np.float32(row) - v0
        for first in range(0, light.shape[1], _BLOCK):
            du = np.float32(first + _BLOCK // 2) - u0
            along, across = du * eu + dv * ev, abs(dv * eu - du * ev) - slack
            inside = max(along, _ZERO)
            z = away + rise * inside
            reach = _REACH * np.sqrt(airy * (_ONE + z * z) + pixel)
            if along + slack < -reach or across > min(narrow + growth * inside, widest) + reach:
                continue
            line = light[row][first : first + _BLOCK]
            u = np.float32(first) - u0
            for column in range(np.int32(line.shape[0])):  # 64 bits are not vectorised
                du = np.float32(np.int32(column)) + u
                along = du * eu + dv * ev
                across = dv * eu - du * ev
                inside = max(along, _ZERO)
                wide = min(narrow + growth * inside, widest)
                z = away + rise * inside
                share = _ROOT_HALF / np.sqrt(airy * (_ONE + z * z) + pixel)
                whole = _between(across, wide, share)
                bore = _between(across, wide * hollow, share)
                end = _HALF * (_ONE + _erf(along * share))
                line[column] *= _ONE - end * (wall * whole - lumen * bore)


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def draw_radial(
    light: Image,
    box: tuple[int, int, int, int],
    centre: Image,
    profile: Image,
    per_px: np.float32,
) -> None:
    """Darken ``light`` (rows, columns) by ``profile`` (n,) over the distance from ``centre``.

    ``box`` is the first and last row, and column, to draw in, the last left out; ``profile`` has
    ``per_px`` values a px and ends with what holds beyond.
    """
    last = np.float32(profile.shape[0] - 2)
    for row in range(box[0], box[1]):
        dv = np.float32(row) - centre[1]
        for column in range(box[2], box[3]):
            du = np.float32(column) - centre[0]
            place = min(np.sqrt(du * du + dv * dv) * per_px, last)
            at = np.int32(place)
            part = place - np.float32(at)
            light[row, column] *= profile[at] * (_ONE - part) + profile[at + 1] * part


@numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=True)
def outside_of(outline: Image, centre: Image, shape: tuple[int, int]) -> Image:
    """Return how far pixels (shape) are outside an outline, px; negative inside.

    ``outline`` (n,) are its distances from ``centre`` at n equal angles, the first at 0.
    """
    out = np.empty(shape, np.float32)
    count = outline.shape[0]
    per_rad = np.float32(count / (2.0 * np.pi))
    for row in range(shape[0]):
        dv = np.float32(row) - centre[1]
        for column in range(shape[1]):
            du = np.float32(column) - centre[0]
            angle = np.arctan2(dv, du) * per_rad
            if angle < _ZERO:
                angle += np.float32(count)
            at = np.int32(angle)
            part = angle - np.float32(at)
            first, second = outline[at % count], outline[(at + 1) % count]
            radius = first * (_ONE - part) + second * part
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
    largest: np.float32,
) -> Numbers:
    """Return what the converter makes of ``light`` (rows, columns), photoelectrons over ``scale``.

    Shot noise is drawn from a normal distribution of variance N, which is near to Poisson's for
    the hundreds of electrons of a picture. The noise of a row begins at ``begins`` (rows,) of the
    sequence ``noise``.
    """
    numbers = np.empty(light.shape, np.uint16)
    for row in range(light.shape[0]):
        line, converted, shot = light[row], numbers[row], noise[begins[row] :]
        for column in range(line.shape[0]):
            electrons = line[column] * scale
            electrons += np.sqrt(electrons + read_variance) * shot[column]
            number = min(electrons, full_well) * gain + black + _HALF
            converted[column] = np.uint16(np.int32(min(max(number, _ZERO), largest)))
    return numbers
