"""On an axis that is held, only effects that time or another axis excites are candidates."""

import numpy as np
import pytest

from rotemina.sim.gap.compare import candidates
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import parse_robot
from rotemina.sim.simulation import simulate

ROBOT = parse_robot("""[robot]
name = "A probe"
axes = ["z"]

[axis.z]
kind = "stepper"
range = [-0.001, 0.001]
static = true
sensor.kind = "probe"
sensor.noise_rms = 1.0e-7
""")
WARM_UP = AxisEffect(
    axis="z",
    id="thermal_drift",
    formulation="two_bodies",
    parameters={
        "amplitude": 6e-5,
        "time_constant": 60.0,
        "amplitude_2": -4e-5,
        "time_constant_2": 500.0,
    },
)


def record_held_axis(seed, *effects, metadata=None):
    time_s = 2.0 * np.arange(400)
    signals = {("z", Tap.CMD): np.zeros(len(time_s))}
    commands = Record.from_signals(time_s, signals, {"z": "m"}, metadata or {})
    return simulate(ROBOT, effects, commands, np.random.default_rng(seed))


def list_candidates(record):
    return {effect.id for effect in candidates(Evidence.of(ROBOT, "z", [record]))}


def test_a_held_axis_shows_drift_and_vibration_but_no_mode_and_no_lost_motion():
    held = list_candidates(record_held_axis(0, metadata={"history": "unknown"}))
    assert held == {"thermal_drift", "vibration"}


def test_a_moving_axis_does_not_show_the_drift_of_two_bodies():
    time_s = 0.1 * np.arange(400)
    signals = {("z", Tap.CMD): 1e-4 * np.sin(time_s)}
    record = simulate(ROBOT, (), Record.from_signals(time_s, signals, {"z": "m"}))
    drifts = {
        effect.formulation
        for effect in candidates(Evidence.of(ROBOT, "z", [record]))
        if effect.id == "thermal_drift"
    }
    assert drifts == {"warm_up"}


@pytest.mark.slow
def test_drift_of_a_held_axis_with_unknown_history_is_no_mode():
    record = record_held_axis(1, WARM_UP, metadata={"history": "unknown"})
    diagnosis = diagnose(ROBOT, [record])
    assert [cause.effect for cause in diagnosis.causes] == ["thermal_drift"]
    assert diagnosis.causes[0].closed > 0.95
