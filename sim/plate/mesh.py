"""Meshes of a plate from hub to rim: rings of a polar grid, bent along its cut-outs.

Grid lines follow the edges of slots, a twist of the grid makes spiral ones straight, and each
hole sits in a patch of rays between its circle and the grid around it. Nothing is random, and the
same plate gives the same mesh.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, log, pi, tau

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.geometry import Ring, impossible, rings
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.plate import Cutout, Plate

DIVISIONS = 120  # of a turn, at the default mesh
FEWEST, MOST = 16, 2000
# Elements are this much shorter along the radius than around it: stress changes along the radius.
_SHORTER = 1.5
_WORST_QUALITY = 0.02  # of a triangle; 1 is equilateral
_SAME = 1e-7  # rad; grid lines closer than this are one


@dataclass(frozen=True, slots=True)
class PlateMesh:
    """A triangle mesh of a plate.

    Attributes
    ----------
    points : (2, n) array
        m; the plate's middle is the origin.
    triangles : (3, t) array of indices into the points
        Anticlockwise.
    hub, rim : (n,) arrays of bool
        Which points lie on the hub's and on the rim's circle.
    """

    points: FloatArray
    triangles: np.ndarray
    hub: np.ndarray
    rim: np.ndarray


def make_mesh(plate: Plate, divisions: int = DIVISIONS) -> PlateMesh:
    """Mesh a plate with about ``divisions`` elements around the turn.

    Raises
    ------
    PlateError
        If the plate is impossible, or cut-outs are so close to one another that elements would be
        slivers.
    """
    problem = next(impossible(plate), None)
    if problem is not None:
        value = "missing" if problem.value is None else problem.value
        raise PlateError(
            message("engine", "plate.{key} = {value}: {bound}").fill(
                key=problem.key, value=str(value), bound=problem.bound
            )
        )
    if not FEWEST <= divisions <= MOST:
        raise PlateError(
            message(
                "engine",
                "divisions of the turn = {divisions}: must be {fewest} to {most}; {usual} is usual",
            ).fill(divisions=divisions, fewest=FEWEST, most=MOST, usual=DIVISIONS)
        )
    grid = _Grid(plate, divisions)
    points, triangles = grid.points, grid.triangles
    for one in grid.rings:
        if one.cutout.kind == "hole":
            points, triangles = _with_holes(grid, one, points, triangles)
    used = np.unique(triangles)
    number = np.full(points.shape[1], -1)
    number[used] = np.arange(used.size)
    points, triangles = points[:, used], number[triangles]
    triangles = _anticlockwise(points, triangles)
    _require_quality(points, triangles)
    radius = np.hypot(*points)
    slack = 1e-9 * plate.rim_radius
    return PlateMesh(
        points,
        triangles,
        hub=np.abs(radius - plate.hub_radius) < slack,
        rim=np.abs(radius - plate.rim_radius) < slack,
    )


class _Grid:
    """Levels of radius times directions of angle, with what cut-outs take away left out."""

    def __init__(self, plate: Plate, divisions: int) -> None:
        self.rings = rings(plate)
        edges = [plate.hub_radius, plate.rim_radius]
        edges += [r for one in self.rings for r in (one.inner, one.outer)]
        step = tau / divisions / _SHORTER
        self.radii = _divided(np.log(sorted(edges)), step)
        self.radii = np.exp(self.radii)
        self.radii[0], self.radii[-1] = plate.hub_radius, plate.rim_radius
        self.angles = self._directions(tau / divisions)
        self.twist = sum((_twist(one, self.radii) for one in self.rings), np.zeros(len(self.radii)))
        theta = self.angles[None, :] + self.twist[:, None]
        radius = self.radii[:, None]
        self.points = np.stack([(radius * np.cos(theta)).ravel(), (radius * np.sin(theta)).ravel()])
        self.triangles = self._split(self._kept())

    def _directions(self, step: float) -> FloatArray:
        """Return the angles of the grid: the edges of all cut-outs, and even steps between."""
        edges: list[float] = []
        for one in self.rings:
            for centre in centres(one.cutout):
                edges += [centre - one.half_angle, centre + one.half_angle]
        breaks = _distinct(edges) if edges else np.zeros(1)
        return _divided(np.append(breaks, breaks[0] + tau), step)[:-1]

    def column(self, angle: float) -> int:
        """Return the grid's direction nearest to an angle."""
        away = np.abs(np.mod(self.angles - angle + pi, tau) - pi)
        return int(np.argmin(away))

    def level(self, radius: float) -> int:
        """Return the grid's level nearest to a radius."""
        return int(np.argmin(np.abs(self.radii - radius)))

    def index(self, level: np.ndarray | int, column: np.ndarray | int) -> np.ndarray:
        """Return the numbers of grid points; directions go round."""
        count = len(self.angles)
        return np.asarray(level) * count + np.mod(column, count)

    def span(self, one: Ring, centre: float) -> tuple[int, int, int, int]:
        """Return the first and last level and direction of one cut-out's piece."""
        first = self.column(centre - one.half_angle)
        last = self.column(centre + one.half_angle)
        if last <= first:
            last += len(self.angles)
        return self.level(one.inner), self.level(one.outer), first, last

    def _kept(self) -> np.ndarray:
        count = len(self.angles)
        kept = np.ones((len(self.radii) - 1, count), dtype=bool)
        for one in self.rings:
            for centre in centres(one.cutout):
                low, high, first, last = self.span(one, centre)
                kept[low:high, np.mod(np.arange(first, last), count)] = False
        return kept

    def _split(self, kept: np.ndarray) -> np.ndarray:
        """Return two triangles for each cell, the same all round: cut along the shorter diagonal.

        Where neither is, along the one and the other from level to level.
        """
        level, column = np.nonzero(kept)
        a, b = self.index(level, column), self.index(level + 1, column)
        c, d = self.index(level + 1, column + 1), self.index(level, column + 1)
        forward, back = (
            np.hypot(*(self.points[:, start] - self.points[:, end]))
            for start, end in ((a, c), (b, d))
        )
        even = np.where(np.isclose(forward, back), level % 2 == 0, forward < back)
        one = np.where(even, [a, b, c], [a, b, d])
        other = np.where(even, [a, c, d], [b, c, d])
        return np.concatenate([one, other], axis=1)


