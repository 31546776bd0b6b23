"""The plate as a coloured surface, with its hub moved or vibrating in a mode."""

from dataclasses import dataclass

import numpy as np

from rotemina.plugins.plate import tr
from rotemina.plugins.plate.coloured_quantities import QUANTITIES, Quantity
from rotemina.plugins.plate.solution import Solved
from rotemina.plugins.plate.surface_drawing import Surface
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.stress import deflection

_HEIGHT = 0.25  # of the rim's radius is the largest deflection drawn at scale 1


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A surface with the ends of its colour scale in the quantity's unit."""

    surface: Surface
    title: str
    unit: str
    low: float
    high: float
    magnified: float  # how many times the deflection is drawn larger than it is


def static_picture(solved: Solved, pose: FloatArray, quantity: Quantity, scale: float) -> Picture:
    """Return the plate with its hub moved; ``scale`` 1 draws the range of motion well visible.

    The ends of the colour scale are those of the whole range of motion: a colour means the same
    wherever the hub is.
    """
    largest = solved.largest[QUANTITIES.index(quantity)]
    low = -largest if quantity.signed else 0.0
    magnified = scale * _HEIGHT * solved.radius / solved.largest_deflection
    surface = _surface(
        solved,
        deflection(solved.solutions, pose) * magnified,
        quantity.at(solved.solutions, pose),
        (low, largest),
        pose * magnified,
    )
    factor = quantity.per_si
    title = tr(quantity.title)
    return Picture(surface, title, quantity.unit, low * factor, largest * factor, magnified)


def mode_picture(solved: Solved, number: int, phase: float, scale: float) -> Picture:
    """Return a mode at a phase (rad) of its vibration; its size means nothing."""
    shape = solved.modes.deflection[number]
    swing = np.sin(phase)
    size = scale * _HEIGHT * solved.radius
    hub = solved.modes.hub[number] * swing * size
    surface = _surface(solved, shape * swing * size, shape * swing, (-1.0, 1.0), hub)
    frequency = solved.modes.frequencies_hz[number]
    title = tr("Mode {number}, {frequency:.0f} Hz")
    title = title.format(number=number + 1, frequency=frequency)
    return Picture(surface, title, "", -1.0, 1.0, 1.0)


def _surface(
    solved: Solved,
    height: FloatArray,
    values: FloatArray,
    ends: tuple[float, float],
    hub: FloatArray,
) -> Surface:
    low, high = ends
    span = high - low if high > low else 1.0
    triangles = solved.mesh.triangles
    coloured = (values[triangles].mean(axis=0) - low) / span
    plane = np.concatenate([solved.mesh.points, np.zeros((2, 1))], axis=1)
    zn, thx, thy = hub
    points = np.concatenate([plane, [np.append(height, zn)]])
    lid = solved.hub_lid
    # The pin stands on the hub, drawn as much steeper as the plate is drawn higher.
    length = min(solved.pin_length_m, 2.0 * solved.radius)
    tip = [-thy * length, thx * length, zn - length]
    return Surface(
        points=points,
        triangles=np.concatenate([triangles, lid], axis=1),
        values=np.append(coloured, np.full(lid.shape[1], np.nan)),
        radius=solved.radius,
        rod=np.array([[0.0, tip[0]], [0.0, tip[1]], [zn, tip[2]]]),
        rod_radius=solved.solutions.held.plate.pin.diameter / 2.0,
    )
