"""Nothing ends a diagnosis but bad input: odd records end with a verdict, or are refused.

To be quick, each looks for some of the effects only, others each time.

``ODD_RECORDS=500`` tries so many instead of forty.
"""

import os

import numpy as np
import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare import candidates
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.fit.catalogue import catalogue
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
_SOUGHT = 8  # effects
COUNT = int(os.environ.get("ODD_RECORDS", "40"))


def times(rng):
    """Return the times (n,) of a record: few rows, at any rate, even or not, some with a hole."""
    rows = int(rng.choice([99, 100, 130, 240], p=[0.05, 0.35, 0.3, 0.3]))
    step_s = float(rng.choice([1e-5, 1e-3, 2e-2, 3.0], p=[0.2, 0.4, 0.3, 0.1]))
    steps = np.full(rows, step_s)
    if rng.random() < 0.3:
        steps *= rng.uniform(0.2, 1.8, rows)
    if rng.random() < 0.05:
        steps[rows // 2] *= 40.0
    return np.cumsum(steps) - steps[0]


def way(rng, rows):
    """Return a way (n,) within -1 and 1: constant, one step, monotone, a wave, noise, stairs."""
    turn = np.linspace(0.0, 1.0, rows)
    return {
        0: lambda: np.zeros(rows),
        1: lambda: np.where(turn < 0.5, -0.5, 0.5),
        2: lambda: 2.0 * turn - 1.0,
        3: lambda: 0.8 * np.sin(2.0 * np.pi * rng.uniform(0.5, 20.0) * turn),
        4: lambda: rng.uniform(-1.0, 1.0, rows),
        5: lambda: np.rint(3.0 * np.sin(7.0 * turn)) / 3.0,
    }[int(rng.integers(6))]()


def oddly_read(rng, command, span):
    """Return what a sensor that is out of order says (n,) of a motion."""
    reading = (1.0 + 0.1 * rng.standard_normal()) * command
    odd = int(rng.integers(9))
    if odd == 0:
        reading = np.full(len(command), reading[0])  # stands still
    elif odd == 1:
        reading = reading + 1e3 * span  # a huge offset
    elif odd == 2:
        reading = command.copy()  # to the last digit
    elif odd == 3:
        reading = np.rint(reading / (0.3 * span)) * 0.3 * span  # hardly any step
    elif odd == 4:
        reading = reading + 1e6 * span * rng.standard_normal(len(command))
    elif odd == 5:
        reading[5:] = reading[:-5].copy()
    elif odd == 6:
        reading[len(reading) // 2 :] = reading[len(reading) // 2]  # one row again and again
    elif odd == 7:
        reading = -reading + 1e-12 * rng.standard_normal(len(command))
    else:
        reading[:: int(rng.integers(2, 30))] = 0.0  # dropouts
    return reading


def odd_record(rng, axes):
    time_s = times(rng)
    signals, units, shared = {}, {}, way(rng, len(time_s))
    for axis in axes:
        own = ROBOT.axes[axis]
        moved = shared if rng.random() < 0.3 else way(rng, len(time_s))  # both axes alike
        fastest = 2.0 * (own.max_speed or np.inf) * float(np.diff(time_s).min())
        command = sum(own.range) / 2 + min(0.3 * own.span, fastest) * moved
        signals[axis, Tap.CMD], units[axis] = command, own.unit
        for tap in (Tap.MEAS, Tap.REF) if rng.random() < 0.3 else (Tap.MEAS,):
            signals[axis, tap] = oddly_read(rng, command, own.span)
    return Record.from_signals(time_s, signals, units)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(COUNT))
def test_an_odd_record_ends_with_a_verdict_or_is_refused(seed, monkeypatch):
    rng = np.random.default_rng(seed)
    axes = [("x",), ("zn",), ("x", "y"), ("thx",)][seed % 4]
    installed = catalogue()
    some = [installed[k] for k in sorted(rng.choice(len(installed), _SOUGHT, replace=False))]
    monkeypatch.setattr(candidates, "catalogue", lambda: some)
    try:
        records = [odd_record(rng, axes) for _ in range(int(rng.integers(1, 3)))]
        found = diagnose(ROBOT, records)
    except InputError:
        return  # the command line says why, and ends with 2
    assert found.verdict in Verdict
    assert set(found.axes) <= set(axes)
