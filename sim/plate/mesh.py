"""Meshes of a plate from hub to rim: a polar grid that follows the cut-outs.

Grid lines follow the edges of slots. For spiral slots the grid is twisted, so that they are
straight in the grid. Each hole sits in a patch of rays between its circle and the grid around it.
The mesh is deterministic: the same plate always gives the same mesh.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, log, pi, tau

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.messages import format_rounded
from rotemina.sim.robot import (
    CutoutRing,
    Plate,
    PlateCutout,
    find_plate_problems,
    make_rings,
)

# Number of elements around the full turn.
DEFAULT_DIVISIONS = 120
MIN_DIVISIONS, MAX_DIVISIONS = 16, 2000
# Ratio of the circumferential to the radial length of an element. Elements are shorter along the
# radius because stress changes mostly in that direction.
_RADIAL_REFINEMENT_RATIO = 1.5
# Smallest quality of a triangle; 1 is equilateral.
_MIN_QUALITY = 0.02
# Grid lines closer than this angle are merged.
_ANGLE_TOLERANCE_RAD = 1e-7


@dataclass(frozen=True, slots=True)
class PlateMesh:
    """A triangle mesh of a plate.

    Attributes
    ----------
    points : (2, n) array
        Coordinates, m, from the middle of the plate.
    triangles : (3, t) array of indices into the points
        Anticlockwise.
    hub, rim : (n,) arrays of bool
        Whether each point lies on the circle of the hub or of the rim.
    """

    points: FloatArray
    triangles: np.ndarray
    hub: np.ndarray
    rim: np.ndarray


def make_mesh(plate: Plate, divisions: int = DEFAULT_DIVISIONS) -> PlateMesh:
    """Mesh a plate with about ``divisions`` elements around the full turn.

    Raises
    ------
    PlateError
        If the plate is invalid, or cut-outs are so close to one another that elements would be
        slivers.
    """
    problem = next(find_plate_problems(plate), None)
    if problem is not None:
        value = "missing" if problem.value is None else problem.value
        raise PlateError(
            "plate.{key} = {value}: {bound}", key=problem.key, value=str(value), bound=problem.bound
        )
    if not MIN_DIVISIONS <= divisions <= MAX_DIVISIONS:
        raise PlateError(
            "divisions of the turn = {divisions}: must be {fewest} to {most}; {usual} is usual",
            divisions=divisions,
            fewest=MIN_DIVISIONS,
            most=MAX_DIVISIONS,
            usual=DEFAULT_DIVISIONS,
        )
    grid = _Grid(plate, divisions)
    points, triangles = grid.points, grid.triangles
    for ring in grid.rings:
        if ring.cutout.kind == "hole":
            points, triangles = _fill_around_holes(grid, ring, points, triangles)
    used_points = np.unique(triangles)
    new_indices = np.full(points.shape[1], -1)
    new_indices[used_points] = np.arange(used_points.size)
    points, triangles = points[:, used_points], new_indices[triangles]
    triangles = _orient_anticlockwise(points, triangles)
    _check_quality(points, triangles)
    radius = np.hypot(*points)
    tolerance = 1e-9 * plate.rim_radius
    return PlateMesh(
        points,
        triangles,
        hub=np.abs(radius - plate.hub_radius) < tolerance,
        rim=np.abs(radius - plate.rim_radius) < tolerance,
    )


class _Grid:
    """Polar grid of levels (radii) and columns (angles), without the cells inside cut-outs."""

    def __init__(self, plate: Plate, divisions: int) -> None:
        self.rings = make_rings(plate)
        edges = [plate.hub_radius, plate.rim_radius]
        edges += [r for ring in self.rings for r in (ring.inner, ring.outer)]
        step = tau / divisions / _RADIAL_REFINEMENT_RATIO
        self.radii = _subdivide(np.log(sorted(edges)), step)
        self.radii = np.exp(self.radii)
        self.radii[0], self.radii[-1] = plate.hub_radius, plate.rim_radius
        self.angles = self._make_angles(tau / divisions)
        self.twist = sum(
            (_compute_twist_angles(ring, self.radii) for ring in self.rings),
            np.zeros(len(self.radii)),
        )
        theta = self.angles[None, :] + self.twist[:, None]
        radius = self.radii[:, None]
        self.points = np.stack([(radius * np.cos(theta)).ravel(), (radius * np.sin(theta)).ravel()])
        self.triangles = self._make_triangles(self._mark_cells())

    def _make_angles(self, step: float) -> FloatArray:
        """Return the angles of the grid: the edges of all cut-outs and equal steps in between."""
        edges: list[float] = []
        for ring in self.rings:
            for centre in piece_angles(ring.cutout):
                edges += [centre - ring.half_angle, centre + ring.half_angle]
        breaks = _merge_equal_angles(edges) if edges else np.zeros(1)
        return _subdivide(np.append(breaks, breaks[0] + tau), step)[:-1]

    def nearest_column(self, angle: float) -> int:
        """Return the grid column nearest to an angle."""
        distances = np.abs(np.mod(self.angles - angle + pi, tau) - pi)
        return int(np.argmin(distances))

    def nearest_level(self, radius: float) -> int:
        """Return the grid level nearest to a radius."""
        return int(np.argmin(np.abs(self.radii - radius)))

    def point_index(self, level: np.ndarray | int, column: np.ndarray | int) -> np.ndarray:
        """Return the indices of grid points. Columns wrap around."""
        count = len(self.angles)
        return np.asarray(level) * count + np.mod(column, count)

    def cutout_span(self, ring: CutoutRing, centre: float) -> tuple[int, int, int, int]:
        """Return first level, last level, first column and last column of one slot or hole."""
        first = self.nearest_column(centre - ring.half_angle)
        last = self.nearest_column(centre + ring.half_angle)
        if last <= first:
            last += len(self.angles)
        return self.nearest_level(ring.inner), self.nearest_level(ring.outer), first, last

    def _mark_cells(self) -> np.ndarray:
        count = len(self.angles)
        is_kept = np.ones((len(self.radii) - 1, count), dtype=bool)
        for ring in self.rings:
            for centre in piece_angles(ring.cutout):
                low, high, first, last = self.cutout_span(ring, centre)
                is_kept[low:high, np.mod(np.arange(first, last), count)] = False
        return is_kept

    def _make_triangles(self, is_kept: np.ndarray) -> np.ndarray:
        """Return two triangles for each cell, cut along the shorter diagonal.

        If both diagonals are equal, they alternate from level to level.
        """
        level, column = np.nonzero(is_kept)
        a, b = self.point_index(level, column), self.point_index(level + 1, column)
        c, d = self.point_index(level + 1, column + 1), self.point_index(level, column + 1)
        forward_lengths, backward_lengths = (
            np.hypot(*(self.points[:, start] - self.points[:, end]))
            for start, end in ((a, c), (b, d))
        )
        use_forward = np.where(
            np.isclose(forward_lengths, backward_lengths),
            level % 2 == 0,
            forward_lengths < backward_lengths,
        )
        first = np.where(use_forward, [a, b, c], [a, b, d])
        second = np.where(use_forward, [a, c, d], [b, c, d])
        return np.concatenate([first, second], axis=1)


def piece_angles(cutout: PlateCutout) -> FloatArray:
    """Return the centre angles, rad, of the slots or holes of a cut-out at their inner end."""
    return cutout.start + tau * np.arange(cutout.count) / cutout.count


def _merge_equal_angles(angles: list[float]) -> FloatArray:
    sorted_angles = np.sort(np.mod(angles, tau))
    return sorted_angles[
        np.diff(sorted_angles, append=sorted_angles[0] + tau) > _ANGLE_TOLERANCE_RAD
    ]


def _subdivide(breaks: FloatArray, step: float) -> FloatArray:
    """Return values from the first to the last break that include all breaks.

    They are at most a step apart.
    """
    segments = [
        np.linspace(low, high, max(1, ceil((high - low) / step - 1e-6)), endpoint=False)
        for low, high in pairwise(breaks)
    ]
    return np.append(np.concatenate(segments), breaks[-1])


def _compute_twist_angles(ring: CutoutRing, radii: FloatArray) -> FloatArray:
    fraction = np.log(radii / ring.inner) / log(ring.outer / ring.inner)
    return np.asarray(ring.cutout.twist * np.clip(fraction, 0.0, 1.0))


def _fill_around_holes(
    grid: _Grid, ring: CutoutRing, points: FloatArray, triangles: np.ndarray
) -> tuple[FloatArray, np.ndarray]:
    """Fill the free cells around each hole with elements along rays from the grid to its circle."""
    cutout = ring.cutout
    assert cutout.radius is not None
    assert cutout.circle_radius is not None
    for centre in piece_angles(cutout):
        low, high, first, last = grid.cutout_span(ring, centre)
        border = np.concatenate(
            [
                grid.point_index(low, np.arange(first, last)),
                grid.point_index(np.arange(low, high), last),
                grid.point_index(high, np.arange(last, first, -1)),
                grid.point_index(np.arange(high, low, -1), first),
            ]
        )
        # Rings further inside may have twisted the grid.
        angle = centre + grid.twist[low]
        centre_point = cutout.circle_radius * np.array([[np.cos(angle)], [np.sin(angle)]])
        rays = points[:, border] - centre_point
        ray_lengths = np.hypot(*rays)
        circle_points = rays / ray_lengths * cutout.radius
        spacing = tau * cutout.radius / border.size
        layers = max(2, ceil(float(ray_lengths.min() - cutout.radius) / spacing))
        layer_indices = [border]
        new_points = []
        for layer in range(1, layers + 1):
            fraction = layer / layers
            new_points.append(centre_point + (1.0 - fraction) * rays + fraction * circle_points)
            start = points.shape[1] + (layer - 1) * border.size
            layer_indices.append(np.arange(start, start + border.size))
        points = np.concatenate([points, *new_points], axis=1)
        for outer, inner in pairwise(layer_indices):
            a, b, c, d = outer, np.roll(outer, -1), np.roll(inner, -1), inner
            triangles = np.concatenate([triangles, [a, b, c], [a, c, d]], axis=1)
    return points, triangles


def _orient_anticlockwise(points: FloatArray, triangles: np.ndarray) -> np.ndarray:
    is_clockwise = _compute_signed_areas(points, triangles) < 0.0
    triangles = triangles.copy()
    triangles[1:, is_clockwise] = triangles[:0:-1, is_clockwise]
    return triangles


def _compute_signed_areas(points: FloatArray, triangles: np.ndarray) -> FloatArray:
    a, b, c = (points[:, corner] for corner in triangles)
    u, v = b - a, c - a
    return np.asarray(0.5 * (u[0] * v[1] - u[1] * v[0]))


def _check_quality(points: FloatArray, triangles: np.ndarray) -> None:
    corners = points[:, triangles]
    sides = np.sum((corners - np.roll(corners, 1, axis=1)) ** 2, axis=(0, 1))
    quality = 4.0 * np.sqrt(3.0) * _compute_signed_areas(points, triangles) / sides
    worst_element = int(np.argmin(quality))
    if quality[worst_element] < _MIN_QUALITY:
        x, y = 1e3 * points[:, triangles[:, worst_element]].mean(axis=1)
        raise PlateError(
            "no mesh can be made: the element at x {x} mm, y {y} mm has quality "
            "{quality} (at least {worst_quality}); edges of cut-outs are too close "
            "together or nearly in line there; align them, or move them apart",
            x=format_rounded(x, 3),
            y=format_rounded(y, 3),
            quality=format_rounded(quality[worst_element], 2),
            worst_quality=_MIN_QUALITY,
        )
