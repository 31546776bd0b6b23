"""The driver with virtual boards and a manual clock: moves, stops, playbacks, abilities."""

import numpy as np
import pytest

from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.drivers.contract import (
    DeviceState,
    DriverError,
    LimitError,
    StateError,
)
from rotemina.drivers.mc68hc11.protocol import PARAMETERS_PER_AXIS, BoardFault
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

IDLE, MOVING, PLAYING = DeviceState.IDLE, DeviceState.MOVING, DeviceState.PLAYING


def make_there_and_back(axis, start, distance, period_s, rows=81, unit="m"):
    time_s = np.arange(rows) * period_s
    command = start + 0.5 * distance * (1 - np.cos(2 * np.pi * time_s / time_s[-1]))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit})


@pytest.mark.parametrize(("ports", "baud"), [(2, 125_000), (1, 9600)])
def test_a_move_reaches_its_target_on_every_line(ports, baud, open_bench):
    bench = open_bench(ports=ports, baud=baud)
    bench.driver.move_to({"x": 0.0280000001, "zn": 10e-6})
    assert bench.driver.status().state is MOVING
    samples = bench.run_until(IDLE)
    assert samples.command[-1, [0, 5]] == pytest.approx([0.028, 10e-6], abs=1e-15)
    assert samples.device_time_s[-1] > 0.05
    bench.driver.close()
    assert all(port.is_closed for port in bench.ports)


def test_a_target_at_the_end_of_a_range_is_a_whole_step_inside_it(bench):
    upper_limit = bench.driver.robot.axes["thx"].range[1]
    bench.driver.move_to({"thx": upper_limit})
    assert bench.run_until(IDLE).command[-1, 3] == pytest.approx(58177 * 2e-8, abs=1e-15)


def test_a_new_velocity_replaces_one_that_is_not_sent_yet(bench):
    for speed in (0.001, 0.002, 0.003, 0.004, 0.0):
        bench.driver.move_velocity({"x": speed}, 0.15)
    write_count = len(bench.ports[0].written)
    bench.run(0.05)
    assert len(bench.ports[0].written) - write_count <= 5
    bench.run_until(IDLE)


@pytest.mark.parametrize(
    ("axis", "start", "distance", "unit"),
    [("x", 0.0275, 4e-4, "m"), ("thx", 2e-4, 3e-4, "rad")],
)
def test_a_playback_records_exactly_the_requested_commands(bench, axis, start, distance, unit):
    trajectory = make_there_and_back(axis, start, distance, 0.005, unit=unit)
    bench.driver.play(trajectory)
    assert bench.driver.status().state is PLAYING
    samples = bench.run_until(IDLE, MOVING)
    is_playback_row = samples.playback_row >= 0
    np.testing.assert_array_equal(samples.playback_row[is_playback_row], np.arange(81))
    column = bench.driver.axes.index(axis)
    commands = trajectory.signal(axis, Tap.CMD)
    _, board_axis = bench.driver._open_session.find_axis(axis)
    rounded = [board_axis.to_si(board_axis.to_steps(command)) for command in commands]
    np.testing.assert_array_equal(samples.command[is_playback_row, column], rounded)
    np.testing.assert_allclose(np.diff(samples.device_time_s[is_playback_row]), 0.005, atol=2e-6)
    assert bench.driver.status().progress == 1.0
    other_commands = np.delete(samples.command, column, axis=1)
    assert (other_commands == other_commands[0]).all()
    assert bench.driver.link_quality().repeated == 0


@pytest.mark.parametrize(
    ("baud", "period_s", "round_s"), [(125_000, 0.02, 0.001), (9_600, 0.2, 0.01)]
)
def test_a_record_is_played_on_a_shared_bus(open_bench, baud, period_s, round_s):
    bench = open_bench(ports=1, baud=baud)
    # Set-points share the bus with telemetry.
    assert bench.driver.setpoint_period_s == period_s
    time_s = np.arange(21) * period_s
    wave = 0.5 * (1 - np.cos(2 * np.pi * time_s / time_s[-1]))
    record = Record.from_signals(
        time_s,
        {("x", Tap.CMD): 0.0275 + 2e-4 * wave, ("zn", Tap.CMD): 2e-5 + 2e-5 * wave},
        {"x": "m", "zn": "m"},
    )
    bench.driver.play(record)
    samples = bench.run_until(IDLE, MOVING, round_s=round_s)
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(21))
    assert bench.driver.status().fault is None


