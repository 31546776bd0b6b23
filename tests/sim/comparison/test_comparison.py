"""Comparison of model and record: exact figures, and the known gaps of real machines."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotemina.sim.comparison import compare
from rotemina.sim.errors import InputError
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot.model import AxisSensor
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
TIME_S = np.arange(8000) / 2000
SWEEP = 5e-4 + 2e-4 * np.sin(2 * np.pi * (0.5 + TIME_S) * TIME_S)


def make_record(change, command=SWEEP, axis="thx", tap=Tap.MEAS, **metadata):
    """Return a record whose measurement is the model's response after ``change``."""
    unit = "rad" if axis.startswith("th") else "m"
    commands = Record.from_signals(TIME_S, {(axis, Tap.CMD): command}, {axis: unit}, metadata)
    response = simulate_nominal_response(ROBOT, commands).signal(axis, tap)
    signals = {(axis, Tap.CMD): command, (axis, tap): change(response)}
    return Record.from_signals(TIME_S, signals, {axis: unit}, metadata)


def keep(response):
    return response


def get_only_tap(comparison):
    (tap,) = comparison.taps
    return tap


def test_a_perfect_machine_has_no_gap():
    tap = get_only_tap(compare(ROBOT, make_record(keep)))
    assert (tap.axis, tap.tap, tap.unit) == ("thx", "meas", "rad")
    assert tap.rms == 0.0
    assert tap.delay_s == pytest.approx(0.0, abs=1e-9)
    assert tap.noise_floor == pytest.approx(np.hypot(4.0e-7, 1.42035e-7 / np.sqrt(12)))
    assert tap.noise_floor_source == "declared"
    assert tap.rms_refitted is None


def test_reference_noise_in_the_record_overrides_that_of_the_robot():
    robot_default = get_only_tap(compare(ROBOT, make_record(keep, tap=Tap.REF)))
    assert robot_default.noise_floor == ROBOT.reference.noise_rms.angular
    entry = {"reference_noise thx": "3e-6", "reference_noise zn": "1"}
    declared = get_only_tap(compare(ROBOT, make_record(keep, tap=Tap.REF, **entry)))
    assert (declared.noise_floor, declared.noise_floor_source) == (3e-6, "declared")


@pytest.mark.parametrize("text", ["0", "-1e-6", "inf", "nan", "30 nm", ""])
def test_reference_noise_that_is_no_positive_number_is_refused(text):
    record = make_record(keep, tap=Tap.REF, **{"reference_noise thx": text})
    with pytest.raises(InputError, match=r"reference_noise thx = .*above 0, in m or rad"):
        compare(ROBOT, record)


def test_figures_of_a_shifted_reading_are_exact():
    tap = get_only_tap(compare(ROBOT, make_record(lambda response: response + 1e-5)))
    assert tap.rms == pytest.approx(1e-5)
    assert tap.peak == pytest.approx(1e-5)
    assert tap.share_of_range == pytest.approx(1e-5 / 1.16355e-3)
    assert tap.relative_error == pytest.approx(
        1e-5 / np.sqrt(np.mean((SWEEP + 1e-5) ** 2)), rel=1e-3
    )


def test_gain_and_offset_are_refitted_together_or_alone():
    record = make_record(lambda response: 0.9 * response + 2e-5)
    assert get_only_tap(compare(ROBOT, record, fit=["gain", "offset"])).rms_refitted < 1e-14
    assert get_only_tap(compare(ROBOT, record, fit=["gain"])).rms_refitted > 1e-6
    assert get_only_tap(compare(ROBOT, record, fit=["offset"])).rms_refitted > 1e-6
    unfitted = get_only_tap(compare(ROBOT, record)).rms
    assert get_only_tap(compare(ROBOT, record, fit=["offset"])).rms_refitted < unfitted


