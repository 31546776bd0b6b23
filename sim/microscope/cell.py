"""A cell, and what the tip does to it: the membrane gives way, breaks, and keeps a hole.

The membrane is an ellipsoid. From where the tip meets it, the membrane goes along with the tip;
points beside that follow by ``exp(−d²/2w²)`` of their distance d. When the tip is deeper than the
membrane stands, it is pierced: it falls back but for a share, and the hole stays. The tip's path
between two pictures counts as straight, so a fast thrust pierces, too. A pierced cell stays when
its contact is removed.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.microscope.errors import SceneError

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell at rest; lengths in m.

    Attributes
    ----------
    centre_m : tuple of float
    radii_m : tuple of float
        Half axes along x, y, z.
    nucleus_m : tuple of float
        Its centre, from the cell's.
    nucleus_radius_m : float
    breaking_m : float
        How far the membrane goes along before it is pierced.
    dimple_m : float
        How far around the tip it does (w).
    membrane_m : float
        Half its apparent thickness.
    remaining : float
        Share of the dimple that stays around a tip that is inside.
    """

    centre_m: Vector
    radii_m: Vector = (22e-6, 18e-6, 12e-6)
    nucleus_m: Vector = (-4e-6, 3e-6, 0.0)
    nucleus_radius_m: float = 6e-6
    breaking_m: float = 4e-6
    dimple_m: float = 5e-6
    membrane_m: float = 0.4e-6
    remaining: float = 0.2

    def __post_init__(self) -> None:
        sizes = (*self.radii_m, self.nucleus_radius_m, self.breaking_m, self.dimple_m)
        if not all(0.0 < size < float("inf") for size in (*sizes, self.membrane_m)):
            raise SceneError(
                message(
                    "engine",
                    "cell: radii {radii_m}, nucleus {nucleus_radius_m}, breaking {breaking_m}, "
                    "dimple {dimple_m}, membrane {membrane_m} m: each must be more than 0",
                ).fill(
                    radii_m=str(self.radii_m),
                    nucleus_radius_m=self.nucleus_radius_m,
                    breaking_m=self.breaking_m,
                    dimple_m=self.dimple_m,
                    membrane_m=self.membrane_m,
                )
            )

    @classmethod
    def beside(cls, point_m: Vector) -> Self:
        """Return a cell 45 µm in −x and 10 µm in +y of a point, its middle 6 µm below it."""
        x, y, z = point_m
        return cls((x - 45e-6, y + 10e-6, z - 6e-6))

    @classmethod
    def met_at(cls, point_m: FloatArray, way: FloatArray) -> Self:
        """Return a cell that a tip meets at a point (3,), m, as it comes along ``way`` (3,).

        The middle is straight ahead of the point, so that the membrane is first met there.
        """
        ahead = way / np.linalg.norm(way)
        to_middle = 1.0 / np.linalg.norm(ahead / np.array(cls(_vector(point_m)).radii_m))
        return cls(_vector(point_m + to_middle * ahead))

    def level(self, point_m: FloatArray) -> FloatArray:
        """Return how far points (..., 3) are out, (...): 0 in the middle, 1 on the membrane."""
        scaled = (np.asarray(point_m) - np.array(self.centre_m)) / np.array(self.radii_m)
        return np.asarray(np.sqrt((scaled**2).sum(axis=-1)))


@dataclass(frozen=True, slots=True)
class CellState:
    """What has been done to a cell.

    Attributes
    ----------
    tip_m : tuple of float or None
        Where the tip was last.
    entry_m : tuple of float or None
        Where a tip that is inside met the membrane.
    hole_m : tuple of float or None
        Where the membrane was pierced.
    """

    tip_m: Vector | None = None
    entry_m: Vector | None = None
    hole_m: Vector | None = None

    @property
    def pierced(self) -> bool:
        """Whether the membrane has a hole."""
        return self.hole_m is not None


UNTOUCHED = CellState()


def met(cell: Cell, state: CellState, tip_m: FloatArray) -> CellState:
    """Return the cell after the tip has come straight to ``tip_m`` (3,)."""
    tip = _vector(tip_m)
    if not cell.level(tip_m) < 1.0:
        crossed = _pierced_on_the_way(cell, state, tip_m)
        return replace(state, tip_m=tip, entry_m=None, hole_m=state.hole_m or crossed)
    entry = state.entry_m or _entry(cell, state.tip_m, tip_m)
    deep = float(np.linalg.norm(tip_m - np.array(entry))) > cell.breaking_m
    return CellState(tip, entry, state.hole_m or (entry if deep else None))


def dimple(cell: Cell, state: CellState) -> FloatArray:
    """Return by which vector (3,), m, the membrane is displaced where the tip met it."""
    if state.entry_m is None or state.tip_m is None:
        return np.zeros(3)
    way = np.array(state.tip_m) - np.array(state.entry_m)
    if not state.pierced:
        return np.asarray(way)
    length = float(np.linalg.norm(way))
    return np.asarray(way * cell.remaining * min(1.0, cell.breaking_m / max(length, 1e-12)))


def displaced(cell: Cell, state: CellState, points_m: FloatArray) -> FloatArray:
    """Return where points (..., 3) of the membrane at rest are now."""
    if state.entry_m is None:
        return points_m
    away = ((points_m - np.array(state.entry_m)) ** 2).sum(axis=-1, keepdims=True)
    return np.asarray(points_m + np.exp(-away / (2.0 * cell.dimple_m**2)) * dimple(cell, state))


def _crossings(cell: Cell, start_m: FloatArray, end_m: FloatArray) -> tuple[float, float] | None:
    """Return at which shares of a straight way the membrane at rest is crossed, if it is."""
    radii = np.array(cell.radii_m)
    begin = (start_m - np.array(cell.centre_m)) / radii
    way = (end_m - start_m) / radii
    a, b, c = float(way @ way), float(begin @ way), float(begin @ begin) - 1.0
    under = b * b - a * c
    if a == 0.0 or under <= 0.0:
        return None
    root = under**0.5
    return (-b - root) / a, (-b + root) / a


def _entry(cell: Cell, before: Vector | None, tip_m: FloatArray) -> Vector:
    """Return where the tip met the membrane; the nearest place outwards if it came from nowhere."""
    if before is not None:
        start = np.array(before)
        found = _crossings(cell, start, tip_m)
        if found is not None and 0.0 <= found[0] <= 1.0:
            return _vector(start + found[0] * (tip_m - start))
    centre = np.array(cell.centre_m)
    level = float(cell.level(tip_m))
    if level == 0.0:
        return _vector(centre + np.array([0.0, 0.0, cell.radii_m[2]]))
    return _vector(centre + (tip_m - centre) / level)


def _pierced_on_the_way(cell: Cell, state: CellState, tip_m: FloatArray) -> Vector | None:
    """Return where a tip that went straight through, between two looks, has made a hole."""
    if state.tip_m is None or cell.level(np.array(state.tip_m)) < 1.0:
        return None
    start = np.array(state.tip_m)
    found = _crossings(cell, start, tip_m)
    if found is None or found[0] < 0.0 or found[1] > 1.0:
        return None
    length = (found[1] - found[0]) * float(np.linalg.norm(tip_m - start))
    return _vector(start + found[0] * (tip_m - start)) if length > cell.breaking_m else None


def _vector(point: FloatArray) -> Vector:
    return (float(point[0]), float(point[1]), float(point[2]))
