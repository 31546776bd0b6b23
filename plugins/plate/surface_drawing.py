"""Drawing of a coloured surface in parallel projection, without OpenGL."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import cos, radians, sin

import cv2
import numpy as np

from rotemina.plugins.plate.rasteriser import fill_triangles
from rotemina.sim.arrays import FloatArray

_SHADE_COUNT = 256
_ZOOM_RANGE = (0.3, 20.0)

# Distance of the centre of the surface from the top of the picture, relative to its height. The pin
# needs space below.
_CENTRE_TOP_RATIO = 0.42

# Radius of the surface at zoom 1, relative to the smaller side of the picture.
_SURFACE_RADIUS_RATIO = 0.44

# Space for points out of the plane, relative to the radius.
_HEADROOM_RATIO = 0.35

_DOWNSCALING = cv2.INTER_AREA
_PIN_SIDE_COUNT = 16

# Width of the lines before the picture is scaled down to half its size.
_LINE_WIDTH_PX = np.float32(2.0)


@dataclass(frozen=True, slots=True)
class OrbitView:
    """Direction from which the surface is seen, in degrees, and zoom.

    ``azimuth`` rotates about the vertical. ``elevation`` 90 looks straight down. ``zoom`` 1 shows
    the whole surface.
    """

    azimuth: float = -60.0
    elevation: float = 32.0
    zoom: float = 1.0

    def with_rotation(self, right: float, down: float) -> "OrbitView":
        """Return the view rotated by a drag, in degrees."""
        elevation = min(90.0, max(-90.0, self.elevation + down))
        return replace(self, azimuth=(self.azimuth - right) % 360.0, elevation=elevation)

    def with_zoom(self, factor: float) -> "OrbitView":
        """Return the view zoomed in by a factor above 1, or out by a factor below 1."""
        low, high = _ZOOM_RANGE
        return replace(self, zoom=min(high, max(low, self.zoom * factor)))


@dataclass(frozen=True, slots=True, eq=False)
class ColouredSurface:
    """Points (3, n) in m, triangles (3, t), and a value from 0 to 1 for each triangle (t,).

    Values at the end may be NaN. These triangles get a neutral colour and no lines. ``pin_axis``
    (3, 2) are the ends of the pin's middle line, m.
    """

    points: FloatArray
    triangles: np.ndarray
    values: FloatArray
    radius: float
    pin_axis: FloatArray
    pin_radius: float


@cache
def make_colour_table() -> np.ndarray:
    """Return the colours of values from 0 to 1, (256, 3) bytes: red, green, blue."""
    ramp = np.arange(_SHADE_COUNT, dtype=np.uint8)[:, None]
    return np.ascontiguousarray(cv2.applyColorMap(ramp, cv2.COLORMAP_VIRIDIS)[:, 0, ::-1])


def project_points(
    points: FloatArray, view: OrbitView, radius: float, size: tuple[int, int]
) -> FloatArray:
    """Return the position of points (3, n) to the right and down in pixels, and their nearness."""
    azimuth, e = radians(view.azimuth), radians(view.elevation)
    x, y, z = points
    right = -sin(azimuth) * x + cos(azimuth) * y
    away = cos(azimuth) * x + sin(azimuth) * y
    up = cos(e) * z - sin(e) * away
    nearness = sin(e) * z + cos(e) * away
    width, height = size
    relative_height = abs(sin(e)) + _HEADROOM_RATIO * abs(cos(e))
    scale = _SURFACE_RADIUS_RATIO * min(width, height / relative_height) * view.zoom / radius
    return np.stack(
        [0.5 * width + scale * right, _CENTRE_TOP_RATIO * height - scale * up, nearness]
    )


def draw_surface(
    surface: ColouredSurface,
    view: OrbitView,
    size: tuple[int, int],
    background: tuple[int, int, int],
    neutral: tuple[int, int, int],
    line: tuple[int, int, int] | None,
) -> np.ndarray:
    """Return a picture (height, width, 4) of bytes: blue, green, red, and an unused one.

    ``neutral`` is the colour of hub and pin. ``line`` is the colour of the mesh, None for no mesh.
    The picture is drawn at twice its size and then reduced, which smooths the edges.
    """
    width, height = (2 * side for side in size)
    image = np.full((height, width), _pack_colour(background), dtype=np.uint32)
    points = np.concatenate([surface.points, _make_pin_points(surface)], axis=1)
    pixels = project_points(points, view, surface.radius, (width, height)).astype(np.float32)
    point_count = surface.points.shape[1]
    shades = np.nan_to_num(surface.values, nan=0.0).clip(0.0, 1.0) * (_SHADE_COUNT - 1)
    colour_indices = np.where(
        np.isnan(surface.values), _SHADE_COUNT, np.rint(shades).astype(np.int64)
    )
    table = np.array(
        [*(_pack_colour(colour) for colour in make_colour_table()), _pack_colour(neutral)],
        dtype=np.uint32,
    )
    fill_triangles(
        image,
        np.full((height, width), -np.inf, dtype=np.float32),
        pixels,
        np.concatenate([surface.triangles, _PIN_TRIANGLES + point_count], axis=1),
        table[np.append(colour_indices, np.full(_PIN_TRIANGLES.shape[1], _SHADE_COUNT))],
        _pack_colour(line or neutral),
        _LINE_WIDTH_PX,
        0 if line is None else int(np.count_nonzero(~np.isnan(surface.values))),
    )
    return cv2.resize(
        image.view(np.uint8).reshape(height, width, 4), size, interpolation=_DOWNSCALING
    )


def _pack_colour(colour: Sequence[int]) -> np.uint32:
    red, green, blue = (int(channel) for channel in colour)
    return np.uint32(0xFF000000 | red << 16 | green << 8 | blue)


def _make_pin_points(surface: ColouredSurface) -> FloatArray:
    angles = np.linspace(0.0, 2.0 * np.pi, _PIN_SIDE_COUNT, endpoint=False)
    circle = surface.pin_radius * np.stack(
        [np.cos(angles), np.sin(angles), np.zeros(_PIN_SIDE_COUNT)]
    )
    return np.concatenate(
        [surface.pin_axis[:, :1] + circle, surface.pin_axis[:, 1:] + circle], axis=1
    )


def _make_pin_triangles() -> np.ndarray:
    top = np.arange(_PIN_SIDE_COUNT)
    top_next = np.roll(top, -1)
    sides = np.concatenate(
        [
            [top, top_next, top + _PIN_SIDE_COUNT],
            [top_next, top_next + _PIN_SIDE_COUNT, top + _PIN_SIDE_COUNT],
        ],
        axis=1,
    )
    end_cap = np.stack(
        [
            np.full(_PIN_SIDE_COUNT, _PIN_SIDE_COUNT),
            top + _PIN_SIDE_COUNT,
            top_next + _PIN_SIDE_COUNT,
        ]
    )
    return np.concatenate([sides, end_cap], axis=1)


_PIN_TRIANGLES = _make_pin_triangles()