@pytest.mark.parametrize("delay_s", [-1.7e-3, 6e-3])
def test_the_delay_of_a_shifted_signal_is_found(delay_s):
    record = make_record(lambda response: np.interp(TIME_S - delay_s, TIME_S, response))
    assert get_only_tap(compare(ROBOT, record)).delay_s == pytest.approx(delay_s, abs=2e-5)


def test_a_delay_is_found_on_uneven_samples_too():
    rng = np.random.default_rng(1)
    time_s = np.cumsum(rng.uniform(3e-4, 7e-4, 6000))
    command = 5e-4 + 1e-4 * np.sin(9.0 * time_s)
    commands = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    response = simulate_nominal_response(ROBOT, commands).signal("thx", Tap.MEAS)
    delayed = np.interp(time_s - 4e-3, time_s, response)
    signals = {("thx", Tap.CMD): command, ("thx", Tap.MEAS): delayed}
    record = Record.from_signals(time_s, signals, {"thx": "rad"})
    assert get_only_tap(compare(ROBOT, record)).delay_s == pytest.approx(4e-3, abs=1e-4)


def test_an_axis_that_does_not_move_has_no_delay():
    still = np.full(len(TIME_S), 3e-4)
    noise = 1e-7 * np.random.default_rng(2).standard_normal(len(TIME_S))
    noisy, perfect = (
        get_only_tap(compare(ROBOT, make_record(lambda response, e=error: response + e, still)))
        for error in (noise, 0.0)
    )
    assert noisy.delay_s is None
    assert perfect.rms == 0.0


def test_an_undeclared_floor_is_measured_at_rest():
    robot = load_robot("picma")
    noise = 3e-8 * np.random.default_rng(3).standard_normal(len(TIME_S))
    command = np.where(TIME_S > 2.0, 2e-5, 1e-5)
    signals = {("p", Tap.CMD): command, ("p", Tap.MEAS): command + noise}
    tap = get_only_tap(compare(robot, Record.from_signals(TIME_S, signals, {"p": "m"})))
    assert tap.noise_floor_source == "at rest"
    assert tap.noise_floor == pytest.approx(3e-8, rel=0.05)


def test_rounding_is_no_noise_floor():
    command = np.where(TIME_S > 2.0, 2e-5, 1e-5)
    volts = command / 12.53e-6
    signals = {("p", Tap.CMD): command, ("p", Tap.U): volts}
    tap = get_only_tap(
        compare(load_robot("picma"), Record.from_signals(TIME_S, signals, {"p": "m"}))
    )
    assert tap.noise_floor is None
    assert tap.noise_floor_source is None


def test_an_undeclared_floor_is_measured_from_period_to_period():
    robot = load_robot("fsm")
    noise = 2e-8 * np.random.default_rng(4).standard_normal(len(TIME_S))
    command = 1e-6 * np.sin(2 * np.pi * 5 * TIME_S)
    meta = {"history": "periodic", "period_samples": "4000"}
    signals = {("m1", Tap.CMD): command, ("m1", Tap.MEAS): command + noise}
    tap = get_only_tap(compare(robot, Record.from_signals(TIME_S, signals, {"m1": "m"}, meta)))
    assert tap.noise_floor_source == "period to period"
    assert tap.noise_floor == pytest.approx(2e-8, rel=0.05)


