"""Forces that the model lacks: backlash, friction, contact, hardening; and wrong structure."""

from collections.abc import Sequence

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage

_BRISTLES = 6
_ALL_SHARES = 21.0  # 1 + 2 + … + 6
_HALVINGS = 45


def row(code: int, axis: Axis, numbers: Sequence[float]) -> FloatArray:
    """Return the row of a load table."""
    out = np.zeros(mechanics.ROW)
    out[0], out[1] = code, axis.index
    out[2 : 2 + len(numbers)] = numbers
    return out


def backlash(axis: Axis, rng: np.random.Generator) -> Part:
    """Dead band in the drive train, ahead of the axis' springs; size is its width, m.

    A nut without mass between two flanks, on a dry guide: where it stands, the push of a flank,
    ``(δ / bh)ⁿ`` at an indentation δ ≤ bh, equals what the guide holds it back with, bristles that
    slip one after the other over a length gh, 1 in all; h is half the gap. Dragged along, the nut
    stays half the width, h + bh, behind; in the gap nothing moves it.
    """
    flank = np.exp(rng.uniform(np.log(0.03), np.log(0.4)))
    bristles = np.exp(rng.uniform(np.log(0.03), np.log(0.4)))
    power = rng.uniform(1.0, 2.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        half_gap = 0.5 * size / (1.0 + flank)
        return np.asarray(half_gap * _pushed(values / half_gap, flank, bristles, power))

    return Part("backlash", axis, Stage.ACTUATOR, act, (1e-7, 3e-5))


@numba.njit(cache=True, error_model="numpy")
def _pushed(values: FloatArray, flank: float, bristles: float, power: float) -> FloatArray:
    """Return where the nut is, (n,); all lengths are in half gaps."""
    out = np.empty_like(values)
    held = np.zeros(_BRISTLES)
    nut = values[0] - 1.0 - flank
    for i in range(_BRISTLES):
        held[i] = (i + 1.0) / _ALL_SHARES  # after a rise: all slip
    for k in range(len(values)):
        low, high = min(nut, values[k] - 1.0 - flank), max(nut, values[k] + 1.0 + flank)
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            deep = max(abs(values[k] - middle) - 1.0, 0.0)
            push = np.sign(values[k] - middle) * (deep / flank) ** power
            for i in range(_BRISTLES):
                push -= _drawn(held[i], middle - nut, i, bristles)
            if push > 0.0:
                low = middle
            else:
                high = middle
        # In the gap the guide alone says where the nut is; it stays where nothing pulls.
        there = 0.5 * (low + high)
        for i in range(_BRISTLES):
            held[i] = _drawn(held[i], there - nut, i, bristles)
        nut = out[k] = there
    return out


@numba.njit(cache=True, error_model="numpy")
def _drawn(held: float, way: float, i: int, bristles: float) -> float:
    """Return what bristle i holds with after a way: the longer it is, the stronger."""
    share = (i + 1.0) / _ALL_SHARES
    return float(min(max(held + share * way * _BRISTLES / (bristles * (i + 1.0)), -share), share))


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

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        # No stiffer than the fine step can follow.
        reach = max(length, 8.0 * size * run.step_s**2 / axis.mass)
        numbers = [size, size * other, static, shape, reach, 3e3, viscous]
        return row(code, axis, numbers)

    return Part("friction", axis, Stage.LOAD, act, (0.3, 300.0))


def contact(axis: Axis, rng: np.random.Generator) -> Part:
    """Hertz contact beyond a position near one end of the travel; size over the axis' stiffness."""
    side = rng.choice([-1.0, 1.0])
    inside = rng.uniform(0.08, 0.3)
    at = axis.start + (1.0 - inside if side > 0.0 else inside) * axis.travel
    power, damper = rng.choice([1.5, 1.5, 2.0]), rng.uniform(0.0, 0.5)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
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

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        stiff = size * axis.stiffness * length
        return row(mechanics.HARDENING, axis, [stiff, rest, length, law, sharp])

    return Part("stiffness_nonlinearity", axis, Stage.LOAD, act, (1e-3, 0.6))


def resonance_mismatch(axis: Axis, rng: np.random.Generator) -> Part:
    """Stiffness and damping off; size is the share by which the stiffness is."""
    sign = rng.choice([-1.0, 1.0])
    damping = rng.uniform(-2.0, 2.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        scales = [1.0 + sign * size, float(np.exp(damping * size)), 0.0, 0.0, 0.0]
        return row(0, axis, scales)

    return Part("resonance_mismatch", axis, Stage.STRUCTURE, act, (0.01, 0.35))


def flexible_mode(axis: Axis, rng: np.random.Generator) -> Part:
    """One or two appendages on springs; size is the mass of the first over the axis'."""
    own = np.sqrt(axis.stiffness / axis.mass) / (2.0 * np.pi)
    number = rng.choice([1, 1, 2])
    frequencies = own * rng.choice([rng.uniform(0.3, 0.75), rng.uniform(1.4, 2.2)], number)
    damping = rng.uniform(0.005, 0.05)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        rows = [row(1, axis, [size / (1 + i), f, damping]) for i, f in enumerate(frequencies)]
        return np.array(rows)

    return Part("flexible_mode", axis, Stage.STRUCTURE, act, (2e-3, 0.3))
