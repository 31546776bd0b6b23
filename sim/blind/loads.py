"""Forces that the model lacks: backlash, friction, contact, hardening; and wrong structure."""

from collections.abc import Sequence

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.part import Axis, Course, Part, Stage


def row(code: int, axis: Axis, numbers: Sequence[float]) -> FloatArray:
    """Return the row of a load table."""
    out = np.zeros(mechanics.ROW)
    out[0], out[1] = code, axis.index
    out[2 : 2 + len(numbers)] = numbers
    return out


def backlash(axis: Axis, rng: np.random.Generator) -> Part:
    """Dead band in the drive train, ahead of the axis' springs; size is its width, m.

    A Duhem model: dy = ((1 ± (x − y)/h)/2)ⁿ dx with the half width h, + on the way up; the drive
    takes the load up softly, the more so the smaller n.
    """
    power = np.exp(rng.uniform(np.log(3.0), np.log(30.0)))

    def act(values: FloatArray, course: Course, size: float) -> FloatArray:
        return _dragged(values, 0.5 * size, power)

    return Part("backlash", axis, Stage.ACTUATOR, act, (1e-7, 3e-5))


@numba.njit(cache=True, error_model="numpy")
def _dragged(values: FloatArray, half: float, power: float) -> FloatArray:
    out = np.empty_like(values)
    behind = half  # after a rise
    for k in range(len(values)):
        move = values[k] - values[k - 1] if k > 0 else 0.0
        pieces = min(max(int(np.ceil(abs(move) / (0.1 * half))), 1), 400)
        for _ in range(pieces):
            side = behind / half if move > 0.0 else -behind / half
            taken = max(0.5 + 0.5 * side, 0.0) ** power
            behind += move / pieces * (1.0 - taken)
            behind = min(max(behind, -half), half)
        out[k] = values[k] - behind
    return out


def friction(axis: Axis, rng: np.random.Generator) -> Part:
    """Friction by Maxwell slip, Dahl or an elastoplastic bristle; size is the Coulomb force, N."""
    code = (mechanics.SLIP, mechanics.SLIP, mechanics.DAHL, mechanics.ELASTOPLASTIC)[
        rng.integers(4)
    ]
    other = rng.uniform(0.85, 1.15)
    static = rng.uniform(1.05, 1.5)
    fifth = {mechanics.SLIP: 10.0 ** rng.uniform(-4, -3), mechanics.DAHL: rng.uniform(0.6, 1.6)}
    length = 10.0 ** rng.uniform(-6.7, -5.3)
    viscous = rng.uniform(0.0, 0.1) * axis.damping
    shape = fifth.get(code, rng.uniform(0.4, 0.8))

    def act(values: FloatArray, course: Course, size: float) -> FloatArray:
        # No stiffer than the fine step can follow.
        reach = max(length, 8.0 * size * course.step_s**2 / axis.mass)
        numbers = [size, size * other, static, shape, reach, 3e3, viscous]
        return row(code, axis, numbers)

    return Part("friction", axis, Stage.LOAD, act, (0.3, 300.0))


def contact(axis: Axis, rng: np.random.Generator) -> Part:
    """Hertz contact beyond a position near one end of the travel; size over the axis' stiffness."""
    side = rng.choice([-1.0, 1.0])
    inside = rng.uniform(0.08, 0.3)
    at = axis.start + (1.0 - inside if side > 0.0 else inside) * axis.travel
    power, damper = rng.choice([1.5, 1.5, 2.0]), rng.uniform(0.0, 0.5)

    def act(values: FloatArray, course: Course, size: float) -> FloatArray:
        reach = 0.2 * axis.travel
        stiff = size * axis.stiffness * reach ** (1.0 - power)
        return row(mechanics.CONTACT, axis, [at, stiff, damper / reach * 1e-3, side, power])

    return Part("contact", axis, Stage.LOAD, act, (1e-4, 4.0))


def stiffness_nonlinearity(axis: Axis, rng: np.random.Generator) -> Part:
    """Hardening flexure by sinh, power or tangent; size over the axis' stiffness."""
    law = float(rng.integers(3))
    sharp = rng.uniform(1.5, 3.0)
    rest = axis.low + axis.span * rng.choice([0.0, 0.5, rng.uniform(0.3, 0.7)])
    # Nowhere in the range so near its pole that the tangent is cut off: it would harden no more.
    length = 1.2 * max(rest - axis.low, axis.low + axis.span - rest)

    def act(values: FloatArray, course: Course, size: float) -> FloatArray:
        stiff = size * axis.stiffness * length
        return row(mechanics.HARDENING, axis, [stiff, rest, length, law, sharp])

    return Part("stiffness_nonlinearity", axis, Stage.LOAD, act, (1e-3, 0.6))


def resonance_mismatch(axis: Axis, rng: np.random.Generator) -> Part:
    """Stiffness and damping off; size is the share by which the stiffness is."""
    sign = rng.choice([-1.0, 1.0])
    damping = rng.uniform(-2.0, 2.0)

    def act(values: FloatArray, course: Course, size: float) -> FloatArray:
        scales = [1.0 + sign * size, float(np.exp(damping * size)), 0.0, 0.0, 0.0]
        return row(0, axis, scales)

    return Part("resonance_mismatch", axis, Stage.STRUCTURE, act, (0.01, 0.35))


def flexible_mode(axis: Axis, rng: np.random.Generator) -> Part:
    """One or two appendages on springs; size is the mass of the first over the axis'."""
    own = np.sqrt(axis.stiffness / axis.mass) / (2.0 * np.pi)
    number = rng.choice([1, 1, 2])
    frequencies = own * rng.choice([rng.uniform(0.3, 0.75), rng.uniform(1.4, 2.2)], number)
    damping = rng.uniform(0.005, 0.05)

    def act(values: FloatArray, course: Course, size: float) -> FloatArray:
        rows = [row(1, axis, [size / (1 + i), f, damping]) for i, f in enumerate(frequencies)]
        return np.array(rows)

    return Part("flexible_mode", axis, Stage.STRUCTURE, act, (2e-3, 0.3))