@pytest.mark.parametrize("velocity", ["backward", "state"])
def test_the_noise_floor_of_the_effort_is_sensor_noise_through_the_controller(velocity):
    """Compare with a simulation of the loop with white noise on its reading."""
    emps = load_robot("emps")
    axis = emps.axes["q"]
    loop = replace(axis.controller, velocity=velocity, kp=40.0)
    noise_rms, count, step = 2e-6, 40_000, 1e-3
    axis = replace(axis, controller=loop, sensor=AxisSensor(kind="encoder", noise_rms=noise_rms))
    robot = replace(emps, axes={"q": axis})
    time_s = step * np.arange(count)
    signals = {("q", Tap.CMD): np.zeros(count), ("q", Tap.U): np.zeros(count)}
    tap = get_only_tap(
        compare(robot, Record.from_signals(time_s, signals, {"q": "m"}, {"mode": "closed_loop"}))
    )

    dynamics = np.zeros((3, 3))
    dynamics[0, 1], dynamics[1, 1], dynamics[1, 2] = 1.0, -axis.damping, axis.gain
    dynamics[1] /= axis.mass
    transition = expm(dynamics * step)
    noise = noise_rms * np.random.default_rng(5).standard_normal(count)
    q = v = previous_reading = 0.0
    efforts = np.empty(count)
    for k in range(count):
        reading = q + noise[k]
        speed = v if velocity == "state" else (reading - previous_reading) / step
        efforts[k] = loop.kv * (-loop.kp * reading - speed)
        previous_reading = reading
        q, v, _ = transition @ [q, v, efforts[k]]
    assert tap.noise_floor_source == "declared"
    assert tap.noise_floor == pytest.approx(efforts[100:].std(), rel=0.02)


def test_unknown_fits_and_records_without_measurement_are_refused():
    record = make_record(keep)
    with pytest.raises(InputError, match="'speed' cannot be re-fitted; choose from gain, offset"):
        compare(ROBOT, record, fit=["speed"])
    commands_only = Record.from_signals(TIME_S, {("thx", Tap.CMD): SWEEP}, {"thx": "rad"})
    with pytest.raises(InputError, match=r"no measured channel .*it has thx\.cmd"):
        compare(ROBOT, commands_only)


def test_the_json_form_has_the_documented_keys():
    document = compare(ROBOT, make_record(lambda response: response + 1e-6), fit=["gain"]).as_json()
    assert document["format"] == "rotemina-comparison 1"
    required_keys = {
        "axis", "tap", "unit", "rms", "peak", "share_of_range", "relative_error", "delay_s",
        "noise_floor", "rms_refitted",
    }  # fmt: skip
    assert required_keys <= set(document["taps"][0])


def test_emps_without_dry_friction_has_its_known_gap_in_the_effort(real_dir):
    robot = load_robot("emps")
    taps = compare(robot, read_record(real_dir / "emps_train.csv", robot=robot)).taps
    effort = next(tap for tap in taps if tap.tap == "u")
    assert effort.relative_error == pytest.approx(0.173, abs=0.003)
    assert next(tap for tap in taps if tap.tap == "meas").relative_error < 1e-3


def test_picma_has_its_known_gap_after_fitting_gain_and_offset(real_dir):
    robot = load_robot("picma")
    record = read_record(real_dir / "picma_train.csv", robot=robot)
    taps = compare(robot, record, fit=["gain", "offset"]).taps
    measured = next(tap for tap in taps if tap.tap == "meas")
    assert measured.rms_refitted == pytest.approx(3.41e-6, abs=0.1e-6)


def test_the_steering_mirror_has_its_known_gap(real_dir):
    robot = load_robot("fsm")
    gap = size = 0.0
    for path in sorted(real_dir.glob("fsm_200mV_*.csv")):
        for tap in compare(robot, read_record(path, robot=robot)).taps:
            if tap.tap == "meas":
                gap += tap.rms**2
                size += (tap.rms / tap.relative_error) ** 2
    assert np.sqrt(gap / size) == pytest.approx(1.31, abs=0.03)


@pytest.mark.parametrize("moving_rows", [0, 1, 2])
def test_a_playback_with_too_few_moving_rows_is_refused(moving_rows):
    command = np.zeros(max(moving_rows, 1) + 1)
    command[len(command) - moving_rows :] = 1e-6
    record = Record.from_signals(
        TIME_S[: len(command)], {("x", Tap.CMD): command, ("x", Tap.MEAS): command}, {"x": "m"}
    )
    with pytest.raises(InputError, match=f"{len(command)} rows, {moving_rows} of them in motion"):
        compare(ROBOT, record)
