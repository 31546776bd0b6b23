"""Actuators of the generator: gain, curve, hysteresis, creep, lost steps and microsteps."""

from math import pi

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.curves import Curve, draw_curve
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage
from rotemina.sim.blind.preisach import draw_plane, run_plane


def gain_error(axis: Axis, rng: np.random.Generator) -> Part:
    """Sensitivity off by a share; size is the share."""
    sign = rng.choice([-1.0, 1.0])

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return np.asarray(values * (1.0 + sign * size))

    return Part("gain_error", axis, Stage.ACTUATOR, act, (1e-5, 0.1))


def static_nonlinearity(axis: Axis, rng: np.random.Generator) -> Part:
    """Bowed characteristic; size in m or rad."""
    return _added("static_nonlinearity", axis, draw_curve(axis, rng), (axis.floor, 0.1 * axis.span))


def _added(effect: str, axis: Axis, curve: Curve, sizes: tuple[float, float]) -> Part:
    """Return a part that adds a curve over position, as often as its size says."""

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return values + size * curve(values)

    return Part(effect, axis, Stage.ACTUATOR, act, sizes)


def hysteresis(axis: Axis, rng: np.random.Generator) -> Part:
    """Hysteresis of a Preisach plane or of Maxwell slip elements; size is the loop's share."""
    return _preisach(axis, rng) if rng.uniform() < 0.6 else _maxwell_slip(axis, rng)


def _preisach(axis: Axis, rng: np.random.Generator) -> Part:
    everett = draw_plane(rng)
    # The nominal gain is that of a wide loop in the middle of the range.
    ramp = np.concatenate([[0.0], np.linspace(0.15, 0.85, 400), np.linspace(0.85, 0.15, 400)])
    loop = run_plane(everett, np.concatenate([ramp, ramp[1:401]]))[401:]
    slope, rest = np.polyfit(np.concatenate([ramp[401:], ramp[1:401]]), loop, 1)
    width = float(np.max(loop[:400][::-1] - loop[400:]))

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        inputs = (values - axis.low) / axis.span
        bent = run_plane(everett, inputs) - (slope * inputs + rest)
        return np.asarray(values + axis.span * size / width * bent)

    return Part("hysteresis", axis, Stage.ACTUATOR, act, (0.002, 0.15))


def _maxwell_slip(axis: Axis, rng: np.random.Generator) -> Part:
    """Springs that slip one after the other, their strengths spread continuously."""
    strengths = np.sort(rng.uniform(0.003, 0.6, 40) ** rng.uniform(1.0, 2.0))
    stiffness = rng.gamma(2.0, 1.0, 40)
    stiffness /= np.sum(stiffness * strengths)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        inputs = (values - axis.low) / axis.span
        pull = _slipping(inputs, strengths, stiffness)
        return np.asarray(values - 0.5 * axis.span * size * pull)

    return Part("hysteresis", axis, Stage.ACTUATOR, act, (0.002, 0.15))


@numba.njit(cache=True, error_model="numpy")
def _slipping(inputs: FloatArray, strengths: FloatArray, stiffness: FloatArray) -> FloatArray:
    stretch = np.zeros_like(strengths)
    out = np.empty_like(inputs)
    last, force = 0.0, 0.0
    for k in range(len(inputs)):
        move = inputs[k] - last
        last = inputs[k]
        if move != 0.0:
            force = 0.0
            for i in range(len(strengths)):
                stretch[i] = min(max(stretch[i] + move, -strengths[i]), strengths[i])
                force += stiffness[i] * stretch[i]
        out[k] = force
    return out


def creep(axis: Axis, rng: np.random.Generator) -> Part:
    """Creep of a Kelvin–Voigt chain spread over decades of time; size is the share per decade."""
    times = np.geomspace(rng.uniform(0.03, 0.1), rng.uniform(60.0, 300.0), 9)
    per_decade = 8.0 / np.log10(times[-1] / times[0])
    weights = rng.uniform(0.75, 1.25, 9) / per_decade

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return values + size * _crept(values, weights, run.step_s / times, run.lead)

    return Part("creep", axis, Stage.ACTUATOR, act, (0.001, 0.05))


