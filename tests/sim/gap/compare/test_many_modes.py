"""A machine that rings in many modes, some of them driven by another axis."""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from rotemina.sim.effects.modes import MODES
from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.compare.many_modes import many_modes
from rotemina.sim.gap.diagnosis import Verdict
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("fsm")
PERIOD, RATE_HZ = 2048, 6400.0


def commands(seed):
    """Multisines of random phase to 3 kHz on all axes, two periods."""
    rng = np.random.default_rng(seed)
    signals = {}
    for name in ROBOT.axes:
        spectrum = np.zeros(PERIOD // 2 + 1, complex)
        lines = np.arange(1, int(3000 / RATE_HZ * PERIOD))
        spectrum[lines] = np.exp(2j * np.pi * rng.random(len(lines)))
        period = np.fft.irfft(spectrum)
        signals[name, Tap.CMD] = np.tile(5e-7 / period.std() * period, 2)
    metadata = {"history": "periodic", "period_samples": str(PERIOD)}
    units = dict.fromkeys(ROBOT.axes, "m")
    return Record.from_signals(np.arange(2 * PERIOD) / RATE_HZ, signals, units, metadata)


def modes(effect, seed, from_axis=None):
    """Seven lightly damped modes."""
    rng = np.random.default_rng(seed)
    numbers = {f"share_{n + 1}": 0.0 for n in range(MODES)}
    for n, frequency in enumerate((450.0, 640.0, 820.0, 1310.0, 1690.0, 2130.0, 2550.0)):
        numbers[f"frequency_{n + 1}"] = frequency
        numbers[f"damping_ratio_{n + 1}"] = 0.01
        numbers[f"share_{n + 1}"], numbers[f"speed_share_{n + 1}"] = rng.normal(0.0, 0.2, 2)
    return AxisEffect(
        axis="m1", id=effect, formulation="modes", from_axis=from_axis, parameters=numbers
    )


def recorded(effects, count=3):
    rng = np.random.default_rng(5)
    records = []
    for seed in range(count):
        clean = simulate(ROBOT, effects, commands(seed), rng)
        signals = {(name, Tap.CMD): clean.signal(name, Tap.CMD) for name in ROBOT.axes}
        for name in ROBOT.axes:
            reading = clean.signal(name, Tap.MEAS)
            signals[name, Tap.MEAS] = reading + 1e-9 * rng.standard_normal(len(reading))
        units = dict.fromkeys(ROBOT.axes, "m")
        records.append(Record.from_signals(clean.time_s, signals, units, clean.metadata))
    return records


def named(diagnosis):
    return {(cause.axis, cause.effect, cause.from_axis) for cause in diagnosis.causes}


def modes_of(effects, count=3):
    with threadpool_limits(limits=1):  # as in a diagnosis
        return many_modes(Evidence.of(ROBOT, "m1", recorded(effects, count)), Account("m1"))


def test_modes_are_named_with_the_axes_that_drive_them():
    truth = [modes("flexible_mode", 1), modes("cross_coupling", 2, "m2")]
    found = diagnose(ROBOT, recorded(truth))
    assert found.verdict is Verdict.EXPLAINED
    assert named(found) == {("m1", "flexible_mode", None), ("m1", "cross_coupling", "m2")}
    assert all(cause.closed > 0.99 for cause in found.causes)
    (shrunk,) = found.axes["m1"].shrinkage
    assert shrunk.corrected < 1.3 * shrunk.floor


def test_a_single_record_names_them_too():
    found = modes_of([modes("flexible_mode", 1)], count=1)
    assert found is not None
    assert found.ids == (("flexible_mode", None),)
    frequencies = [found.causes[0].parameters[f"frequency_{n + 1}"] for n in range(MODES)]
    assert min(abs(np.array(frequencies) - 1690.0)) < 2.0


@pytest.mark.parametrize(
    "truth",
    [
        AxisEffect(axis="m1", id="flexible_mode", parameters={"frequency": 1700.0, "share": 0.3}),
        AxisEffect(axis="m1", id="resonance_mismatch", parameters={"frequency_error": 0.05}),
        AxisEffect(axis="m1", id="hysteresis", parameters={"width": 1e-6}),
        AxisEffect(axis="m1", id="delay", parameters={"delay": 3e-4}),
        AxisEffect(axis="m1", id="cross_coupling", from_axis="m3", parameters={"k": 0.3}),
    ],
    ids=lambda effect: effect.id,
)
def test_what_a_few_causes_explain_is_left_to_them(truth):
    assert modes_of([truth]) is None