def test_a_shared_bus_delivers_the_announced_rates(open_bench):
    bench = open_bench(ports=1)
    assert np.median(np.diff(bench.run(0.3).device_time_s)) == pytest.approx(0.01, abs=1e-6)
    bench.driver.capture(["zn"], bench.driver.capture_rates.single_axis_hz, 100)
    portions = []
    while not (portions and portions[-1].complete):
        bench.run(0.001)
        portions += [part] if (part := bench.driver.read_capture()) is not None else []
    assert sum(len(part.measured) for part in portions) == 100
    assert np.median(np.diff(bench.run(0.3).device_time_s)) == pytest.approx(0.01, abs=1e-6)


def test_fast_rows_act_at_the_next_set_point_and_slow_rows_are_held(bench):
    time_s = np.array([0.0, 0.001, 0.004, 0.012, 0.013, 0.050])
    command = 2e-5 + 1e-9 * np.arange(6)
    record = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    bench.driver.play(record)
    samples = bench.run_until(IDLE, MOVING)
    is_playback_row = samples.playback_row >= 0
    assert samples.playback_row[is_playback_row].tolist() == [0, 2, 4, 5]


def test_rows_too_close_in_time_are_refused_before_any_motion(bench):
    """At 9.9 mm/s a row of 4.9 ms is 48.5 µm, and an axis moves at most 50 µm per set-point."""
    time_s = 4.9e-3 * np.arange(200)
    speed = 9.9e-3 * np.clip(np.minimum(time_s, time_s[-1] - time_s) / 0.1, 0.0, 1.0)
    command = 0.02 + 4.9e-3 * np.cumsum(speed)
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    # The speeds of the record are allowed.
    bench.driver.accept(record)
    message = (
        r"axis x: .* t = [\d.]+ s are 97[\d.]* µm apart, more than the limit 50\.1 µm in 5 ms; add"
    )
    with pytest.raises(LimitError, match=message):
        bench.driver.play(record)
    assert bench.driver.status().state is IDLE
    samples = bench.run(0.1)
    assert (samples.command == samples.command[0]).all()
    # Another record can still be played.
    bench.driver.play(make_there_and_back("zn", 2e-5, 1e-6, 0.005, rows=3))
    assert bench.driver.status().state is PLAYING


@pytest.mark.parametrize("after_s", [0.004, 0.06, 0.3])
def test_stop_ends_a_trajectory_in_any_phase(bench, after_s):
    bench.driver.play(make_there_and_back("x", 0.0277, 4e-4, 0.005))
    bench.run(after_s)
    assert bench.driver.status().state is PLAYING
    bench.driver.stop()
    samples = bench.run_until(IDLE)
    later_samples = bench.run(0.3)
    assert (later_samples.command == samples.command[-1]).all()
    assert (later_samples.playback_row == -1).all()
    assert bench.driver.status().progress < 1.0
    bench.driver.move_to({"x": 0.0276})
    assert bench.run_until(IDLE).command[-1, 0] == pytest.approx(0.0276, abs=1e-15)
    bench.driver.play(make_there_and_back("x", 0.0277, 4e-4, 0.005))
    assert bench.run_until(IDLE, MOVING).playback_row.max() == 80


