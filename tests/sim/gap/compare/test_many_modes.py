"""A machine that oscillates in many modes, some of them excited by another axis."""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from rotemina.sim.effects import MODE_COUNT
from rotemina.sim.gap.compare import many_modes
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.gap.result import Account, GapVerdict
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("fsm")
PERIOD, RATE_HZ = 2048, 6400.0


def make_commands(seed):
    """Return two periods of multisines of random phase up to 3 kHz on all axes."""
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


def make_modes(effect, seed, from_axis=None):
    """Return an effect with seven lightly damped modes."""
    rng = np.random.default_rng(seed)
    parameters = {f"share_{n + 1}": 0.0 for n in range(MODE_COUNT)}
    for n, frequency in enumerate((450.0, 640.0, 820.0, 1310.0, 1690.0, 2130.0, 2550.0)):
        parameters[f"frequency_{n + 1}"] = frequency
        parameters[f"damping_ratio_{n + 1}"] = 0.01
        parameters[f"share_{n + 1}"], parameters[f"speed_share_{n + 1}"] = rng.normal(0.0, 0.2, 2)
    return AxisEffect(
        axis="m1", id=effect, formulation="modes", from_axis=from_axis, parameters=parameters
    )


def simulate_records(effects, count=3):
    rng = np.random.default_rng(5)
    records = []
    for seed in range(count):
        noiseless = simulate(ROBOT, effects, make_commands(seed), rng)
        signals = {(name, Tap.CMD): noiseless.signal(name, Tap.CMD) for name in ROBOT.axes}
        for name in ROBOT.axes:
            reading = noiseless.signal(name, Tap.MEAS)
            signals[name, Tap.MEAS] = reading + 1e-9 * rng.standard_normal(len(reading))
        units = dict.fromkeys(ROBOT.axes, "m")
        records.append(Record.from_signals(noiseless.time_s, signals, units, noiseless.metadata))
    return records


def get_causes(diagnosis):
    return {(cause.axis, cause.effect, cause.from_axis) for cause in diagnosis.causes}


def find_many_modes(effects, count=3):
    # As in a diagnosis.
    with threadpool_limits(limits=1):
        return many_modes(Evidence.of(ROBOT, "m1", simulate_records(effects, count)), Account("m1"))


def test_modes_are_named_with_the_axes_that_drive_them():
    truth = [make_modes("flexible_mode", 1), make_modes("cross_coupling", 2, "m2")]
    diagnosis = diagnose(ROBOT, simulate_records(truth))
    assert diagnosis.verdict is GapVerdict.EXPLAINED
    assert get_causes(diagnosis) == {("m1", "flexible_mode", None), ("m1", "cross_coupling", "m2")}
    assert all(cause.closed > 0.99 for cause in diagnosis.causes)
    (shrinkage,) = diagnosis.axes["m1"].shrinkage
    assert shrinkage.corrected < 1.3 * shrinkage.floor


def test_a_single_record_is_enough_to_name_modes():
    explanation = find_many_modes([make_modes("flexible_mode", 1)], count=1)
    assert explanation is not None
    assert explanation.ids == (("flexible_mode", None),)
    frequencies = [
        explanation.causes[0].parameters[f"frequency_{n + 1}"] for n in range(MODE_COUNT)
    ]
    assert min(abs(np.array(frequencies) - 1690.0)) < 2.0


@pytest.mark.parametrize(
    "truth",
    [
        AxisEffect(axis="m1", id="flexible_mode", parameters={"frequency": 1700.0, "share": 0.3}),
        AxisEffect(axis="m1", id="hysteresis", parameters={"width": 1e-6}),
        AxisEffect(axis="m1", id="cross_coupling", from_axis="m3", parameters={"k": 0.3}),
    ],
    ids=lambda effect: effect.id,
)
def test_a_gap_that_few_causes_explain_is_not_fitted_with_many_modes(truth):
    assert find_many_modes([truth]) is None
