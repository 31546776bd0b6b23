"""The driver against virtual boards on a clock set by hand: moves, stops, playbacks, abilities."""

import numpy as np
import pytest

from rotemina.drivers.errors import DriverError, LimitError, StateError
from rotemina.drivers.mc68hc11 import segment_player
from rotemina.drivers.mc68hc11.parameters import PER_AXIS
from rotemina.drivers.mc68hc11.protocol_codes import Fault
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

IDLE, MOVING, PLAYING = DeviceState.IDLE, DeviceState.MOVING, DeviceState.PLAYING


@pytest.fixture
def bench(robot, joined_bench):
    made = joined_bench(robot)
    made.driver.open()
    made.run(0.05)
    yield made
    made.driver.close()


def there_and_back(axis, start, distance, period_s, rows=81, unit="m"):
    time_s = np.arange(rows) * period_s
    command = start + 0.5 * distance * (1 - np.cos(2 * np.pi * time_s / time_s[-1]))
    return Record.from_signals(time_s, {(axis, Tap.CMD): command}, {axis: unit})


def test_it_opens_at_rest_and_samples_follow_each_other(bench):
    samples = bench.run(0.5)
    assert bench.driver.status().state is IDLE
    assert bench.driver.setpoint_period_s == 0.005
    np.testing.assert_allclose(np.diff(samples.device_time_s), 0.005, atol=1e-9)
    assert (samples.command == samples.command[0]).all()
    assert np.isnan(samples.inputs).all()
    assert bench.driver.link_quality().rejected == 0


@pytest.mark.parametrize(("ports", "baud"), [(2, 125_000), (1, 125_000), (2, 9600), (1, 9600)])
def test_a_move_arrives_and_is_never_idle_on_the_way(robot, ports, baud, joined_bench):
    bench = joined_bench(robot, ports=ports, baud=baud)
    bench.driver.open()
    bench.driver.move_to({"x": 0.0280000001, "zn": 10e-6})
    assert bench.driver.status().state is MOVING
    samples = bench.run_until(IDLE)
    assert samples.command[-1, [0, 5]] == pytest.approx([0.028, 10e-6], abs=1e-15)
    assert samples.device_time_s[-1] > 0.05
    bench.driver.close()
    assert all(port.closed for port in bench.ports)


def test_a_target_at_the_end_of_a_range_is_a_whole_step_inside_it(bench):
    high = bench.driver.robot.axes["thx"].range[1]
    bench.driver.move_to({"thx": high})
    assert bench.run_until(IDLE).command[-1, 3] == pytest.approx(58177 * 2e-8, abs=1e-15)


def test_speeds_are_kept_to(bench):
    begin = bench.driver.read().command
    bench.driver.move_to({"x": 0.0285}, {"x": 0.002})
    samples = bench.run_until(IDLE)
    assert len(begin) == 0
    speed = np.abs(np.diff(samples.command[:, 0])) / np.diff(samples.device_time_s)
    assert speed.max() <= 0.002 * (1 + 1e-6)


def test_velocity_ends_with_its_lease_and_without_a_fault(bench):
    for _ in range(5):
        bench.driver.move_velocity({"x": 0.005, "zn": 1e-5}, 0.15)
        bench.run(0.05)
    assert bench.driver.status().state is MOVING
    samples = bench.run_until(IDLE)
    assert samples.device_time_s[-1] - samples.device_time_s[0] < 0.25
    assert bench.driver.status().fault is None


def test_a_later_velocity_takes_the_place_of_one_that_was_not_said_yet(bench):
    for speed in (0.001, 0.002, 0.003, 0.004, 0.0):
        bench.driver.move_velocity({"x": speed}, 0.15)
    said = [data for _, data in bench.ports[0].written]
    bench.run(0.05)
    assert len(bench.ports[0].written) - len(said) <= 5
    bench.run_until(IDLE)


