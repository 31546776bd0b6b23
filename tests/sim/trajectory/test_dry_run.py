"""The dry run: figures of known motions, and the tracking error predicted by the model."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import OutOfLimitsError
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import LimitedQuantity, dry_run, prediction

ROBOT = load_robot("rotemina")


def make_sine(
    axis, centre, amplitude, frequency_hz, unit, *, duration_s=2.0, rate_hz=2000.0, **metadata
):
    time_s = 3.0 + np.arange(round(duration_s * rate_hz) + 1) / rate_hz
    phase = 2 * np.pi * frequency_hz * (time_s - 3.0)
    command = centre - amplitude * np.cos(phase)
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit}, metadata)


def test_figures_of_a_sine_match_calculus():
    run = dry_run(ROBOT, make_sine("thx", 5e-4, 1e-4, 2.0, "rad"))
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
    """Below resonance an axis lags by D/C, and a held command by half a row more."""
    axis = ROBOT.axes["x"]
    run = dry_run(ROBOT, make_sine("x", 0.02, 1e-3, 0.5, "m"))
    rate = 2 * np.pi * 0.5
    lag_s = axis.damping / axis.stiffness + 0.5 / 2000.0
    assert run.axes["x"].tracking_peak == pytest.approx(1e-3 * rate * lag_s, rel=0.02)
    assert run.axes["x"].tracking_rms == pytest.approx(1e-3 * rate * lag_s / 2**0.5, rel=0.02)


def test_a_robot_with_controller_is_predicted_in_closed_loop():
    run = dry_run(load_robot("emps"), make_sine("q", 0.1, 0.02, 0.5, "m", mode="open_loop"))
    assert run.allowed
    assert run.prediction_fault is None
    assert 0 < run.axes["q"].tracking_peak < 1e-3


def make_unstable_robot(limit):
    """Return a robot whose loop is unstable at 20 Hz."""
    emps = load_robot("emps")
    axis = replace(emps.axes["q"], mass=1e-3, damping=0.0)
    return replace(
        emps, axes={"q": replace(axis, controller=replace(axis.controller, limit=limit))}
    )


def test_an_unstable_loop_has_a_reason_instead_of_a_prediction():
    trajectory = make_sine("q", 0.1, 0.02, 0.5, "m", duration_s=100.0, rate_hz=20.0)
    run = dry_run(make_unstable_robot(limit=1e308), trajectory, setpoint_period_s=0.05)
    assert run.axes["q"].tracking_rms is None
    assert "grows" in run.prediction_fault
    assert not run.allowed
    assert [violation.quantity for violation in run.violations] == [LimitedQuantity.MOTION]
    assert "cannot predict" in run.objections[-1]


def test_a_huge_but_finite_response_has_figures():
    trajectory = make_sine("q", 0.1, 0.02, 0.5, "m", duration_s=100.0, rate_hz=20.0)
    run = dry_run(make_unstable_robot(limit=1e250), trajectory, setpoint_period_s=0.05)
    figures = run.axes["q"]
    assert 1e200 < figures.tracking_rms < figures.tracking_peak
    assert not run.allowed


def make_steps(axis, positions, interval_s, unit="m"):
    time_s = np.arange(len(positions)) * interval_s
    return Record.from_signals(time_s, {(axis, Tap.CMD): np.array(positions)}, {axis: unit})


def test_distant_rows_do_not_slow_down_the_loop():
    """A loop that ran only at these rows would move the axis out of its range."""
    emps = load_robot("emps")
    trajectory = make_steps("q", [0.05, 0.06, 0.07, 0.06, 0.06, 0.06, 0.06, 0.06], 0.5)
    run = dry_run(emps, trajectory)
    assert run.allowed
    assert run.axes["q"].tracking_peak == pytest.approx(0.01, rel=1e-2)
    assert not dry_run(emps, trajectory, setpoint_period_s=0.5).allowed


@pytest.mark.parametrize(
    ("height", "is_allowed", "return_positions"),
    [(4.9e-6, False, [0.0]), (4.0e-6, False, []), (2.4e-6, True, [0.0])],
    ids=["high and back", "high", "low and back"],
)
def test_a_predicted_motion_out_of_range_is_refused(height, is_allowed, return_positions):
    """The mirror has no declared bounds, but a step of h rings up to almost 2h between rows."""
    run = dry_run(load_robot("fsm"), make_steps("m1", [0.0, height, *return_positions], 0.001))
    assert run.allowed is is_allowed
    if not is_allowed:
        (violation,) = run.violations
        assert violation.quantity is LimitedQuantity.MOTION
        assert violation.value == pytest.approx(height * (1 + np.exp(-np.pi * 0.02)), rel=0.02)
        for word in ("axis m1: predicted motion", "5 µm", "100 nm (1 % of the range)"):
            assert word in str(violation)
        with pytest.raises(OutOfLimitsError, match="predicted motion"):
            run.require()


def test_a_prediction_in_pieces_equals_the_whole(monkeypatch):
    trajectory = make_sine("q", 0.1, 0.02, 0.5, "m")
    whole = dry_run(load_robot("emps"), trajectory).axes["q"]
    monkeypatch.setattr(prediction, "_CHUNK_INSTANTS", 77)
    pieces = dry_run(load_robot("emps"), trajectory).axes["q"]
    assert pieces.tracking_peak == pytest.approx(whole.tracking_peak, rel=1e-12)
    assert pieces.tracking_rms == pytest.approx(whole.tracking_rms, rel=1e-12)


def test_an_allowed_trajectory_is_copied_with_its_commands_only():
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


@pytest.mark.parametrize("example", [1, 4, 8])
def test_trajectories_of_the_examples_are_allowed(shared_dir, example):
    for file in sorted((shared_dir / "examples" / f"example_{example}").glob("train_*.csv.gz")):
        assert dry_run(ROBOT, read_record(file, robot=ROBOT)).violations == ()


def test_jumps_of_the_reference_are_refused_for_speed(shared_dir):
    run = dry_run(ROBOT, read_record(shared_dir / "reference" / "steps.csv", robot=ROBOT))
    speed_violations = {
        violation.axis: violation
        for violation in run.violations
        if violation.quantity is LimitedQuantity.SPEED
    }
    assert set(speed_violations) == set(ROBOT.axes)
    assert speed_violations["x"].time_s == pytest.approx(0.1005)
    assert speed_violations["x"].value == pytest.approx(0.1)