def centres(cutout: Cutout) -> FloatArray:
    """Return the angles of the middles of a cut-out's pieces at their inner end, rad."""
    return cutout.start + tau * np.arange(cutout.count) / cutout.count


def _distinct(angles: list[float]) -> FloatArray:
    """Return angles of one turn in order, those that differ by rounding alone as one."""
    ordered = np.sort(np.mod(angles, tau))
    return ordered[np.diff(ordered, append=ordered[0] + tau) > _SAME]


def _divided(breaks: FloatArray, step: float) -> FloatArray:
    """Return values from the first break to the last, through all, at most a step apart."""
    parts = [
        np.linspace(low, high, max(1, ceil((high - low) / step - 1e-6)), endpoint=False)
        for low, high in pairwise(breaks)
    ]
    return np.append(np.concatenate(parts), breaks[-1])


def _twist(one: Ring, radii: FloatArray) -> FloatArray:
    share = np.log(radii / one.inner) / log(one.outer / one.inner)
    return np.asarray(one.cutout.twist * np.clip(share, 0.0, 1.0))


def _with_holes(
    grid: _Grid, one: Ring, points: FloatArray, triangles: np.ndarray
) -> tuple[FloatArray, np.ndarray]:
    """Fill the pieces left out around a ring of holes with rays from border to circle."""
    cutout = one.cutout
    assert cutout.radius is not None
    assert cutout.circle_radius is not None
    for centre in centres(cutout):
        low, high, first, last = grid.span(one, centre)
        border = np.concatenate(
            [
                grid.index(low, np.arange(first, last)),
                grid.index(np.arange(low, high), last),
                grid.index(high, np.arange(last, first, -1)),
                grid.index(np.arange(high, low, -1), first),
            ]
        )
        # Rings further in may have turned the grid.
        angle = centre + grid.twist[low]
        middle = cutout.circle_radius * np.array([[np.cos(angle)], [np.sin(angle)]])
        ray = points[:, border] - middle
        length = np.hypot(*ray)
        circle = ray / length * cutout.radius
        spacing = tau * cutout.radius / border.size
        layers = max(2, ceil(float(length.min() - cutout.radius) / spacing))
        numbers = [border]
        added = []
        for layer in range(1, layers + 1):
            share = layer / layers
            added.append(middle + (1.0 - share) * ray + share * circle)
            start = points.shape[1] + (layer - 1) * border.size
            numbers.append(np.arange(start, start + border.size))
        points = np.concatenate([points, *added], axis=1)
        for outer, inner in pairwise(numbers):
            a, b, c, d = outer, np.roll(outer, -1), np.roll(inner, -1), inner
            triangles = np.concatenate([triangles, [a, b, c], [a, c, d]], axis=1)
    return points, triangles


def _anticlockwise(points: FloatArray, triangles: np.ndarray) -> np.ndarray:
    clockwise = _areas(points, triangles) < 0.0
    triangles = triangles.copy()
    triangles[1:, clockwise] = triangles[:0:-1, clockwise]
    return triangles


def _areas(points: FloatArray, triangles: np.ndarray) -> FloatArray:
    a, b, c = (points[:, corner] for corner in triangles)
    u, v = b - a, c - a
    return np.asarray(0.5 * (u[0] * v[1] - u[1] * v[0]))


def _require_quality(points: FloatArray, triangles: np.ndarray) -> None:
    corners = points[:, triangles]
    sides = np.sum((corners - np.roll(corners, 1, axis=1)) ** 2, axis=(0, 1))
    quality = 4.0 * np.sqrt(3.0) * _areas(points, triangles) / sides
    worst = int(np.argmin(quality))
    if quality[worst] < _WORST_QUALITY:
        x, y = 1e3 * points[:, triangles[:, worst]].mean(axis=1)
        raise PlateError(
            message(
                "engine",
                "no mesh can be made: the element at x {x} mm, y {y} mm has quality "
                "{quality} (at least {worst_quality}); edges of cut-outs are too close "
                "together or nearly in line there; align them, or move them apart",
            ).fill(
                x=rounded(x, 3),
                y=rounded(y, 3),
                quality=rounded(quality[worst], 2),
                worst_quality=_WORST_QUALITY,
            )
        )
