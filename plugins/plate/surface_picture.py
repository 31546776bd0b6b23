"""The plate as a coloured surface, with a moved hub or vibrating in a mode."""

from dataclasses import dataclass

import numpy as np

from rotemina.plugins.plate import tr
from rotemina.plugins.plate.coloured_quantities import QUANTITIES, ColouredQuantity
from rotemina.plugins.plate.solution import SolvedPlate
from rotemina.plugins.plate.surface_drawing import ColouredSurface
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate import deflection

# At scale 1, the largest deflection is drawn with this height, relative to the radius of the rim.
_DRAWN_DEFLECTION_RATIO = 0.25


@dataclass(frozen=True, slots=True, eq=False)
class PlatePicture:
    """Surface with a title and a colour scale from ``low`` to ``high``, in ``unit``.

    ``magnification`` is the ratio of the drawn to the real deflection.
    """

    surface: ColouredSurface
    title: str
    unit: str
    low: float
    high: float
    magnification: float


def make_static_picture(
    solved: SolvedPlate, pose: FloatArray, quantity: ColouredQuantity, scale: float
) -> PlatePicture:
    """Return the plate with a moved hub. At ``scale`` 1 the range of motion is clearly visible.

    The colour scale covers the whole range of motion, so a colour has the same meaning at every
    pose.
    """
    largest = solved.largest[QUANTITIES.index(quantity)]
    low = -largest if quantity.is_signed else 0.0
    magnification = scale * _DRAWN_DEFLECTION_RATIO * solved.radius / solved.largest_deflection
    surface = _make_surface(
        solved,
        deflection(solved.solutions, pose) * magnification,
        quantity.compute(solved.solutions, pose),
        (low, largest),
        pose * magnification,
    )
    per_si = quantity.per_si
    return PlatePicture(
        surface, tr(quantity.title), quantity.unit, low * per_si, largest * per_si, magnification
    )


def make_mode_picture(solved: SolvedPlate, index: int, phase: float, scale: float) -> PlatePicture:
    """Return a mode at a phase (rad) of its vibration. The amplitude is arbitrary."""
    shape = solved.modes.deflection[index]
    phase_factor = np.sin(phase)
    amplitude = scale * _DRAWN_DEFLECTION_RATIO * solved.radius
    hub = solved.modes.hub[index] * phase_factor * amplitude
    surface = _make_surface(
        solved, shape * phase_factor * amplitude, shape * phase_factor, (-1.0, 1.0), hub
    )
    frequency = solved.modes.frequencies_hz[index]
    title = tr("Mode {number}, {frequency:.0f} Hz")
    title = title.format(number=index + 1, frequency=frequency)
    return PlatePicture(surface, title, "", -1.0, 1.0, 1.0)


def _make_surface(
    solved: SolvedPlate,
    height: FloatArray,
    values: FloatArray,
    value_range: tuple[float, float],
    hub: FloatArray,
) -> ColouredSurface:
    low, high = value_range
    span = high - low if high > low else 1.0
    triangles = solved.mesh.triangles
    colour_values = (values[triangles].mean(axis=0) - low) / span
    plane = np.concatenate([solved.mesh.points, np.zeros((2, 1))], axis=1)
    zn, thx, thy = hub
    points = np.concatenate([plane, [np.append(height, zn)]])
    lid = solved.hub_lid
    # The pin is fixed to the hub. Its tilt is magnified like the deflection of the plate.
    length = min(solved.pin_length_m, 2.0 * solved.radius)
    pin_end = [-thy * length, thx * length, zn - length]
    return ColouredSurface(
        points=points,
        triangles=np.concatenate([triangles, lid], axis=1),
        values=np.append(colour_values, np.full(lid.shape[1], np.nan)),
        radius=solved.radius,
        pin_axis=np.array([[0.0, pin_end[0]], [0.0, pin_end[1]], [zn, pin_end[2]]]),
        pin_radius=solved.solutions.clamped.plate.pin.diameter / 2.0,
    )