@pytest.mark.parametrize(
    ("axis", "start", "distance", "unit"),
    [("x", 0.0275, 4e-4, "m"), ("zn", 20e-6, 20e-6, "m"), ("thx", 2e-4, 3e-4, "rad")],
)
def test_playing_records_exactly_the_commands_asked(bench, axis, start, distance, unit):
    trajectory = there_and_back(axis, start, distance, 0.005, unit=unit)
    bench.driver.play(trajectory)
    assert bench.driver.status().state is PLAYING
    samples = bench.run_until(IDLE, MOVING)
    own = samples.playback_row >= 0
    np.testing.assert_array_equal(samples.playback_row[own], np.arange(81))
    column = bench.driver.axes.index(axis)
    asked = trajectory.signal(axis, Tap.CMD)
    _, board_axis = bench.driver._running.board_of(axis)
    rounded = [board_axis.value(board_axis.steps(one)) for one in asked]
    np.testing.assert_array_equal(samples.command[own, column], rounded)
    np.testing.assert_allclose(np.diff(samples.device_time_s[own]), 0.005, atol=2e-6)
    assert bench.driver.status().progress == 1.0
    others = np.delete(samples.command, column, axis=1)
    assert (others == others[0]).all()
    assert bench.driver.link_quality().repeated == 0


@pytest.mark.parametrize(
    ("baud", "period_s", "round_s"), [(125_000, 0.02, 0.001), (9_600, 0.2, 0.01)]
)
def test_a_shared_bus_plays_too(robot, joined_bench, baud, period_s, round_s):
    bench = joined_bench(robot, ports=1, baud=baud)
    bench.driver.open()
    assert bench.driver.setpoint_period_s == period_s  # set-points share the bus with telemetry
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


@pytest.mark.parametrize("paced", [True, False])
def test_on_a_shared_bus_telemetry_and_captures_come_at_the_rates_announced(
    robot, joined_bench, paced
):
    bench = joined_bench(robot, ports=1, paced=paced)
    bench.driver.open()
    assert np.median(np.diff(bench.run(0.3).device_time_s)) == pytest.approx(0.01, abs=1e-6)
    bench.driver.capture(["zn"], bench.driver.capture_rates.one_hz, 100)
    parts = []
    while not (parts and parts[-1].complete):
        bench.run(0.001)
        parts += [part] if (part := bench.driver.captured()) is not None else []
    assert sum(len(part.measured) for part in parts) == 100
    assert np.median(np.diff(bench.run(0.3).device_time_s)) == pytest.approx(0.01, abs=1e-6)


def test_faster_rows_act_at_the_next_instant_and_slower_ones_are_held(bench):
    time_s = np.array([0.0, 0.001, 0.004, 0.012, 0.013, 0.050])
    command = 2e-5 + 1e-9 * np.arange(6)
    record = Record.from_signals(time_s, {("zn", Tap.CMD): command}, {"zn": "m"})
    bench.driver.play(record)
    samples = bench.run_until(IDLE, MOVING)
    own = samples.playback_row >= 0
    assert samples.playback_row[own].tolist() == [0, 2, 4, 5]


def test_rows_of_which_two_would_act_at_once_are_refused_before_anything_moves(bench):
    """At 9.9 mm/s and 4.9 ms a row is 48.5 µm; an axis goes 50 µm between two set-points."""
    time_s = 4.9e-3 * np.arange(200)
    speed = 9.9e-3 * np.clip(np.minimum(time_s, time_s[-1] - time_s) / 0.1, 0.0, 1.0)
    command = 0.02 + 4.9e-3 * np.cumsum(speed)
    record = Record.from_signals(time_s, {("x", Tap.CMD): command}, {"x": "m"})
    bench.driver.accept(record)  # its speeds are right
    said = r"axis x: .* t = [\d.]+ s lie 97[\d.]* µm apart, beyond the limit 50\.1 µm in 5 ms; give"
    with pytest.raises(LimitError, match=said):
        bench.driver.play(record)
    assert_nothing_moves(bench)


def test_set_points_that_no_segment_can_tell_are_refused_before_anything_moves(bench, monkeypatch):
    monkeypatch.setattr(segment_player, "MOST_WAY", 100)
    with pytest.raises(LimitError, match=r"axis x: .* beyond the limit 10 µm in 5 ms"):
        bench.driver.play(there_and_back("x", 0.0277, 4e-4, 0.005))
    monkeypatch.undo()
    assert_nothing_moves(bench)


def assert_nothing_moves(bench):
    assert bench.driver.status().state is IDLE
    samples = bench.run(0.1)
    assert (samples.command == samples.command[0]).all()
    bench.driver.play(there_and_back("zn", 2e-5, 1e-6, 0.005, rows=3))  # another one may
    assert bench.driver.status().state is PLAYING