@numba.njit(cache=True, error_model="numpy")
def _crept(values: FloatArray, weights: FloatArray, rates: FloatArray, lead: int) -> FloatArray:
    """Strain of elements that had settled by the end of the lead, and count from there."""
    start = values[lead]
    strain = np.zeros_like(weights)
    kept = np.exp(-rates)
    out = np.zeros_like(values)
    for k in range(lead, len(values)):
        total = 0.0
        for i in range(len(weights)):
            goal = weights[i] * (values[k] - start)
            strain[i] = goal + (strain[i] - goal) * kept[i]
            total += strain[i]
        out[k] = total
    return out


def lost_steps(axis: Axis, rng: np.random.Generator) -> Part:
    """Four full steps, or a multiple, lost at the highest load; size counts the events."""
    seed = int(rng.integers(2**31))

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        draw = run.chance(seed)
        out = values.copy()
        for at in _busiest(values, run, round(size), draw):
            way = np.sign(values[min(at + 20 * run.every, len(values) - 1)] - values[at])
            out[at:] -= way * 4.0 * axis.full_step * draw.choice([1.0, 1.0, 1.0, 2.0])
        return out

    return Part("lost_steps", axis, Stage.ACTUATOR, act, (1.0, 4.0))


def _busiest(
    values: FloatArray, run: SimulationRun, number: int, draw: np.random.Generator
) -> list[int]:
    """Return up to ``number`` fine steps, in different parts of the run, of the highest load."""
    width = 20 * run.every
    load = np.abs(values[2 * width :] - 2.0 * values[width:-width] + values[: -2 * width])
    load[: run.lead + width] = 0.0
    parts = np.array_split(np.arange(len(load)), 8)
    heaviest = [load[part].max() for part in parts]
    busy = [k for k in draw.permutation(8) if heaviest[k] >= 0.7 * max(heaviest)]
    # The first step that comes near the peak, so that a small change elsewhere moves it little.
    near = [parts[k][np.argmax(load[parts[k]] >= 0.9 * heaviest[k])] for k in busy[:number]]
    return [int(at) + width for at in near]


def _periodic(period: float, rng: np.random.Generator, harmonics: int, wander: float) -> Curve:
    """Draw a wave over position, of rms 0.7; its phase wanders slowly along the axis."""
    orders = np.arange(1, harmonics + 1)
    shares = rng.uniform(0.0, 0.5, harmonics) / orders
    shares[0] = 1.0
    shares /= np.sqrt(np.sum(shares**2))
    phases = rng.uniform(0.0, 2.0 * pi, harmonics)
    wander, length = wander * rng.uniform(0.3, 1.0), rng.uniform(6.0, 20.0) * period

    def wave(position: FloatArray) -> FloatArray:
        turn = 2.0 * pi * position / period
        turn = turn + wander * np.sin(2.0 * pi * position / length)
        out = np.zeros_like(position)
        for order, share, phase in zip(orders, shares, phases, strict=True):
            out += share * np.sin(order * turn + phase)
        return out

    return wave


def microstep_error(axis: Axis, rng: np.random.Generator) -> Part:
    """Error with a period of four full steps; size is its amplitude, m."""
    wave = _periodic(4.0 * axis.full_step, rng, 4, 0.0)
    return _added("microstep_error", axis, wave, (5e-8, 3e-6))


def leadscrew_error(axis: Axis, rng: np.random.Generator) -> Part:
    """Error with a period of one pitch or a fraction, phase slowly modulated; size in m."""
    wave = _periodic(axis.pitch / rng.choice([1.0, 1.0, 1.0, 2.0]), rng, 3, 0.3)
    return _added("leadscrew_error", axis, wave, (5e-8, 2e-5))
