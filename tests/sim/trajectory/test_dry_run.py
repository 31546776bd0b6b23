"""The dry run: figures of known motions and the tracking error that the model predicts."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.dry_run import as_played, dry_run
from rotemina.sim.trajectory.limits import Quantity
from rotemina.sim.trajectory.wording import readable

ROBOT = load_robot("rotemina")


def sine(
    axis, centre, amplitude, frequency_hz, unit, *, duration_s=2.0, rate_hz=2000.0, **metadata
):
    time_s = 3.0 + np.arange(round(duration_s * rate_hz) + 1) / rate_hz
    phase = 2 * np.pi * frequency_hz * (time_s - 3.0)
    command = centre - amplitude * np.cos(phase)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit}, metadata)


def test_figures_of_a_sine_are_those_of_calculus():
    run = dry_run(ROBOT, sine("thx", 5e-4, 1e-4, 2.0, "rad"))
    figures = run.axes["thx"]
    rate = 2 * np.pi * 2.0
    assert run.allowed
    assert run.rows == 4001
    assert run.duration_s == pytest.approx(2.0)
    assert figures.unit == "rad"
    assert (figures.start, figures.lowest) == pytest.approx((4e-4, 4e-4))
    assert figures.highest == pytest.approx(6e-4)
    assert figures.peak_speed == pytest.approx(1e-4 * rate, rel=1e-3)
    assert figures.peak_acceleration == pytest.approx(1e-4 * rate**2, rel=1e-3)
    assert figures.bounds.max_speed == ROBOT.axes["thx"].max_speed


def test_the_tracking_error_of_a_slow_motion_is_its_delay():
    """Below resonance an axis lags by D/C, and the held command by one row more at its rows."""
    axis = ROBOT.axes["x"]
    run = dry_run(ROBOT, sine("x", 0.02, 1e-3, 0.5, "m"))
    rate = 2 * np.pi * 0.5
    lag_s = axis.damping / axis.stiffness + 0.5 / 2000.0
    assert run.axes["x"].tracking_peak == pytest.approx(1e-3 * rate * lag_s, rel=0.02)
    assert run.axes["x"].tracking_rms == pytest.approx(1e-3 * rate * lag_s / 2**0.5, rel=0.02)


def test_a_robot_under_control_is_predicted_under_control():
    run = dry_run(load_robot("emps"), sine("q", 0.1, 0.02, 0.5, "m", mode="open_loop"))
    assert run.allowed
    assert run.prediction_fault is None
    assert 0 < run.axes["q"].tracking_peak < 1e-3


def free_mass(limit):
    """An axis whose loop, sampled at 20 Hz, is unstable."""
    emps = load_robot("emps")
    axis = replace(emps.axes["q"], mass=1e-3, damping=0.0)
    return replace(
        emps, axes={"q": replace(axis, controller=replace(axis.controller, limit=limit))}
    )


def test_a_loop_sampled_too_slowly_has_no_prediction_but_a_reason():
    slow = sine("q", 0.1, 0.02, 0.5, "m", duration_s=100.0, rate_hz=20.0)
    run = dry_run(free_mass(limit=1e308), slow)
    assert run.axes["q"].tracking_rms is None
    assert "grows" in run.prediction_fault


def test_an_absurd_but_finite_response_has_figures():
    slow = sine("q", 0.1, 0.02, 0.5, "m", duration_s=100.0, rate_hz=20.0)
    figures = dry_run(free_mass(limit=1e250), slow).axes["q"]
    assert 1e200 < figures.tracking_rms < figures.tracking_peak


def test_only_commands_are_played_and_from_rest():
    measured = Record.from_signals(
        np.arange(3.0),
        {("x", Tap.CMD): np.full(3, 0.01), ("x", Tap.MEAS): np.zeros(3)},
        {"x": "m"},
        {"history": "unknown", "mode": "open_loop"},
    )
    played = as_played(ROBOT, measured)
    assert [str(channel) for channel in played.columns] == ["x.cmd"]
    assert played.history == "rest"


@pytest.mark.parametrize("example", range(1, 9))
def test_trajectories_of_the_examples_are_allowed(shared_dir, example):
    for file in sorted((shared_dir / "examples" / f"example_{example}").glob("train_*.csv.gz")):
        assert dry_run(ROBOT, read_record(file, robot=ROBOT)).violations == ()


def test_jumps_of_the_reference_are_refused_for_speed(shared_dir):
    run = dry_run(ROBOT, read_record(shared_dir / "reference" / "steps.csv", robot=ROBOT))
    fast = {v.axis: v for v in run.violations if v.quantity is Quantity.SPEED}
    assert set(fast) == set(ROBOT.axes)
    assert fast["x"].time_s == pytest.approx(0.1005)
    assert fast["x"].value == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (2e-5, "m", "20 µm"),
        (0.02, "m/s", "20 mm/s"),
        (-3e-8, "m", "-30 nm"),
        (2.0, "rad/s²", "2 rad/s²"),
        (5e-4, "rad", "500 µrad"),
        (0.0, "m", "0 m"),
        (130.0, "V", "130 V"),
    ],
)
def test_values_are_written_in_the_unit_a_person_would_choose(value, unit, text):
    assert readable(value, unit) == text
