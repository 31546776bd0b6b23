"""The cell as it is seen: a dark membrane with a bright rim, grains, a nucleus, dimple and hole.

Absorption multiplies, so the order in depth matters only for the blur.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.cell import Cell, CellState, dimple, displaced
from rotemina.sim.microscope.kernels import Image
from rotemina.sim.microscope.optics import Optics

# Contrasts, as shares of the light: of a cell in bright field, chosen by eye.
_MEMBRANE, _RIM, _BODY, _GRAINS = 0.30, 0.12, 0.06, 0.05
_NUCLEUS, _ENVELOPE, _NUCLEOLUS = 0.08, 0.15, 0.25
_DIMPLE, _HOLE = 0.25, 0.35
_HOLE_M, _GRAIN_M = 1.0e-6, 0.8e-6
_ANGLES = 256
_FARTHEST_PX = 60.0  # blur beyond which there is nothing but a shade


@dataclass(frozen=True, slots=True, eq=False)
class CellImage:
    """The share of light that a cell lets through, in its part of the picture.

    Attributes
    ----------
    rows, columns : slice
    passed : (rows, columns)
    """

    rows: slice
    columns: slice
    passed: Image


def draw_cell(
    optics: Optics, cell: Cell, state: CellState, focus_m: float, grains: Image
) -> CellImage | None:
    """Return the cell's part of the picture, or None if it is out of view.

    ``grains`` (rows, columns) is a texture of unit variance, as large as the picture or larger.
    """
    outline_m = displaced(cell, state, _outline(optics, cell.centre_m, np.array(cell.radii_m)))
    outline = optics.pixel_of(outline_m)
    middle = optics.pixel_of(np.array(cell.centre_m))
    blur = _blur(optics, np.array(cell.centre_m), focus_m)
    box = _box(optics, outline, kernels.REACH * blur + 4.0)
    if box is None:
        return None
    rows, columns = box
    corner = np.array([columns.start, rows.start], dtype=np.float64)
    shape = (rows.stop - rows.start, columns.stop - columns.start)
    centre = middle - corner
    distance = kernels.outside_of(_polar(outline - middle), centre.astype(np.float32), shape)
    wide = cell.membrane_m / optics.pixel_m
    inside = _inside(distance, blur)
    passed = 1.0 - _BODY * inside + _grain(optics, grains, corner, blur, shape) * inside
    passed *= 1.0 - _MEMBRANE * _line(distance, wide, blur)
    passed *= 1.0 + _RIM * _line(distance - np.float32(3.0 * wide), 2.0 * wide, blur)
    passed *= _nucleus(optics, cell, focus_m, corner, shape)
    for point_m, size_m, contrast in _marks(optics, cell, state):
        spot = optics.pixel_of(point_m) - corner
        mark_blur = _blur(optics, point_m, focus_m)
        passed *= 1.0 + contrast * _spot(shape, spot, size_m / optics.pixel_m, mark_blur)
    return CellImage(rows, columns, passed.astype(np.float32))


def _outline(optics: Optics, centre_m: tuple[float, float, float], radii: FloatArray) -> FloatArray:
    """Return points (n, 3) of an ellipsoid where the view grazes it.

    With coordinates over the half axes the ellipsoid is a sphere; the view, scaled alike, grazes
    it along the great circle at right angles to itself.
    """
    view = optics.view[2] / radii
    view /= np.linalg.norm(view)
    first = np.cross(view, np.eye(3)[int(np.argmin(np.abs(view)))])
    first /= np.linalg.norm(first)
    second = np.cross(view, first)
    angle = np.linspace(0.0, 2.0 * np.pi, _ANGLES, endpoint=False)[:, None]
    return np.asarray(np.array(centre_m) + radii * (np.cos(angle) * first + np.sin(angle) * second))


def _polar(points: FloatArray) -> Image:
    """Return distances (n,) from the origin, at n equal angles, of an outline (n, 2)."""
    angle = np.mod(np.arctan2(points[:, 1], points[:, 0]), 2.0 * np.pi)
    order = np.argsort(angle)
    even = np.linspace(0.0, 2.0 * np.pi, len(points), endpoint=False)
    radius = np.hypot(points[:, 0], points[:, 1])[order]
    return np.interp(even, angle[order], radius, period=2.0 * np.pi).astype(np.float32)


def _box(optics: Optics, outline: FloatArray, margin: float) -> tuple[slice, slice] | None:
    most = [optics.width, optics.height]
    low = np.floor(outline.min(axis=0) - margin).clip(0, most).astype(int)
    high = np.ceil(outline.max(axis=0) + margin + 1.0).clip(0, most).astype(int)
    if (low >= high).any():
        return None
    return slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))


def _blur(optics: Optics, point_m: FloatArray, focus_m: float) -> float:
    return min(float(optics.blur_px(optics.depth_of(point_m) - focus_m)), _FARTHEST_PX)


def _inside(distance: Image, blur: float) -> FloatArray:
    return np.asarray(scipy.special.ndtr(-distance / blur))


def _line(distance: Image, wide: float, blur: float) -> FloatArray:
    """Return a Gaussian line of half width ``wide``, 1 in its middle before it is blurred."""
    variance = wide**2 + blur**2
    return np.asarray(wide / variance**0.5 * np.exp(-(distance**2) / (2.0 * variance)))


def _spot(shape: tuple[int, int], at: FloatArray, wide: float, blur: float) -> FloatArray:
    """Return a Gaussian spot (shape) of half width ``wide``, 1 in its middle before blurring."""
    variance = wide**2 + blur**2
    across = np.exp(-((np.arange(shape[1]) - at[0]) ** 2) / (2.0 * variance))
    down = np.exp(-((np.arange(shape[0]) - at[1]) ** 2) / (2.0 * variance))
    return np.asarray(wide**2 / variance * down[:, None] * across)


def _grain(
    optics: Optics, grains: Image, corner: FloatArray, blur: float, shape: tuple[int, int]
) -> FloatArray:
    """Return the grains of a part of the picture, softened by the blur."""
    size = _GRAIN_M / optics.pixel_m
    first = [int(x) for x in corner]
    part = grains[first[1] : first[1] + shape[0], first[0] : first[0] + shape[1]]
    soft = scipy.ndimage.gaussian_filter(part, float(np.hypot(size, blur)), mode="nearest")
    # White noise of unit variance, smoothed to the grain's size, has this standard deviation.
    return np.asarray(_GRAINS * soft * 2.0 * np.sqrt(np.pi) * size)


def _nucleus(
    optics: Optics, cell: Cell, focus_m: float, corner: FloatArray, shape: tuple[int, int]
) -> FloatArray:
    centre_m = np.array(cell.centre_m) + np.array(cell.nucleus_m)
    at = optics.pixel_of(centre_m)
    flat = np.array(cell.radii_m) / max(cell.radii_m)  # as flat as the cell
    outline = optics.pixel_of(_outline(optics, tuple(centre_m), cell.nucleus_radius_m * flat))
    centre = (at - corner).astype(np.float32)
    distance = kernels.outside_of(_polar(outline - at), centre, shape)
    blur = _blur(optics, centre_m, focus_m)
    passed = 1.0 - _NUCLEUS * _inside(distance, blur)
    passed *= 1.0 - _ENVELOPE * _line(distance, cell.membrane_m / optics.pixel_m, blur)
    small = 0.25 * cell.nucleus_radius_m / optics.pixel_m
    return np.asarray(passed * (1.0 - _NUCLEOLUS * _spot(shape, at - corner, small, blur)))


def _marks(optics: Optics, cell: Cell, state: CellState) -> list[tuple[FloatArray, float, float]]:
    """Return the spots that tip and hole leave: where, their half width in m, their contrast.

    A dimple shades as far as it goes along the view; across it, the outline shows it.
    """
    marks: list[tuple[FloatArray, float, float]] = []
    if state.entry_m is not None:
        way = dimple(cell, state)
        deep = min(1.0, abs(float(way @ optics.view[2])) / cell.breaking_m)
        marks.append((np.array(state.entry_m) + way, cell.dimple_m, -_DIMPLE * deep))
    if state.hole_m is not None:
        marks.append((np.array(state.hole_m), _HOLE_M, _HOLE))
    return marks