@pytest.mark.parametrize("after_s", [0.004, 0.06, 0.13, 0.3])
def test_stop_ends_a_trajectory_in_any_phase(bench, after_s):
    bench.driver.play(there_and_back("x", 0.0277, 4e-4, 0.005))
    bench.run(after_s)
    assert bench.driver.status().state is PLAYING
    bench.driver.stop()
    samples = bench.run_until(IDLE)
    later = bench.run(0.3)
    assert (later.command == samples.command[-1]).all()
    assert (later.playback_row == -1).all()
    assert bench.driver.status().progress < 1.0
    bench.driver.move_to({"x": 0.0276})
    assert bench.run_until(IDLE).command[-1, 0] == pytest.approx(0.0276, abs=1e-15)
    bench.driver.play(there_and_back("x", 0.0277, 4e-4, 0.005))
    assert bench.run_until(IDLE, MOVING).playback_row.max() == 80


def test_stop_twice_in_mid_move_and_move_at_once(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.2)
    bench.driver.stop()
    bench.driver.stop()
    bench.driver.move_to({"x": 0.0275})
    assert bench.driver.status().state is MOVING
    samples = bench.run_until(IDLE)
    assert samples.command[-1, 0] == pytest.approx(0.0275, abs=1e-15)
    assert samples.command[:, 0].max() < 0.031


@pytest.mark.parametrize("ports", [1, 2])
def test_a_stop_takes_less_than_5_ms_with_the_line_saturated(robot, ports, joined_bench):
    bench = joined_bench(robot, ports=ports, settings={"settle_s": 0.0})
    bench.driver.open()
    period_s = bench.driver.setpoint_period_s
    trajectory = bench.driver.accept(there_and_back("x", 0.0275, 4e-4, period_s, rows=4000))
    generator = np.random.default_rng(3)
    latencies = []
    for _ in range(6):
        bench.driver.play(trajectory)
        bench.run(0.08 + 10 * period_s + 0.001 * int(generator.integers(20)))
        bench.clock.advance(float(generator.uniform(0, 1e-3)))
        asked_s, told_s = bench.clock() - bench.begin_s, bench.driver.link_quality().stop_s
        bench.boards.notes.taken()
        bench.driver.stop()
        bench.run_until(IDLE, round_s=0.002)
        heard = {}
        for event in bench.boards.notes.taken():
            if event.text.endswith("stop heard"):
                heard.setdefault(event.text, event.at_s - asked_s)
        assert len(heard) == 2
        assert max(heard.values()) <= told_s + 1e-6
        latencies += heard.values()
    assert max(latencies) <= 0.005


def test_a_stop_that_nobody_asked_for_is_a_fault(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.1)
    bench.boards.lines[0].receive(b"\0\0", bench.clock() - bench.begin_s)
    bench.run_until(DeviceState.FAULT)
    assert "that this program did not send" in bench.driver.status().fault
    with pytest.raises(StateError, match="clear"):
        bench.driver.move_to({"x": 0.03})
    bench.run(0.3)
    bench.driver.clear_fault()
    bench.run_until(IDLE)
    bench.driver.move_to({"x": 0.029})
    bench.run_until(IDLE)


def test_homing_makes_the_position_known(robot, joined_bench):
    bench = joined_bench(robot, position_known=False, start_fraction=0.05)
    bench.driver.open()
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


def test_a_homing_that_is_stopped_leaves_the_position_unknown(bench):
    bench.driver.home(["x"])
    bench.run(0.2)
    bench.driver.stop()
    bench.run_until(IDLE)
    status = bench.driver.status()
    assert (status.position_known, status.unhomed) == (False, ("x",))
    with pytest.raises(StateError, match="home first"):
        bench.driver.move_to({"y": 0.03})
    bench.driver.home(["x"])
    bench.run_until(IDLE, round_s=0.002)
    assert bench.driver.status().position_known


def test_a_capture_is_whole_and_on_the_samples_clock(bench):
    bench.driver.move_to({"zn": 50e-6})
    bench.driver.capture(["zn"], 2000.0, 400)
    parts = []
    for _ in range(60):
        bench.run(0.01)
        if (part := bench.driver.captured()) is not None:
            parts.append(part)
    assert parts[-1].complete
    assert parts[-1].lost == 0
    time_s = np.concatenate([part.device_time_s for part in parts])
    measured = np.concatenate([part.measured for part in parts])
    assert measured.shape == (400, 1)
    np.testing.assert_allclose(np.diff(time_s), 5e-4, atol=1e-7)
    assert measured[-1, 0] == pytest.approx(50e-6, abs=1e-7)
    samples = bench.run(0.1)
    assert len(samples) == pytest.approx(20, abs=1)


