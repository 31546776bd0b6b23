"""Rasterisation of triangles with a depth buffer, compiled."""

import numba
import numpy as np
from numpy.typing import NDArray

_ONE, _TINY, _NO_LINE_PX = np.float32(1.0), np.float32(1e-9), np.float32(-1e9)

# A pixel belongs to a triangle if its three barycentric coordinates exceed this. With zero,
# rounding would leave gaps between adjacent triangles.
_MIN_BARYCENTRIC = np.float32(-5e-3)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def fill_triangles(
    image: NDArray[np.uint32],
    depth: NDArray[np.float32],
    pixels: NDArray[np.float32],
    triangles: NDArray[np.int64],
    colours: NDArray[np.uint32],
    line: np.uint32,
    line_width: np.float32,
    lined_count: int,
) -> None:
    """Draw triangles into an image, where they are nearer than its content.

    Parameters
    ----------
    image : (height, width) array of colours
        Changed in place.
    depth : (height, width) array
        Nearness of each pixel, changed in place. A larger value is nearer.
    pixels : (3, n) array
        Position of the points to the right and down in pixels, and their nearness.
    triangles : (3, t) array
        Indices of the corners.
    colours : (t,) array
    line : colour
        Colour of the sides of the triangles.
    line_width : float
        Width of the lines in pixels. Each of two adjacent triangles draws half of it.
    lined_count : int
        Number of triangles, from the first one, whose sides are drawn.
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
        half_line = np.float32(0.5) * line_width if t < lined_count else _NO_LINE_PX
        inverse_area = _ONE / area
        # The barycentric coordinates u, v, w are linear in x, so one addition per pixel is enough.
        u_x, v_x = (by - cy) * inverse_area, (cy - ay) * inverse_area
        # Heights of the triangle in pixels. The barycentric coordinate of a corner times its height
        # is the distance from the opposite side.
        ha = abs(area) / max(np.hypot(cx - bx, cy - by), _TINY)
        hb = abs(area) / max(np.hypot(ax - cx, ay - cy), _TINY)
        hc = abs(area) / max(np.hypot(bx - ax, by - ay), _TINY)
        for y in range(first_y, last_y + 1):
            pixel_y = np.float32(y)
            pixel_x = np.float32(first_x)
            u = (
                (bx - pixel_x) * (cy - pixel_y) - (by - pixel_y) * (cx - pixel_x)
            ) * inverse_area - u_x
            v = (
                (cx - pixel_x) * (ay - pixel_y) - (cy - pixel_y) * (ax - pixel_x)
            ) * inverse_area - v_x
            for x in range(first_x, last_x + 1):
                u += u_x
                v += v_x
                w = _ONE - u - v
                if u < _MIN_BARYCENTRIC or v < _MIN_BARYCENTRIC or w < _MIN_BARYCENTRIC:
                    continue
                nearness = u * az + v * bz + w * cz
                if nearness > depth[y, x]:
                    depth[y, x] = nearness
                    is_on_side = min(u * ha, v * hb, w * hc) < half_line
                    image[y, x] = line if is_on_side else colours[t]
