"""Drawing of a cell: dark membrane with a bright rim, grains, nucleus, dimple and hole.

Transmissions multiply, so the order of the parts in depth matters only for their blur.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.microscope import kernels
from rotemina.sim.microscope.cell import (
    CellState,
    SimulatedCell,
    dimple_displacement,
    displace_points,
)
from rotemina.sim.microscope.kernels import Image
from rotemina.sim.microscope.optics import MicroscopeOptics

# Contrasts of a cell in bright field as shares of the light, chosen by eye.
_MEMBRANE_CONTRAST, _RIM_CONTRAST, _BODY_CONTRAST, _GRAIN_CONTRAST = 0.30, 0.12, 0.06, 0.05
_NUCLEUS_CONTRAST, _ENVELOPE_CONTRAST, _NUCLEOLUS_CONTRAST = 0.08, 0.15, 0.25
_DIMPLE_CONTRAST, _HOLE_CONTRAST = 0.25, 0.35
_HOLE_RADIUS_M, _GRAIN_SIZE_M = 1.0e-6, 0.8e-6
# Number of points on an outline.
_OUTLINE_POINT_COUNT = 256
# The blur is limited to this value, beyond which hardly any contrast would remain.
_MAX_BLUR_PX = 60.0


@dataclass(frozen=True, slots=True, eq=False)
class CellImage:
    """Light transmission of a cell in its part of the picture.

    Attributes
    ----------
    rows, columns : slice
        The part of the picture.
    transmission : (rows, columns)
        Share of the light that the cell transmits.
    """

    rows: slice
    columns: slice
    transmission: Image


def draw_cell(
    optics: MicroscopeOptics, cell: SimulatedCell, state: CellState, focus_m: float, grains: Image
) -> CellImage | None:
    """Return the image of the cell, or None if it is out of view.

    ``grains`` (rows, columns) is a texture of unit variance, at least as large as the picture.
    """
    outline_m = displace_points(
        cell, state, _compute_outline(optics, cell.centre_m, np.array(cell.radii_m))
    )
    outline = optics.pixel_of(outline_m)
    centre_px = optics.pixel_of(np.array(cell.centre_m))
    blur = _compute_blur(optics, np.array(cell.centre_m), focus_m)
    box = _find_box(optics, outline, kernels.BLUR_REACH_SIGMAS * blur + 4.0)
    if box is None:
        return None
    rows, columns = box
    corner = np.array([columns.start, rows.start], dtype=np.float64)
    shape = (rows.stop - rows.start, columns.stop - columns.start)
    centre = centre_px - corner
    distance = kernels.distance_outside(
        _to_polar_radii(outline - centre_px), centre.astype(np.float32), shape
    )
    width = cell.membrane_m / optics.pixel_m
    coverage = _compute_coverage(distance, blur)
    transmission = (
        1.0
        - _BODY_CONTRAST * coverage
        + _make_grain_texture(optics, grains, corner, blur, shape) * coverage
    )
    transmission *= 1.0 - _MEMBRANE_CONTRAST * _make_line_profile(distance, width, blur)
    transmission *= 1.0 + _RIM_CONTRAST * _make_line_profile(
        distance - np.float32(3.0 * width), 2.0 * width, blur
    )
    transmission *= _compute_nucleus_transmission(optics, cell, focus_m, corner, shape)
    for point_m, size_m, contrast in _find_marks(optics, cell, state):
        spot_px = optics.pixel_of(point_m) - corner
        mark_blur = _compute_blur(optics, point_m, focus_m)
        transmission *= 1.0 + contrast * _make_spot(
            shape, spot_px, size_m / optics.pixel_m, mark_blur
        )
    return CellImage(rows, columns, transmission.astype(np.float32))


def _compute_outline(
    optics: MicroscopeOptics, centre_m: tuple[float, float, float], radii: FloatArray
) -> FloatArray:
    """Return points (n, 3) of the outline of an ellipsoid, where the view is tangent to it.

    With coordinates divided by the half axes the ellipsoid is a sphere. The view direction, divided
    in the same way, is tangent to it along the great circle at right angles to the direction.
    """
    view = optics.view[2] / radii
    view /= np.linalg.norm(view)
    first_axis = np.cross(view, np.eye(3)[int(np.argmin(np.abs(view)))])
    first_axis /= np.linalg.norm(first_axis)
    second_axis = np.cross(view, first_axis)
    angle = np.linspace(0.0, 2.0 * np.pi, _OUTLINE_POINT_COUNT, endpoint=False)[:, None]
    return np.asarray(
        np.array(centre_m) + radii * (np.cos(angle) * first_axis + np.sin(angle) * second_axis)
    )


def _to_polar_radii(points: FloatArray) -> Image:
    """Return the distances (n,) of an outline (n, 2) from the origin at n equally spaced angles."""
    angles = np.mod(np.arctan2(points[:, 1], points[:, 0]), 2.0 * np.pi)
    order = np.argsort(angles)
    even_angles = np.linspace(0.0, 2.0 * np.pi, len(points), endpoint=False)
    radius = np.hypot(points[:, 0], points[:, 1])[order]
    return np.interp(even_angles, angles[order], radius, period=2.0 * np.pi).astype(np.float32)


def _find_box(
    optics: MicroscopeOptics, outline: FloatArray, margin: float
) -> tuple[slice, slice] | None:
    limits = [optics.width, optics.height]
    low = np.floor(outline.min(axis=0) - margin).clip(0, limits).astype(int)
    high = np.ceil(outline.max(axis=0) + margin + 1.0).clip(0, limits).astype(int)
    if (low >= high).any():
        return None
    return slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))


def _compute_blur(optics: MicroscopeOptics, point_m: FloatArray, focus_m: float) -> float:
    return min(float(optics.blur_px(optics.depth_of(point_m) - focus_m)), _MAX_BLUR_PX)


def _compute_coverage(distance: Image, blur: float) -> FloatArray:
    return np.asarray(scipy.special.ndtr(-distance / blur))


def _make_line_profile(distance: Image, width: float, blur: float) -> FloatArray:
    """Return a Gaussian line of half width ``width``, 1 at its maximum before blurring."""
    variance = width**2 + blur**2
    return np.asarray(width / variance**0.5 * np.exp(-(distance**2) / (2.0 * variance)))


def _make_spot(shape: tuple[int, int], centre: FloatArray, width: float, blur: float) -> FloatArray:
    """Return a Gaussian spot (shape) of half width ``width``, 1 at its maximum before blurring."""
    variance = width**2 + blur**2
    column_profile = np.exp(-((np.arange(shape[1]) - centre[0]) ** 2) / (2.0 * variance))
    row_profile = np.exp(-((np.arange(shape[0]) - centre[1]) ** 2) / (2.0 * variance))
    return np.asarray(width**2 / variance * row_profile[:, None] * column_profile)


def _make_grain_texture(
    optics: MicroscopeOptics, grains: Image, corner: FloatArray, blur: float, shape: tuple[int, int]
) -> FloatArray:
    size = _GRAIN_SIZE_M / optics.pixel_m
    first_pixel = [int(x) for x in corner]
    part = grains[
        first_pixel[1] : first_pixel[1] + shape[0], first_pixel[0] : first_pixel[0] + shape[1]
    ]
    smoothed = scipy.ndimage.gaussian_filter(part, float(np.hypot(size, blur)), mode="nearest")
    # White noise of unit variance that is smoothed to this size has a standard deviation of
    # 1 / (2 √π size), which is compensated here.
    return np.asarray(_GRAIN_CONTRAST * smoothed * 2.0 * np.sqrt(np.pi) * size)


def _compute_nucleus_transmission(
    optics: MicroscopeOptics,
    cell: SimulatedCell,
    focus_m: float,
    corner: FloatArray,
    shape: tuple[int, int],
) -> FloatArray:
    centre_m = np.array(cell.centre_m) + np.array(cell.nucleus_m)
    centre_px = optics.pixel_of(centre_m)
    # The nucleus is as flat as the cell.
    flatness = np.array(cell.radii_m) / max(cell.radii_m)
    outline = optics.pixel_of(
        _compute_outline(optics, tuple(centre_m), cell.nucleus_radius_m * flatness)
    )
    centre = (centre_px - corner).astype(np.float32)
    distance = kernels.distance_outside(_to_polar_radii(outline - centre_px), centre, shape)
    blur = _compute_blur(optics, centre_m, focus_m)
    transmission = 1.0 - _NUCLEUS_CONTRAST * _compute_coverage(distance, blur)
    transmission *= 1.0 - _ENVELOPE_CONTRAST * _make_line_profile(
        distance, cell.membrane_m / optics.pixel_m, blur
    )
    nucleolus_radius = 0.25 * cell.nucleus_radius_m / optics.pixel_m
    return np.asarray(
        transmission
        * (
            1.0
            - _NUCLEOLUS_CONTRAST * _make_spot(shape, centre_px - corner, nucleolus_radius, blur)
        )
    )


def _find_marks(
    optics: MicroscopeOptics, cell: SimulatedCell, state: CellState
) -> list[tuple[FloatArray, float, float]]:
    """Return position, half width, m, and contrast of the spots that the dimple and the hole cause.

    A dimple darkens the picture only by its depth along the view. Its extent across the view is
    visible in the outline.
    """
    marks: list[tuple[FloatArray, float, float]] = []
    if state.entry_m is not None:
        displacement = dimple_displacement(cell, state)
        depth_ratio = min(1.0, abs(float(displacement @ optics.view[2])) / cell.breaking_m)
        marks.append(
            (np.array(state.entry_m) + displacement, cell.dimple_m, -_DIMPLE_CONTRAST * depth_ratio)
        )
    if state.hole_m is not None:
        marks.append((np.array(state.hole_m), _HOLE_RADIUS_M, _HOLE_CONTRAST))
    return marks
