"""A simulated cell whose membrane yields to the tip, is pierced, and keeps a hole.

The membrane is an ellipsoid. Where the tip touches it, the membrane moves with the tip. Points at a
distance d from there follow by the factor ``exp(−d²/2w²)``. When the tip is deeper than the
membrane can withstand, it pierces the membrane, which springs back except for a small share, and
the hole stays. The path of the tip between two pictures counts as straight, so a fast thrust
pierces too. A pierced cell stays pierced when the tip leaves it.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import SceneError

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class SimulatedCell:
    """A cell at rest; lengths in m.

    Attributes
    ----------
    centre_m : tuple of float
    radii_m : tuple of float
        Half axes along x, y, z.
    nucleus_m : tuple of float
        Centre of the nucleus relative to the centre of the cell.
    nucleus_radius_m : float
    breaking_m : float
        Distance that the membrane moves with the tip before it is pierced.
    dimple_m : float
        Radius w of the dimple around the tip.
    membrane_m : float
        Half the apparent thickness of the membrane.
    remaining : float
        Share of the dimple that remains around the tip after piercing.
    """

    centre_m: Vector
    radii_m: Vector = (22e-6, 18e-6, 12e-6)
    nucleus_m: Vector = (-4e-6, 3e-6, 0.0)
    nucleus_radius_m: float = 6e-6
    breaking_m: float = 4e-6
    dimple_m: float = 5e-6
    membrane_m: float = 0.4e-6
    remaining_dimple_share: float = 0.2

    def __post_init__(self) -> None:
        sizes = (*self.radii_m, self.nucleus_radius_m, self.breaking_m, self.dimple_m)
        if not all(0.0 < size < float("inf") for size in (*sizes, self.membrane_m)):
            raise SceneError(
                "cell: radii {radii_m}, nucleus {nucleus_radius_m}, breaking {breaking_m}, "
                "dimple {dimple_m}, membrane {membrane_m} m: each must be more than 0",
                radii_m=str(self.radii_m),
                nucleus_radius_m=self.nucleus_radius_m,
                breaking_m=self.breaking_m,
                dimple_m=self.dimple_m,
                membrane_m=self.membrane_m,
            )

    @classmethod
    def near_view_centre(cls, point_m: Vector) -> Self:
        """Return a cell whose centre is 45 µm in −x, 10 µm in +y and 6 µm below a point."""
        x, y, z = point_m
        return cls((x - 45e-6, y + 10e-6, z - 6e-6))

    @classmethod
    def with_contact_at(cls, point_m: FloatArray, way: FloatArray) -> Self:
        """Return a cell that a tip first touches at a point (3,), m, when it moves along ``way``.

        The centre lies straight ahead of the point, in the direction ``way`` (3,).
        """
        direction = way / np.linalg.norm(way)
        centre_distance = 1.0 / np.linalg.norm(
            direction / np.array(cls(_to_vector(point_m)).radii_m)
        )
        return cls(_to_vector(point_m + centre_distance * direction))

    def radius_ratio_at(self, point_m: FloatArray) -> FloatArray:
        """Return the relative radii (...) of points (..., 3).

        They are 0 at the centre and 1 at the membrane at rest.
        """
        scaled = (np.asarray(point_m) - np.array(self.centre_m)) / np.array(self.radii_m)
        return np.asarray(np.sqrt((scaled**2).sum(axis=-1)))


@dataclass(frozen=True, slots=True)
class CellState:
    """State of a cell after contacts with the tip.

    Attributes
    ----------
    tip_m : tuple of float or None
        Last position of the tip.
    entry_m : tuple of float or None
        Where the tip met the membrane, while the tip is inside.
    hole_m : tuple of float or None
        Where the membrane was pierced.
    """

    tip_m: Vector | None = None
    entry_m: Vector | None = None
    hole_m: Vector | None = None

    @property
    def is_pierced(self) -> bool:
        """Whether the membrane has a hole."""
        return self.hole_m is not None


UNTOUCHED_CELL_STATE = CellState()


def advance_cell_state(cell: SimulatedCell, state: CellState, tip_m: FloatArray) -> CellState:
    """Return the state of the cell after the tip has moved straight to ``tip_m`` (3,)."""
    tip = _to_vector(tip_m)
    if not cell.radius_ratio_at(tip_m) < 1.0:
        pierced_point = _find_pass_through_hole(cell, state, tip_m)
        return replace(state, tip_m=tip, entry_m=None, hole_m=state.hole_m or pierced_point)
    entry = state.entry_m or _find_entry(cell, state.tip_m, tip_m)
    is_deep = float(np.linalg.norm(tip_m - np.array(entry))) > cell.breaking_m
    return CellState(tip, entry, state.hole_m or (entry if is_deep else None))


def dimple_displacement(cell: SimulatedCell, state: CellState) -> FloatArray:
    """Return the displacement (3,), m, of the membrane where the tip met it."""
    if state.entry_m is None or state.tip_m is None:
        return np.zeros(3)
    path = np.array(state.tip_m) - np.array(state.entry_m)
    if not state.is_pierced:
        return np.asarray(path)
    length = float(np.linalg.norm(path))
    return np.asarray(
        path * cell.remaining_dimple_share * min(1.0, cell.breaking_m / max(length, 1e-12))
    )


def displace_points(cell: SimulatedCell, state: CellState, points_m: FloatArray) -> FloatArray:
    """Return the present positions of points (..., 3) of the membrane at rest."""
    if state.entry_m is None:
        return points_m
    squared_distance = ((points_m - np.array(state.entry_m)) ** 2).sum(axis=-1, keepdims=True)
    return np.asarray(
        points_m
        + np.exp(-squared_distance / (2.0 * cell.dimple_m**2)) * dimple_displacement(cell, state)
    )


def _find_crossings(
    cell: SimulatedCell, start_m: FloatArray, end_m: FloatArray
) -> tuple[float, float] | None:
    """Return the two points, as shares of a straight path, where it crosses the membrane at rest.

    Return None if it does not cross the membrane. The path may be extended beyond its ends.
    """
    radii = np.array(cell.radii_m)
    start = (start_m - np.array(cell.centre_m)) / radii
    path = (end_m - start_m) / radii
    a, b, c = float(path @ path), float(start @ path), float(start @ start) - 1.0
    discriminant = b * b - a * c
    if a == 0.0 or discriminant <= 0.0:
        return None
    root = discriminant**0.5
    return (-b - root) / a, (-b + root) / a


def _find_entry(cell: SimulatedCell, previous_tip: Vector | None, tip_m: FloatArray) -> Vector:
    """Return where the tip met the membrane.

    If the previous position is unknown, return the point of the membrane on the ray from the
    centre through the tip.
    """
    if previous_tip is not None:
        start = np.array(previous_tip)
        crossings = _find_crossings(cell, start, tip_m)
        if crossings is not None and 0.0 <= crossings[0] <= 1.0:
            return _to_vector(start + crossings[0] * (tip_m - start))
    centre = np.array(cell.centre_m)
    radius_ratio = float(cell.radius_ratio_at(tip_m))
    if radius_ratio == 0.0:
        return _to_vector(centre + np.array([0.0, 0.0, cell.radii_m[2]]))
    return _to_vector(centre + (tip_m - centre) / radius_ratio)


def _find_pass_through_hole(
    cell: SimulatedCell, state: CellState, tip_m: FloatArray
) -> Vector | None:
    """Return the hole of a tip that passed through the whole cell between two pictures, or None."""
    if state.tip_m is None or cell.radius_ratio_at(np.array(state.tip_m)) < 1.0:
        return None
    start = np.array(state.tip_m)
    crossings = _find_crossings(cell, start, tip_m)
    if crossings is None or crossings[0] < 0.0 or crossings[1] > 1.0:
        return None
    length = (crossings[1] - crossings[0]) * float(np.linalg.norm(tip_m - start))
    return _to_vector(start + crossings[0] * (tip_m - start)) if length > cell.breaking_m else None


def _to_vector(point: FloatArray) -> Vector:
    return (float(point[0]), float(point[1]), float(point[2]))