@pytest.mark.parametrize("ports", [1, 2])
def test_a_stop_takes_less_than_5_ms_with_the_line_saturated(ports, open_bench):
    bench = open_bench(ports=ports, settings={"settle_s": 0.0})
    period_s = bench.driver.setpoint_period_s
    trajectory = bench.driver.accept(make_there_and_back("x", 0.0275, 4e-4, period_s, rows=4000))
    generator = np.random.default_rng(3)
    latencies = []
    for _ in range(4):
        bench.driver.play(trajectory)
        bench.run(0.08 + 10 * period_s + 0.001 * int(generator.integers(20)))
        bench.clock.advance(float(generator.uniform(0, 1e-3)))
        request_s, announced_s = bench.clock() - bench.begin_s, bench.driver.link_quality().stop_s
        bench.boards.notes.take_events()
        bench.driver.stop()
        bench.run_until(IDLE, round_s=0.002)
        heard_after_s = {}
        for event in bench.boards.notes.take_events():
            if event.text.endswith("stop heard"):
                heard_after_s.setdefault(event.text, event.at_s - request_s)
        assert len(heard_after_s) == 2
        assert max(heard_after_s.values()) <= announced_s + 1e-6
        latencies += heard_after_s.values()
    assert max(latencies) <= 0.005


def test_a_stop_that_the_program_did_not_send_is_a_fault(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.1)
    bench.boards.host_ports[0].receive(b"\0\0", bench.clock() - bench.begin_s)
    bench.run_until(DeviceState.FAULT)
    assert "that this program did not send" in bench.driver.status().fault
    with pytest.raises(StateError, match="clear"):
        bench.driver.move_to({"x": 0.03})
    bench.run(0.3)
    bench.driver.clear_fault()
    bench.run_until(IDLE)
    bench.driver.move_to({"x": 0.029})
    bench.run_until(IDLE)


def test_homing_makes_the_position_known(open_bench):
    bench = open_bench(position_known=False, start_fraction=0.05)
    status = bench.driver.status()
    assert (status.state, status.position_known) == (IDLE, False)
    assert status.unhomed == ("x", "y", "z")
    with pytest.raises(StateError, match="home first"):
        bench.driver.move_to({"x": 0.03})
    bench.driver.home(["x", "y", "z"])
    assert bench.driver.status().state is DeviceState.HOMING
    samples = bench.run_until(IDLE, round_s=0.002)
    assert bench.driver.status().position_known
    assert samples.command[-1, :3].tolist() == [0.0, 0.0, 0.0]


def test_a_capture_is_complete_and_uses_the_clock_of_the_samples(bench):
    bench.driver.move_to({"zn": 50e-6})
    bench.driver.capture(["zn"], 2000.0, 400)
    portions = []
    for _ in range(60):
        bench.run(0.01)
        if (part := bench.driver.read_capture()) is not None:
            portions.append(part)
    assert portions[-1].complete
    assert portions[-1].lost == 0
    time_s = np.concatenate([part.device_time_s for part in portions])
    measured = np.concatenate([part.measured for part in portions])
    assert measured.shape == (400, 1)
    np.testing.assert_allclose(np.diff(time_s), 5e-4, atol=1e-7)
    assert measured[-1, 0] == pytest.approx(50e-6, abs=1e-7)
    samples = bench.run(0.1)
    assert len(samples) == pytest.approx(20, abs=1)


def test_captures_that_boards_cannot_do_are_refused(bench):
    with pytest.raises(LimitError, match="one board"):
        bench.driver.capture(["x", "zn"], 100.0, 10)
    with pytest.raises(LimitError, match="at least"):
        bench.driver.capture(["x"], 1.0, 10)


def test_a_profile_starts_when_it_is_triggered(bench):
    with pytest.raises(StateError, match="no profile"):
        bench.driver.trigger()
    start_position = bench.driver._commanded("zn")
    up = ProfileSegment(0.1, 0.0, 3e-6, -2e-6)
    down = ProfileSegment(0.1, 0.0, -3e-6, 2e-6)
    bench.driver.upload(MotionProfile("zn", (up, down)))
    bench.driver.trigger()
    assert bench.driver.status().state is PLAYING
    samples = bench.run_until(IDLE)
    assert samples.command[:, 5].max() == pytest.approx(start_position + 1e-6, abs=2e-9)
    assert samples.command[-1, 5] == pytest.approx(start_position, abs=2e-9)


