"""The dry run: figures of known motions and the tracking error that the model predicts."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.quantities import exact
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory import prediction
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError
from rotemina.sim.trajectory.dry_run import dry_run
from rotemina.sim.trajectory.trajectory_excesses import Quantity

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
    run = dry_run(free_mass(limit=1e308), slow, setpoint_period_s=0.05)
    assert run.axes["q"].tracking_rms is None
    assert "grows" in run.prediction_fault
    assert not run.allowed
    assert [violation.quantity for violation in run.violations] == [Quantity.MOTION]
    assert "cannot predict" in run.objections[-1]


def test_an_absurd_but_finite_response_has_figures():
    slow = sine("q", 0.1, 0.02, 0.5, "m", duration_s=100.0, rate_hz=20.0)
    run = dry_run(free_mass(limit=1e250), slow, setpoint_period_s=0.05)
    figures = run.axes["q"]
    assert 1e200 < figures.tracking_rms < figures.tracking_peak
    assert not run.allowed


def steps(axis, positions, interval_s, unit="m"):
    time_s = np.arange(len(positions)) * interval_s
    return Record.from_signals(time_s, {(axis, Tap.CMD): np.array(positions)}, {axis: unit})


def test_rows_far_apart_do_not_slow_a_loop_down():
    """Half a second between rows: a loop closed there would shake the axis out of its range."""
    emps = load_robot("emps")
    gentle = steps("q", [0.05, 0.06, 0.07, 0.06, 0.06, 0.06, 0.06, 0.06], 0.5)
    run = dry_run(emps, gentle)
    assert run.allowed
    assert run.axes["q"].tracking_peak == pytest.approx(0.01, rel=1e-2)
    assert not dry_run(emps, gentle, setpoint_period_s=0.5).allowed


@pytest.mark.parametrize(
    ("top", "allowed"), [(4.9e-6, False), (4.0e-6, False), (2.4e-6, True)], ids=str
)
@pytest.mark.parametrize("back", [[], [0.0]], ids=["last", "back"])
def test_a_motion_that_swings_out_of_the_range_is_refused(top, allowed, back):
    """The mirror has no declared bounds; a jump of h rings up to almost 2h, between the rows."""
    run = dry_run(load_robot("fsm"), steps("m1", [0.0, top, *back], 0.001))
    assert run.allowed is allowed
    if not allowed:
        (violation,) = run.violations
        assert violation.quantity is Quantity.MOTION
        assert violation.value == pytest.approx(top * (1 + np.exp(-np.pi * 0.02)), rel=0.02)
        for word in ("axis m1: predicted motion", "5 µm", "100 nm (1 % of the range)"):
            assert word in str(violation)
        with pytest.raises(OutOfLimitsError, match="predicted motion"):
            run.require()


def test_a_long_trajectory_is_predicted_piece_by_piece_as_a_whole(monkeypatch):
    trajectory = sine("q", 0.1, 0.02, 0.5, "m")
    whole = dry_run(load_robot("emps"), trajectory).axes["q"]
    monkeypatch.setattr(prediction, "_CHUNK", 77)
    pieces = dry_run(load_robot("emps"), trajectory).axes["q"]
    assert pieces.tracking_peak == pytest.approx(whole.tracking_peak, rel=1e-12)
    assert pieces.tracking_rms == pytest.approx(whole.tracking_rms, rel=1e-12)


def test_what_is_allowed_is_sealed():
    time_s, command = np.arange(4.0), np.full(4, 0.01)
    measured = Record.from_signals(
        time_s,
        {("x", Tap.CMD): command, ("x", Tap.MEAS): np.zeros(4)},
        {"x": "m"},
        {"history": "unknown", "mode": "open_loop", "name": "rest"},
    )
    checked = dry_run(ROBOT, measured).require()
    assert [str(channel) for channel in checked.commands.columns] == ["x.cmd"]
    assert checked.commands.metadata["name"] == "rest"
    assert checked.robot is ROBOT
    time_s[1] = 1.5
    np.testing.assert_array_equal(checked.commands.time_s, np.arange(4.0))


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
    assert exact(value, unit) == text
