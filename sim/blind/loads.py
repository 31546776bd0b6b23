"""Forces that the model lacks (backlash, friction, contact, hardening) and structural errors.

Each function draws the shape of an effect at random. Its docstring says what the size measures.
"""

from collections.abc import Sequence

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun

_BRISTLE_COUNT = 6
# Bristle i carries i + 1 shares of the friction, so that all bristles carry 1 + 2 + … + 6.
_SUM_OF_SHARES = 21.0
_BISECTION_COUNT = 45


def make_load_row(code: int, axis: BlindAxis, numbers: Sequence[float]) -> FloatArray:
    """Return a row of a load table."""
    out = np.zeros(mechanics.LOAD_ROW_LENGTH)
    out[0], out[1] = code, axis.index
    out[2 : 2 + len(numbers)] = numbers
    return out


def draw_backlash(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a dead band in the drive train, between the drive and the axis' springs.

    The size is its width, m. A massless nut sits between two flanks, on a guide with dry friction.
    It rests where the force of a flank equals the friction. The force of a flank is ``(δ / bh)ⁿ``
    at an indentation δ ≤ bh, in units of the maximum friction. The friction is that of bristles
    that slip one after another over a length gh. Here h is half the gap. While a flank drags the
    nut, the nut lags by half the width, h + bh. Inside the gap, nothing moves it.
    """
    flank_depth = np.exp(rng.uniform(np.log(0.03), np.log(0.4)))
    slip_length = np.exp(rng.uniform(np.log(0.03), np.log(0.4)))
    exponent = rng.uniform(1.0, 2.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        half_gap = 0.5 * size / (1.0 + flank_depth)
        return np.asarray(
            half_gap * _compute_nut_positions(values / half_gap, flank_depth, slip_length, exponent)
        )

    return EffectPart("backlash", axis, SignalStage.ACTUATOR, act, (1e-7, 3e-5))


@numba.njit(cache=True, error_model="numpy")
def _compute_nut_positions(
    values: FloatArray, flank_depth: float, slip_length: float, exponent: float
) -> FloatArray:
    """Return the positions (n,) of the nut; all lengths are in units of half the gap."""
    out = np.empty_like(values)
    forces = np.zeros(_BRISTLE_COUNT)
    nut = values[0] - 1.0 - flank_depth
    for i in range(_BRISTLE_COUNT):
        # The run begins after a rise, in which all bristles slip.
        forces[i] = (i + 1.0) / _SUM_OF_SHARES
    for k in range(len(values)):
        low, high = min(nut, values[k] - 1.0 - flank_depth), max(nut, values[k] + 1.0 + flank_depth)
        for _ in range(_BISECTION_COUNT):
            middle = 0.5 * (low + high)
            indentation = max(abs(values[k] - middle) - 1.0, 0.0)
            push = np.sign(values[k] - middle) * (indentation / flank_depth) ** exponent
            for i in range(_BRISTLE_COUNT):
                push -= _move_bristle(forces[i], middle - nut, i, slip_length)
            if push > 0.0:
                low = middle
            else:
                high = middle
        # Inside the gap only the guide acts, so the nut stays where nothing pulls it.
        position = 0.5 * (low + high)
        for i in range(_BRISTLE_COUNT):
            forces[i] = _move_bristle(forces[i], position - nut, i, slip_length)
        nut = out[k] = position
    return out


@numba.njit(cache=True, error_model="numpy")
def _move_bristle(force: float, displacement: float, i: int, slip_length: float) -> float:
    """Return the force of bristle i after a displacement of the nut.

    Bristles that slip later carry more force.
    """
    share = (i + 1.0) / _SUM_OF_SHARES
    return float(
        min(
            max(force + share * displacement * _BRISTLE_COUNT / (slip_length * (i + 1.0)), -share),
            share,
        )
    )


def draw_friction(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw friction that follows Maxwell slip, Dahl's model or an elastoplastic bristle.

    The size is the Coulomb force, N.
    """
    code = (mechanics.SLIP, mechanics.SLIP, mechanics.DAHL, mechanics.ELASTOPLASTIC)[
        rng.integers(4)
    ]
    reverse_ratio = rng.uniform(0.85, 1.15)
    static_ratio = rng.uniform(1.05, 1.5)
    shape_by_code = {
        mechanics.SLIP: 10.0 ** rng.uniform(-4, -3),
        mechanics.DAHL: rng.uniform(0.6, 1.6),
    }
    min_presliding_length = 10.0 ** rng.uniform(-6.7, -5.3)
    viscous = rng.uniform(0.0, 0.1) * axis.damping
    shape = shape_by_code.get(code, rng.uniform(0.4, 0.8))

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        # A shorter presliding length would be too stiff for the fine step.
        presliding_length = max(min_presliding_length, 8.0 * size * run.step_s**2 / axis.mass)
        numbers = [size, size * reverse_ratio, static_ratio, shape, presliding_length, 3e3, viscous]
        return make_load_row(code, axis, numbers)

    return EffectPart("friction", axis, SignalStage.LOAD, act, (0.3, 300.0))


def draw_contact(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a Hertz contact beyond a position near one end of the travel.

    The size is the ratio of the contact stiffness to the stiffness of the axis.
    """
    direction = rng.choice([-1.0, 1.0])
    distance_from_end = rng.uniform(0.08, 0.3)
    contact_position = (
        axis.start
        + (1.0 - distance_from_end if direction > 0.0 else distance_from_end) * axis.travel
    )
    exponent, damping_ratio = rng.choice([1.5, 1.5, 2.0]), rng.uniform(0.0, 0.5)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        length_scale = 0.2 * axis.travel
        contact_stiffness = size * axis.stiffness * length_scale ** (1.0 - exponent)
        return make_load_row(
            mechanics.CONTACT,
            axis,
            [
                contact_position,
                contact_stiffness,
                damping_ratio / length_scale * 1e-3,
                direction,
                exponent,
            ],
        )

    return EffectPart("contact", axis, SignalStage.LOAD, act, (1e-4, 4.0))


def draw_stiffness_nonlinearity(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a hardening flexure by a sinh, power or tangent law.

    The size is the ratio of the added stiffness to the stiffness of the axis.
    """
    law = float(rng.integers(3))
    sharpness = rng.uniform(1.5, 3.0)
    rest_position = axis.low + axis.span * rng.choice([0.0, 0.5, rng.uniform(0.3, 0.7)])
    # With this length the tangent stays away from its pole everywhere in the range. Near the pole
    # the law is clipped, and the spring would not harden any further.
    length = 1.2 * max(rest_position - axis.low, axis.low + axis.span - rest_position)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        added_stiffness = size * axis.stiffness * length
        return make_load_row(
            mechanics.HARDENING, axis, [added_stiffness, rest_position, length, law, sharpness]
        )

    return EffectPart("stiffness_nonlinearity", axis, SignalStage.LOAD, act, (1e-3, 0.6))


def draw_resonance_mismatch(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a deviation of stiffness and damping.

    The size is the relative error of the stiffness.
    """
    sign = rng.choice([-1.0, 1.0])
    damping_exponent = rng.uniform(-2.0, 2.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        scales = [1.0 + sign * size, float(np.exp(damping_exponent * size)), 0.0, 0.0, 0.0]
        return make_load_row(0, axis, scales)

    return EffectPart("resonance_mismatch", axis, SignalStage.STRUCTURE, act, (0.01, 0.35))


def draw_flexible_mode(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw one or two appendages on springs.

    The size is the ratio of the mass of the first appendage to the mass of the axis.
    """
    natural_hz = np.sqrt(axis.stiffness / axis.mass) / (2.0 * np.pi)
    count = rng.choice([1, 1, 2])
    frequencies_hz = natural_hz * rng.choice([rng.uniform(0.3, 0.75), rng.uniform(1.4, 2.2)], count)
    damping_ratio = rng.uniform(0.005, 0.05)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        rows = [
            make_load_row(1, axis, [size / (1 + i), frequency_hz, damping_ratio])
            for i, frequency_hz in enumerate(frequencies_hz)
        ]
        return np.array(rows)

    return EffectPart("flexible_mode", axis, SignalStage.STRUCTURE, act, (2e-3, 0.3))
