"""The remainder of a record as an equivalent input: the additional input that would cause it.

Mechanics filter errors of electronics and actuators, and ring with them. Wiener's filter reverses
that as far as noise permits (Wiener, Extrapolation, Interpolation, and Smoothing of Stationary Time
Series (1949), ch. 3).
"""

from dataclasses import replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.effects import AxisProperties
from rotemina.sim.gap.fit.evidence import Evidence, Part, Signals
from rotemina.sim.gap.fit.output_error import Fit
from rotemina.sim.gap.fit.start_state import start
from rotemina.sim.plant import Plant, compute_motion, make_run
from rotemina.sim.records import Tap

_KICK = 1e-3  # of the range
_TAPER = 0.05  # of a record, at each end
_MOSTLY = 0.9  # of the rows, that count: where fewer do, what is between them is not known
_LEAST = 0.1  # floors squared, that what is left has above them


def inputs_left(evidence: Evidence, fitted: Fit) -> list[tuple[Part, FloatArray]]:
    """Return the remainder (n,) of each tap of open-loop records as an input, m or rad.

    At the amplifier the remainder already is an input.
    """
    seen = []
    kicked: dict[int, Signals] = {}
    gain = AxisProperties.of(evidence.robot.axes[evidence.axis]).gain
    for part in evidence.parts:
        observation = evidence.observations[part.record]
        if observation.record.closed_loop:
            continue
        left = _bridged(fitted.residual[part.rows], observation.kept.get(part.tap))
        floor = observation.floor[part.tap]
        if part.tap is Tap.U:
            seen.append((part, left * floor * gain))
            continue
        if part.record not in kicked:
            kicked[part.record] = _kicked(evidence, fitted, part.record)
        seen.append((part, _undone(left, kicked[part.record][part.tap] / floor, 1.0 / floor)))
    return seen


def _bridged(left: FloatArray, kept: BoolArray | None) -> FloatArray:
    """Return the remainder (n,), interpolated smoothly over single rows that do not count.

    Such rows are zeros in a residual: abrupt changes that only a burst of the input could explain.
    """
    if kept is None or kept.mean() < _MOSTLY or kept.all():
        return left
    rows = np.arange(len(left))
    inner = np.clip(rows[~kept], rows[kept][0], rows[kept][-1])
    bridged = left.copy()
    bridged[~kept] = PchipInterpolator(rows[kept], left[kept])(inner)
    return bridged


def _kicked(evidence: Evidence, fitted: Fit, number: int) -> Signals:
    """Return what each tap (n,) answers to an input of 1 that is held for one row."""
    observation = evidence.observations[number]
    robot = replace(evidence.robot, effects=(*evidence.robot.effects, *fitted.effects))
    plant = Plant.of(robot, only={evidence.axis})
    run = make_run(plant, observation.record)
    state = start(plant, observation.record, run)
    column = plant.axes.index(evidence.axis)
    facts = AxisProperties.of(evidence.robot.axes[evidence.axis])
    size = _KICK * facts.span
    command, inputs = run.command.copy(), run.inputs.copy()
    command[0, column] += size
    inputs[0, column] += size / (facts.gain if facts.kind == "piezo" else 1.0)
    calm = compute_motion(plant, state, run)
    moved = compute_motion(plant, state, run._replace(command=command, inputs=inputs))
    answers = {
        Tap.REF: moved.position - calm.position,
        Tap.MEAS: moved.reading - calm.reading,
    }
    return {tap: answer[:, column] / size for tap, answer in answers.items()}


def _undone(left: FloatArray, answer: FloatArray, per_size: float) -> FloatArray:
    """Return the input (n,) that causes ``left`` (n,), which contains noise of variance 1.

    ``answer`` (n,) is the answer to one row of input; ``per_size`` times an input is about its
    remainder.
    """
    rows = len(left)
    length = 2 * rows  # what rings on beyond the end must not come in at the beginning
    taper = _tapered(rows)
    ahead = np.fft.rfft(answer, length)
    variance = max(float(np.mean(left**2)) - 1.0, _LEAST) / per_size**2
    filtered = ahead.conj() / (np.abs(ahead) ** 2 + 1.0 / variance)
    return np.asarray(np.fft.irfft(np.fft.rfft(left * taper, length) * filtered, length)[:rows])


def _tapered(rows: int) -> FloatArray:
    taper = np.ones(rows)
    ends = max(int(_TAPER * rows), 1)
    rise = np.sin(np.linspace(0.0, np.pi / 2.0, ends)) ** 2
    taper[:ends], taper[-ends:] = rise, rise[::-1]
    return taper
