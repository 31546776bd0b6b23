"""Model against real: figures that are known, and the real machines' known gaps."""

import runpy
import sys

import numpy as np
import pytest

from rotemina.sim.comparison.comparison import compare
from rotemina.sim.errors import InputError
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
TIME_S = np.arange(8000) / 2000
SWEEP = 5e-4 + 2e-4 * np.sin(2 * np.pi * (0.5 + TIME_S) * TIME_S)


def record_of(changed, command=SWEEP, axis="thx", tap=Tap.MEAS, **metadata):
    """A record whose measurement is what ``changed`` makes of the model's answer."""
    unit = "rad" if axis.startswith("th") else "m"
    bare = Record.from_signals(TIME_S, {(axis, Tap.CMD): command}, {axis: unit}, metadata)
    answer = nominal_response(ROBOT, bare).signal(axis, tap)
    signals = {(axis, Tap.CMD): command, (axis, tap): changed(answer)}
    return Record.from_signals(TIME_S, signals, {axis: unit}, metadata)


def only(comparison):
    (tap,) = comparison.taps
    return tap


def test_a_perfect_machine_leaves_nothing():
    tap = only(compare(ROBOT, record_of(lambda answer: answer)))
    assert (tap.axis, tap.tap, tap.unit) == ("thx", "meas", "rad")
    assert tap.rms == 0.0
    assert tap.delay_s == pytest.approx(0.0, abs=1e-9)
    assert tap.noise_floor == pytest.approx(np.hypot(4.0e-7, 1.42035e-7 / np.sqrt(12)))
    assert tap.noise_floor_source == "declared"
    assert tap.rms_refitted is None


def test_a_reference_s_own_noise_counts_before_the_robot_s_usual_one():
    plain = only(compare(ROBOT, record_of(lambda answer: answer, tap=Tap.REF)))
    assert plain.noise_floor == ROBOT.reference.noise_rms.angular
    entry = {"reference_noise thx": "3e-6", "reference_noise zn": "1"}
    own = only(compare(ROBOT, record_of(lambda answer: answer, tap=Tap.REF, **entry)))
    assert (own.noise_floor, own.noise_floor_source) == (3e-6, "declared")


@pytest.mark.parametrize("text", ["0", "-1e-6", "inf", "nan", "30 nm", ""])
def test_a_reference_s_noise_that_is_none_is_refused(text):
    record = record_of(lambda answer: answer, tap=Tap.REF, **{"reference_noise thx": text})
    with pytest.raises(InputError, match=r"reference_noise thx = .*above 0, in m or rad"):
        compare(ROBOT, record)


def test_figures_of_a_shifted_reading_are_exact():
    tap = only(compare(ROBOT, record_of(lambda answer: answer + 1e-5)))
    assert tap.rms == pytest.approx(1e-5)
    assert tap.peak == pytest.approx(1e-5)
    assert tap.share_of_range == pytest.approx(1e-5 / 1.16355e-3)
    assert tap.relative_error == pytest.approx(
        1e-5 / np.sqrt(np.mean((SWEEP + 1e-5) ** 2)), rel=1e-3
    )


def test_gain_and_offset_are_refitted_together_or_alone():
    record = record_of(lambda answer: 0.9 * answer + 2e-5)
    assert only(compare(ROBOT, record, fit=["gain", "offset"])).rms_refitted < 1e-14
    assert only(compare(ROBOT, record, fit=["gain"])).rms_refitted > 1e-6
    assert only(compare(ROBOT, record, fit=["offset"])).rms_refitted > 1e-6
    unfitted = only(compare(ROBOT, record)).rms
    assert only(compare(ROBOT, record, fit=["offset"])).rms_refitted < unfitted


@pytest.mark.parametrize("delay_s", [-1.7e-3, 2e-4, 6e-3])
def test_a_late_signal_is_late_by_its_delay(delay_s):
    record = record_of(lambda answer: np.interp(TIME_S - delay_s, TIME_S, answer))
    assert only(compare(ROBOT, record)).delay_s == pytest.approx(delay_s, abs=2e-5)


