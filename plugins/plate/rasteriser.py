"""Rasterisation of triangles with a depth buffer, compiled."""

import numba
import numpy as np
from numpy.typing import NDArray

_ONE, _TINY, _NONE = np.float32(1.0), np.float32(1e-9), np.float32(-1e9)
_OUT = np.float32(-5e-3)  # rounding must leave no gaps between neighbours


@numba.njit(cache=True, nogil=True, error_model="numpy")
def fill(
    image: NDArray[np.uint32],
    depth: NDArray[np.float32],
    pixels: NDArray[np.float32],
    triangles: NDArray[np.int64],
    colours: NDArray[np.uint32],
    line: np.uint32,
    line_width: np.float32,
    lined: int,
) -> None:
    """Fill triangles where they are nearer than what is there.

    Parameters
    ----------
    image : (height, width) array of colours
        Written.
    depth : (height, width) array
        How near each pixel is, written; larger is nearer.
    pixels : (3, n) array
        Right, down, near of the points.
    triangles : (3, t) array
    colours : (t,) array
    line : colour
        Of the triangles' sides.
    line_width : float
        Pixels, of which each triangle draws half.
    lined : int
        So many of the triangles, the first ones, have lines at their sides.
    """
    height, width = depth.shape
    for t in range(triangles.shape[1]):
        a, b, c = triangles[0, t], triangles[1, t], triangles[2, t]
        ax, ay, az = pixels[0, a], pixels[1, a], pixels[2, a]
        bx, by, bz = pixels[0, b], pixels[1, b], pixels[2, b]
        cx, cy, cz = pixels[0, c], pixels[1, c], pixels[2, c]
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(area) < _TINY:
            continue
        first_x, last_x = max(0, int(min(ax, bx, cx))), min(width - 1, int(max(ax, bx, cx)) + 1)
        first_y, last_y = max(0, int(min(ay, by, cy))), min(height - 1, int(max(ay, by, cy)) + 1)
        half_line = np.float32(0.5) * line_width if t < lined else _NONE
        share = _ONE / area
        # The shares u, v, w of the corners are linear: one addition from pixel to pixel.
        u_x, v_x = (by - cy) * share, (cy - ay) * share
        # Distance in pixels of a side that lies opposite a corner, per share of that corner.
        ha = abs(area) / max(np.hypot(cx - bx, cy - by), _TINY)
        hb = abs(area) / max(np.hypot(ax - cx, ay - cy), _TINY)
        hc = abs(area) / max(np.hypot(bx - ax, by - ay), _TINY)
        for y in range(first_y, last_y + 1):
            down = np.float32(y)
            right = np.float32(first_x)
            u = ((bx - right) * (cy - down) - (by - down) * (cx - right)) * share - u_x
            v = ((cx - right) * (ay - down) - (cy - down) * (ax - right)) * share - v_x
            for x in range(first_x, last_x + 1):
                u += u_x
                v += v_x
                w = _ONE - u - v
                if u < _OUT or v < _OUT or w < _OUT:
                    continue
                near = u * az + v * bz + w * cz
                if near > depth[y, x]:
                    depth[y, x] = near
                    on_side = min(u * ha, v * hb, w * hc) < half_line
                    image[y, x] = line if on_side else colours[t]