def test_captures_refuse_what_boards_cannot(bench):
    with pytest.raises(LimitError, match="one board"):
        bench.driver.capture(["x", "zn"], 100.0, 10)
    with pytest.raises(LimitError, match="at least"):
        bench.driver.capture(["x"], 1.0, 10)


def test_a_profile_runs_once_it_is_triggered(bench):
    with pytest.raises(StateError, match="no profile"):
        bench.driver.trigger()
    begin = bench.driver._commanded("zn")
    up = ProfileSegment(0.1, 0.0, 3e-6, -2e-6)
    down = ProfileSegment(0.1, 0.0, -3e-6, 2e-6)
    bench.driver.upload(Profile("zn", (up, down)))
    bench.driver.trigger()
    assert bench.driver.status().state is PLAYING
    samples = bench.run_until(IDLE)
    assert samples.command[:, 5].max() == pytest.approx(begin + 1e-6, abs=2e-9)
    assert samples.command[-1, 5] == pytest.approx(begin, abs=2e-9)


def test_a_voltage_is_put_out(bench):
    bench.driver.set_voltage("zn", 50.0)
    samples = bench.run_until(IDLE)
    assert samples.command[-1, 5] == pytest.approx(50.0 * 5e-7, abs=2e-9)


def test_text_and_inputs(bench):
    bench.driver.show(1, "hello")
    bench.boards.set_inputs((0, 2048, 4095), 0b10)
    bench.run(0.2)
    assert "hello" in bench.boards.lcd()[1]
    readings, buttons = bench.driver.analog_inputs()
    assert readings == pytest.approx((0.0, 0.5, 1.0), abs=1e-3)
    assert buttons == (False, True)


def test_other_parameters_are_refused_until_accepted_or_written(robot, joined_bench):
    bench = joined_bench(robot)
    bench.boards.boards[0].kept.write(2, 90_000)
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


def test_accepted_parameters_bind(robot, joined_bench):
    bench = joined_bench(robot)
    bench.boards.boards[0].kept.write(2, 10_000)
    bench.driver.open()
    bench.driver.accept_parameters()
    bench.driver.move_to({"x": 0.0277})
    samples = bench.run_until(IDLE)
    speed = np.abs(np.diff(samples.command[:, 0])) / np.diff(samples.device_time_s)
    assert speed.max() <= 0.001 * (1 + 1e-6)


def test_accepted_parameters_that_leave_no_voltage_refuse_one(robot, joined_bench):
    bench = joined_bench(robot)
    kept = bench.boards.boards[1].kept
    kept.write(2 * PER_AXIS + 5, kept[2 * PER_AXIS + 4])
    bench.driver.open()
    bench.driver.accept_parameters()
    with pytest.raises(StateError, match="the voltage of axis"):
        bench.driver.set_voltage("zn", 10.0)


def test_reopening_finds_it_at_rest(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.3)
    bench.driver.close()
    bench.clock.advance(2.0)
    bench.driver.open()
    assert bench.driver.status().state is IDLE
    assert bench.boards.boards[0].fault is Fault.NONE
    bench.driver.move_to({"x": 0.03})
    bench.run_until(IDLE)


def test_a_second_port_of_one_board_is_refused(robot, joined_bench):
    from rotemina.sim.robot.file import load_robot

    one = joined_bench(load_robot("picma"), ports=1, settings={"second_port": "second"})
    with pytest.raises(DriverError, match="second_port"):
        one.driver.open()


@pytest.mark.parametrize(("ports", "period_s"), [(2, 0.01), (1, 0.02)])
def test_a_chip_of_half_the_clock_plays_every_row_at_half_the_rate(
    robot, joined_bench, ports, period_s
):
    bench = joined_bench(robot, ports=ports, tick_s=1e-3)
    bench.driver.open()
    assert bench.driver.setpoint_period_s == period_s
    assert bench.driver.capture_rates.of(1) == 1000.0
    time_s = np.arange(61) * period_s
    wave = 30e-6 + 2e-6 * np.sin(2 * np.pi * time_s)
    path = Record.from_signals(time_s, {("zn", Tap.CMD): wave}, {"zn": "m"})
    bench.driver.play(path)
    samples = bench.run_until(IDLE)
    assert bench.driver.status().fault is None
    own = samples.playback_row >= 0
    np.testing.assert_array_equal(samples.playback_row[own], np.arange(61))
    np.testing.assert_allclose(samples.command[own, 5], wave, atol=5.1e-10)
