"""Only bad input ends a diagnosis: unusual records get a verdict, or are refused.

To save time, each test searches only a random selection of the effects.

``ODD_RECORDS=500`` sets the number of tests, which is 16 by default.
"""

import os

import numpy as np
import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare import effect_candidates as candidates
from rotemina.sim.gap.fit import catalogue
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.gap.result import GapVerdict
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
_EFFECT_COUNT = 8
COUNT = int(os.environ.get("ODD_RECORDS", "16"))


def make_times(rng):
    """Return times (n,) of a record: few rows, any rate, even or uneven, sometimes with a gap."""
    rows = int(rng.choice([99, 100, 130, 240], p=[0.05, 0.35, 0.3, 0.3]))
    step_s = float(rng.choice([1e-5, 1e-3, 2e-2, 3.0], p=[0.2, 0.4, 0.3, 0.1]))
    steps = np.full(rows, step_s)
    if rng.random() < 0.3:
        steps *= rng.uniform(0.2, 1.8, rows)
    if rng.random() < 0.05:
        steps[rows // 2] *= 40.0
    return np.cumsum(steps) - steps[0]


def make_path(rng, rows):
    """Return a path (n,) within -1 and 1: constant, step, ramp, wave, noise or staircase."""
    phase = np.linspace(0.0, 1.0, rows)
    return {
        0: lambda: np.zeros(rows),
        1: lambda: np.where(phase < 0.5, -0.5, 0.5),
        2: lambda: 2.0 * phase - 1.0,
        3: lambda: 0.8 * np.sin(2.0 * np.pi * rng.uniform(0.5, 20.0) * phase),
        4: lambda: rng.uniform(-1.0, 1.0, rows),
        5: lambda: np.rint(3.0 * np.sin(7.0 * phase)) / 3.0,
    }[int(rng.integers(6))]()


def make_faulty_reading(rng, command, span):
    """Return the reading (n,) of a motion by a faulty sensor."""
    reading = (1.0 + 0.1 * rng.standard_normal()) * command
    fault = int(rng.integers(9))
    if fault == 0:
        reading = np.full(len(command), reading[0])  # Stuck.
    elif fault == 1:
        reading = reading + 1e3 * span  # Huge offset.
    elif fault == 2:
        reading = command.copy()  # Exactly the command.
    elif fault == 3:
        reading = np.rint(reading / (0.3 * span)) * 0.3 * span  # Very coarse steps.
    elif fault == 4:
        reading = reading + 1e6 * span * rng.standard_normal(len(command))
    elif fault == 5:
        reading[5:] = reading[:-5].copy()
    elif fault == 6:
        reading[len(reading) // 2 :] = reading[len(reading) // 2]  # One row repeated.
    elif fault == 7:
        reading = -reading + 1e-12 * rng.standard_normal(len(command))
    else:
        reading[:: int(rng.integers(2, 30))] = 0.0  # Dropouts.
    return reading


def make_unusual_record(rng, axes):
    time_s = make_times(rng)
    signals, units, common_path = {}, {}, make_path(rng, len(time_s))
    for axis in axes:
        description = ROBOT.axes[axis]
        # Sometimes both axes move alike.
        path = common_path if rng.random() < 0.3 else make_path(rng, len(time_s))
        fastest = 2.0 * (description.max_speed or np.inf) * float(np.diff(time_s).min())
        command = sum(description.range) / 2 + min(0.3 * description.span, fastest) * path
        signals[axis, Tap.CMD], units[axis] = command, description.unit
        for tap in (Tap.MEAS, Tap.REF) if rng.random() < 0.3 else (Tap.MEAS,):
            signals[axis, tap] = make_faulty_reading(rng, command, description.span)
    return Record.from_signals(time_s, signals, units)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(COUNT))
def test_an_unusual_record_gets_a_verdict_or_is_refused(seed, monkeypatch):
    rng = np.random.default_rng(seed)
    axes = [("x",), ("zn",), ("x", "y"), ("thx",)][seed % 4]
    installed = catalogue()
    selection = [
        installed[k] for k in sorted(rng.choice(len(installed), _EFFECT_COUNT, replace=False))
    ]
    monkeypatch.setattr(candidates, "catalogue", lambda: selection)
    try:
        records = [make_unusual_record(rng, axes) for _ in range(int(rng.integers(1, 3)))]
        diagnosis = diagnose(ROBOT, records)
    except InputError:
        # The command line shows the reason, and exits with status 2.
        return
    assert diagnosis.verdict in GapVerdict
    assert set(diagnosis.axes) <= set(axes)