def test_a_delay_is_found_on_uneven_samples_too():
    rng = np.random.default_rng(1)
    time_s = np.cumsum(rng.uniform(3e-4, 7e-4, 6000))
    command = 5e-4 + 1e-4 * np.sin(9.0 * time_s)
    bare = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    answer = nominal_response(ROBOT, bare).signal("thx", Tap.MEAS)
    late = np.interp(time_s - 4e-3, time_s, answer)
    signals = {("thx", Tap.CMD): command, ("thx", Tap.MEAS): late}
    record = Record.from_signals(time_s, signals, {"thx": "rad"})
    assert only(compare(ROBOT, record)).delay_s == pytest.approx(4e-3, abs=1e-4)


def test_no_delay_is_claimed_for_an_axis_that_does_not_move():
    still = np.full(len(TIME_S), 3e-4)
    noise = 1e-7 * np.random.default_rng(2).standard_normal(len(TIME_S))
    assert only(compare(ROBOT, record_of(lambda answer: answer + noise, still))).delay_s is None


def test_an_undeclared_floor_is_measured_at_rest():
    robot = load_robot("picma")
    noise = 3e-8 * np.random.default_rng(3).standard_normal(len(TIME_S))
    command = np.where(TIME_S > 2.0, 2e-5, 1e-5)
    signals = {("p", Tap.CMD): command, ("p", Tap.MEAS): command + noise}
    tap = only(compare(robot, Record.from_signals(TIME_S, signals, {"p": "m"})))
    assert tap.noise_floor_source == "at rest"
    assert tap.noise_floor == pytest.approx(3e-8, rel=0.05)


def test_rounding_is_no_noise_floor():
    command = np.where(TIME_S > 2.0, 2e-5, 1e-5)
    volts = command / 12.53e-6
    signals = {("p", Tap.CMD): command, ("p", Tap.U): volts}
    tap = only(compare(load_robot("picma"), Record.from_signals(TIME_S, signals, {"p": "m"})))
    assert tap.noise_floor is None
    assert tap.noise_floor_source is None


def test_an_undeclared_floor_is_measured_from_period_to_period():
    robot = load_robot("fsm")
    noise = 2e-8 * np.random.default_rng(4).standard_normal(len(TIME_S))
    command = 1e-6 * np.sin(2 * np.pi * 5 * TIME_S)
    meta = {"history": "periodic", "period_samples": "4000"}
    signals = {("m1", Tap.CMD): command, ("m1", Tap.MEAS): command + noise}
    tap = only(compare(robot, Record.from_signals(TIME_S, signals, {"m1": "m"}, meta)))
    assert tap.noise_floor_source == "period to period"
    assert tap.noise_floor == pytest.approx(2e-8, rel=0.05)


@pytest.mark.parametrize("velocity", ["backward", "state"])
def test_the_floor_of_the_effort_is_the_sensors_through_the_controller(velocity):
    """Against the loop written out with white noise on its reading."""
    from dataclasses import replace

    from scipy.linalg import expm

    from rotemina.sim.robot.model import Sensor

    emps = load_robot("emps")
    axis = emps.axes["q"]
    loop = replace(axis.controller, velocity=velocity, kp=40.0)
    noise_rms, count, step = 2e-6, 40_000, 1e-3
    axis = replace(axis, controller=loop, sensor=Sensor(kind="encoder", noise_rms=noise_rms))
    robot = replace(emps, axes={"q": axis})
    time_s = step * np.arange(count)
    still = {("q", Tap.CMD): np.zeros(count), ("q", Tap.U): np.zeros(count)}
    tap = only(
        compare(robot, Record.from_signals(time_s, still, {"q": "m"}, {"mode": "closed_loop"}))
    )

    generator = np.zeros((3, 3))
    generator[0, 1], generator[1, 1], generator[1, 2] = 1.0, -axis.damping, axis.gain
    generator[1] /= axis.mass
    advance = expm(generator * step)
    noise = noise_rms * np.random.default_rng(5).standard_normal(count)
    q = v = before = 0.0
    efforts = np.empty(count)
    for k in range(count):
        read = q + noise[k]
        speed = v if velocity == "state" else (read - before) / step
        efforts[k] = loop.kv * (-loop.kp * read - speed)
        before = read
        q, v, _ = advance @ [q, v, efforts[k]]
    assert tap.noise_floor_source == "declared"
    assert tap.noise_floor == pytest.approx(efforts[100:].std(), rel=0.02)


