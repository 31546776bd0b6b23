"""Drawing of a coloured surface in parallel 3-D without OpenGL: rotated, filled, smoothed."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import cos, radians, sin

import cv2
import numpy as np

from rotemina.plugins.plate.rasteriser import fill
from rotemina.sim.arrays import FloatArray

_SHADES = 256
_ZOOMS = (0.3, 20.0)
_MIDDLE = 0.42  # of the height: below hangs the pin
_FILLED = 0.44  # of the picture's smaller side is the surface's radius at zoom 1
_RISE = 0.35  # of the radius: room for what rises out of the plane
_SMOOTH = cv2.INTER_AREA
_SIDES = 16  # of the pin
_LINE = np.float32(2.0)  # pixels of the picture before it is made smaller


@dataclass(frozen=True, slots=True)
class View:
    """From where a surface is seen: turned about the vertical, then tipped, degrees.

    ``elevation`` 90 looks straight down. ``zoom`` 1 shows all of the surface.
    """

    azimuth: float = -60.0
    elevation: float = 32.0
    zoom: float = 1.0

    def turned(self, right: float, down: float) -> "View":
        """Return the view after a drag, in degrees."""
        elevation = min(90.0, max(-90.0, self.elevation + down))
        return replace(self, azimuth=(self.azimuth - right) % 360.0, elevation=elevation)

    def zoomed(self, factor: float) -> "View":
        """Return the view nearer (above 1) or further away."""
        low, high = _ZOOMS
        return replace(self, zoom=min(high, max(low, self.zoom * factor)))


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """Points (3, n) in m, triangles (3, t), and their values (t,), 0 to 1, as colours.

    The last ones may be NaN: those are drawn in a neutral colour and without lines.
    """

    points: FloatArray
    triangles: np.ndarray
    values: FloatArray
    radius: float
    rod: FloatArray  # (3, 2), its two ends: the pin
    rod_radius: float


@cache
def colours() -> np.ndarray:
    """Return the colours of values from 0 to 1, (256, 3) bytes, red green blue."""
    ramp = np.arange(_SHADES, dtype=np.uint8)[:, None]
    return np.ascontiguousarray(cv2.applyColorMap(ramp, cv2.COLORMAP_VIRIDIS)[:, 0, ::-1])


def projected(points: FloatArray, view: View, radius: float, size: tuple[int, int]) -> FloatArray:
    """Return pixels right and down, and how near, (3, n), of points (3, n)."""
    a, e = radians(view.azimuth), radians(view.elevation)
    x, y, z = points
    right = -sin(a) * x + cos(a) * y
    away = cos(a) * x + sin(a) * y
    up = cos(e) * z - sin(e) * away
    near = sin(e) * z + cos(e) * away
    width, height = size
    tall = abs(sin(e)) + _RISE * abs(cos(e))
    scale = _FILLED * min(width, height / tall) * view.zoom / radius
    return np.stack([0.5 * width + scale * right, _MIDDLE * height - scale * up, near])


def drawn(
    surface: Surface,
    view: View,
    size: tuple[int, int],
    background: tuple[int, int, int],
    neutral: tuple[int, int, int],
    line: tuple[int, int, int] | None,
) -> np.ndarray:
    """Return a picture (height, width, 4) of bytes: blue, green, red, and one that means nothing.

    ``neutral`` is the colour of hub and pin; ``line`` that of the mesh, None for none. It is drawn
    twice as large and made smaller, which smooths its borders.
    """
    width, height = (2 * side for side in size)
    image = np.full((height, width), _packed(background), dtype=np.uint32)
    points = np.concatenate([surface.points, _rod_points(surface)], axis=1)
    pixels = projected(points, view, surface.radius, (width, height)).astype(np.float32)
    first = surface.points.shape[1]
    shades = np.nan_to_num(surface.values, nan=0.0).clip(0.0, 1.0) * (_SHADES - 1)
    index = np.where(np.isnan(surface.values), _SHADES, np.rint(shades).astype(np.int64))
    table = np.array([*(_packed(one) for one in colours()), _packed(neutral)], dtype=np.uint32)
    fill(
        image,
        np.full((height, width), -np.inf, dtype=np.float32),
        pixels,
        np.concatenate([surface.triangles, _ROD + first], axis=1),
        table[np.append(index, np.full(_ROD.shape[1], _SHADES))],
        _packed(line or neutral),
        _LINE,
        0 if line is None else int(np.count_nonzero(~np.isnan(surface.values))),
    )
    return cv2.resize(image.view(np.uint8).reshape(height, width, 4), size, interpolation=_SMOOTH)


def _packed(colour: Sequence[int]) -> np.uint32:
    red, green, blue = (int(part) for part in colour)
    return np.uint32(0xFF000000 | red << 16 | green << 8 | blue)


def _rod_points(surface: Surface) -> FloatArray:
    """Return the corners of the pin, a prism around its middle line."""
    turn = np.linspace(0.0, 2.0 * np.pi, _SIDES, endpoint=False)
    around = surface.rod_radius * np.stack([np.cos(turn), np.sin(turn), np.zeros(_SIDES)])
    return np.concatenate([surface.rod[:, :1] + around, surface.rod[:, 1:] + around], axis=1)


def _prism() -> np.ndarray:
    top = np.arange(_SIDES)
    top_next = np.roll(top, -1)
    sides = np.concatenate(
        [[top, top_next, top + _SIDES], [top_next, top_next + _SIDES, top + _SIDES]], axis=1
    )
    end = np.stack([np.full(_SIDES, _SIDES), top + _SIDES, top_next + _SIDES])
    return np.concatenate([sides, end], axis=1)


_ROD = _prism()