def test_a_voltage_can_be_set(bench):
    bench.driver.set_voltage("zn", 50.0)
    samples = bench.run_until(IDLE)
    assert samples.command[-1, 5] == pytest.approx(50.0 * 5e-7, abs=2e-9)


def test_text_is_shown_and_inputs_are_read(bench):
    bench.driver.show(1, "hello")
    bench.boards.set_inputs((0, 2048, 4095), 0b10)
    bench.run(0.2)
    assert "hello" in bench.boards.read_lcd()[1]
    readings, buttons = bench.driver.analog_inputs()
    assert readings == pytest.approx((0.0, 0.5, 1.0), abs=1e-3)
    assert buttons == (False, True)


def test_different_parameters_block_motion_until_accepted_or_written(robot, make_bench):
    bench = make_bench(robot)
    bench.boards.boards[0].parameters.write(2, 90_000)
    bench.driver.open()
    (difference,) = bench.driver.differences
    assert (difference.device, difference.robot) == (90_000, 100_000)
    with pytest.raises(StateError, match="accept_parameters or write_parameters"):
        bench.driver.move_to({"x": 0.03})
    bench.driver.write_parameters()
    bench.run(0.03)
    with pytest.raises(StateError, match="while its parameters are written"):
        bench.driver.move_to({"x": 0.03})
    bench.run(0.1)
    assert bench.driver.differences == ()
    bench.driver.move_to({"x": 0.028})
    bench.run_until(IDLE)


def test_accepted_parameters_apply(robot, make_bench):
    bench = make_bench(robot)
    bench.boards.boards[0].parameters.write(2, 10_000)
    bench.driver.open()
    bench.driver.accept_parameters()
    bench.driver.move_to({"x": 0.0277})
    samples = bench.run_until(IDLE)
    speed = np.abs(np.diff(samples.command[:, 0])) / np.diff(samples.device_time_s)
    assert speed.max() <= 0.001 * (1 + 1e-6)


def test_a_voltage_is_refused_if_the_accepted_parameters_allow_none(robot, make_bench):
    bench = make_bench(robot)
    parameters = bench.boards.boards[1].parameters
    parameters.write(2 * PARAMETERS_PER_AXIS + 5, parameters[2 * PARAMETERS_PER_AXIS + 4])
    bench.driver.open()
    bench.driver.accept_parameters()
    with pytest.raises(StateError, match="the voltage of axis"):
        bench.driver.set_voltage("zn", 10.0)


def test_a_reopened_driver_is_idle(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.3)
    bench.driver.close()
    bench.clock.advance(2.0)
    bench.driver.open()
    assert bench.driver.status().state is IDLE
    assert bench.boards.boards[0].fault is BoardFault.NONE
    bench.driver.move_to({"x": 0.03})
    bench.run_until(IDLE)


def test_a_second_port_of_one_board_is_refused(make_bench):
    bench = make_bench(load_robot("picma"), ports=1, settings={"second_port": "second"})
    with pytest.raises(DriverError, match="second_port"):
        bench.driver.open()


@pytest.mark.parametrize(("ports", "period_s"), [(2, 0.01), (1, 0.02)])
def test_a_chip_of_half_the_clock_plays_every_row_at_half_the_rate(open_bench, ports, period_s):
    bench = open_bench(ports=ports, tick_s=1e-3)
    assert bench.driver.setpoint_period_s == period_s
    assert bench.driver.capture_rates.max_rate_for(1) == 1000.0
    path = make_there_and_back("zn", 30e-6, 2e-6, period_s, rows=31)
    bench.driver.play(path)
    samples = bench.run_until(IDLE)
    assert bench.driver.status().fault is None
    is_playback_row = samples.playback_row >= 0
    np.testing.assert_array_equal(samples.playback_row[is_playback_row], np.arange(31))
    command = path.signal("zn", Tap.CMD)
    np.testing.assert_allclose(samples.command[is_playback_row, 5], command, atol=5.1e-10)