def test_what_cannot_be_fitted_or_compared_is_refused():
    record = record_of(lambda answer: answer)
    with pytest.raises(InputError, match="'speed' cannot be re-fitted; choose from gain, offset"):
        compare(ROBOT, record, fit=["speed"])
    bare = Record.from_signals(TIME_S, {("thx", Tap.CMD): SWEEP}, {"thx": "rad"})
    with pytest.raises(InputError, match=r"no measured channel .*it has thx\.cmd"):
        compare(ROBOT, bare)


def test_the_json_form_is_the_agreed_one():
    form = compare(ROBOT, record_of(lambda answer: answer + 1e-6), fit=["gain"]).as_json()
    assert form["format"] == "rotemina-comparison 1"
    agreed = {
        "axis", "tap", "unit", "rms", "peak", "share_of_range", "relative_error", "delay_s",
        "noise_floor", "rms_refitted",
    }  # fmt: skip
    assert agreed <= set(form["taps"][0])


@pytest.fixture(scope="module")
def real_dir(shared_dir, tmp_path_factory):
    """The records of real machines, converted by the script that comes with them."""
    folder = tmp_path_factory.mktemp("real")
    arguments, sys.argv = sys.argv, ["convert.py", str(folder)]
    try:
        runpy.run_path(str(shared_dir / "data" / "convert.py"), run_name="__main__")
    finally:
        sys.argv = arguments
    return folder


def test_emps_without_dry_friction_leaves_its_known_gap_in_the_effort(real_dir):
    robot = load_robot("emps")
    taps = compare(robot, read_record(real_dir / "emps_train.csv", robot=robot)).taps
    effort = next(tap for tap in taps if tap.tap == "u")
    assert effort.relative_error == pytest.approx(0.173, abs=0.003)
    assert next(tap for tap in taps if tap.tap == "meas").relative_error < 1e-3


def test_picma_leaves_its_known_gap_after_gain_and_offset(real_dir):
    robot = load_robot("picma")
    record = read_record(real_dir / "picma_train.csv", robot=robot)
    taps = compare(robot, record, fit=["gain", "offset"]).taps
    measured = next(tap for tap in taps if tap.tap == "meas")
    assert measured.rms_refitted == pytest.approx(3.41e-6, abs=0.1e-6)


def test_the_steering_mirror_leaves_its_known_gap(real_dir):
    robot = load_robot("fsm")
    gap = size = 0.0
    for path in sorted(real_dir.glob("fsm_200mV_*.csv")):
        for tap in compare(robot, read_record(path, robot=robot)).taps:
            if tap.tap == "meas":
                gap += tap.rms**2
                size += (tap.rms / tap.relative_error) ** 2
    assert np.sqrt(gap / size) == pytest.approx(1.31, abs=0.03)


@pytest.mark.parametrize("moving", [0, 1, 2])
def test_a_playback_that_was_cut_off_when_it_began_is_not_compared(moving):
    """Not a single figure says how good the model is where nothing has moved yet."""
    command = np.zeros(max(moving, 1) + 1)
    command[len(command) - moving :] = 1e-6
    short = Record.from_signals(
        TIME_S[: len(command)], {("x", Tap.CMD): command, ("x", Tap.MEAS): command}, {"x": "m"}
    )
    with pytest.raises(InputError, match=f"{len(command)} rows, {moving} of them in motion"):
        compare(ROBOT, short)


def test_a_machine_that_holds_still_can_be_compared():
    assert only(compare(ROBOT, record_of(lambda answer: answer, np.full(8000, 5e-4)))).rms == 0.0
