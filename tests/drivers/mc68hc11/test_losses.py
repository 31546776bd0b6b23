"""The driver with bad or cut lines, and with boards that are reset."""

import numpy as np
import pytest

from rotemina.drivers.contract import (
    ConnectionLostError,
    DeviceResetError,
    DeviceSamples,
    DeviceState,
    StateError,
)
from rotemina.drivers.mc68hc11.protocol import BoardFault
from rotemina.drivers.virtual_board.clock import CrystalClock
from rotemina.sim.records import Tap

IDLE, MOVING, FAULT = DeviceState.IDLE, DeviceState.MOVING, DeviceState.FAULT


def test_a_short_loss_is_tolerated_but_blocks_new_moves(bench):
    bench.driver.move_to({"x": 0.0285})
    samples = bench.run(0.05)
    bench.set_cut(True)
    assert len(bench.run(0.2)) <= 2
    status = bench.driver.status()
    assert 0.1 < status.silent_s < 0.25
    with pytest.raises(StateError, match="has been silent"):
        bench.driver.move_to({"y": 0.03})
    bench.set_cut(False)
    later_samples = bench.run_until(IDLE)
    assert bench.driver.status().silent_s == 0.0
    assert later_samples.command[-1, 0] == pytest.approx(0.0285, abs=1e-15)
    assert later_samples.device_time_s[0] - samples.device_time_s[-1] > 0.15


def test_after_a_long_loss_nothing_resumes(bench):
    bench.driver.play(bench.make_wave(2000))
    bench.run(0.5)
    bench.set_cut(True)
    with pytest.raises(ConnectionLostError, match="has not answered"):
        bench.run(1.0)
    status = bench.driver.status()
    assert (status.state, status.position_known) == (FAULT, False)
    write_count = len(bench.ports[1].written)
    bench.set_cut(False)
    for _ in range(100):
        bench.clock.advance(0.005)
        with pytest.raises(ConnectionLostError):
            bench.driver.read()
    assert len(bench.ports[1].written) == write_count
    bench.ports[1].read()
    assert not bench.boards.moving
    assert bench.boards.boards[1].fault is not BoardFault.NONE


def test_a_late_set_point_is_a_fault_that_stops_both_boards(bench):
    bench.driver.play(bench.make_wave(2000))
    bench.run(0.8)
    bench.set_cut(True)
    bench.run(0.4)
    bench.set_cut(False)
    bench.run_until(FAULT)
    assert "set-point came too late" in bench.driver.status().fault
    bench.run(0.2)
    assert bench.driver.status().progress < 1.0
    bench.driver.clear_fault()
    bench.run_until(IDLE)
    bench.driver.move_to({"zn": 20e-6})
    assert bench.run_until(IDLE).command[-1, 5] == pytest.approx(20e-6, abs=1e-15)


def test_a_playback_survives_a_program_that_is_busy_for_300_ms(bench):
    bench.driver.play(bench.make_wave(200))
    # The axis is at the first row, and the first set-points are sent.
    bench.run(0.35)
    portions = []
    for _ in range(3):
        bench.clock.advance(0.3)
        portions.append(bench.run(0.3))
    samples = DeviceSamples.join([*portions, bench.run_until(IDLE, MOVING, FAULT)], 6)
    assert bench.driver.status().fault is None
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(200))


def test_a_reset_of_a_board_during_a_move_ends_the_connection(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.2)
    bench.boards.boards[0].reset(BoardFault.RESET)
    with pytest.raises(DeviceResetError, match="reset"):
        bench.run(1.0)
    assert not bench.driver.status().position_known
    bench.driver.close()
    bench.clock.advance(1.0)
    bench.driver.open()
    assert bench.driver.status().unhomed == ("x", "y", "z")


def test_an_overflow_of_the_boards_clock_has_no_effect(robot, make_bench):
    bench = make_bench(robot)
    for board in bench.boards.boards:
        board.clock = CrystalClock(bench.boards.tick_s, (1 << 32) - 1_000_000)
    bench.driver.open()
    samples = bench.run(1.5)
    np.testing.assert_allclose(np.diff(samples.device_time_s), 0.005, atol=2e-6)
    bench.driver.move_to({"zn": 40e-6})
    bench.run_until(IDLE)


def make_noise(generator, probability):
    """Return a filter that changes, drops or doubles bytes with this probability."""

    def add_noise(data):
        noisy_data = bytearray()
        for byte in data:
            choice = generator.random() / probability
            if choice < 0.4:
                noisy_data.append(int(generator.integers(256)))
            elif choice < 0.7:
                continue
            elif choice < 1.0:
                noisy_data += bytes((byte, byte))
            else:
                noisy_data.append(byte)
        return bytes(noisy_data)

    return add_noise


def count_executions(bench):
    """Return a dictionary that counts how often each target is executed."""
    counts = {}
    for board in bench.boards.boards:
        for axis, drive in enumerate(board.drives):

            def count_and_move(target, speed, key=(board.number, axis), move_to=drive.move_to):
                counts[(*key, target)] = counts.get((*key, target), 0) + 1
                move_to(target, speed)

            drive.move_to = count_and_move
    return counts


@pytest.mark.parametrize("ports", [1, 2])
def test_noise_repeats_no_command_and_moves_nothing_after_a_stop(robot, ports, open_bench):
    bench = open_bench(ports=ports)
    execution_counts = count_executions(bench)
    generator = np.random.default_rng(ports)
    for port in bench.ports:
        port.to_board = make_noise(generator, 0.004)
        port.to_host = make_noise(generator, 0.004)
    targets = 0.0275 + 1e-6 * generator.permutation(1000)[:8]
    lower_limit, upper_limit = robot.axes["x"].range
    for target in targets:
        request_move(bench, float(target))
        samples = bench.run(float(generator.uniform(0.01, 0.1)))
        bench.driver.stop()
        bench.run(0.2)
        samples_at_rest = bench.run(0.2)
        assert (samples_at_rest.command == samples_at_rest.command[:1]).all()
        for portion in (samples, samples_at_rest):
            assert (
                (portion.command[:, 0] >= lower_limit) & (portion.command[:, 0] <= upper_limit)
            ).all()
    assert execution_counts
    assert max(execution_counts.values()) == 1
    assert bench.driver.link_quality().rejected > 0


def request_move(bench, target):
    """Request a move. Clear the fault of a stop that only the noise caused first."""
    for _ in range(20):
        if bench.driver.status().state is FAULT:
            bench.driver.clear_fault()
        try:
            bench.driver.move_to({"x": target})
        except StateError:
            bench.run(0.05)
        else:
            return
    raise AssertionError(bench.driver.status())


def test_a_playback_survives_lost_frames(bench):
    generator = np.random.default_rng(1)

    def drop_some_frames(data):
        # Whole frames are dropped, so that no two frame ends form a stop.
        return b"" if generator.random() < 0.02 else data

    bench.ports[1].to_board = drop_some_frames
    bench.driver.play(bench.make_wave(200))
    samples = bench.run_until(IDLE, MOVING, FAULT)
    assert bench.driver.status().fault is None
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(200))
    assert bench.driver.link_quality().repeated > 0


def test_lost_telemetry_leaves_gaps_and_no_wrong_samples(bench):
    generator = np.random.default_rng(5)
    bench.ports[0].to_host = lambda data: b"" if generator.random() < 0.03 else data
    bench.driver.play(bench.make_wave(300))
    samples = bench.run_until(IDLE, MOVING, FAULT)
    is_playback_row = samples.playback_row >= 0
    rows = samples.playback_row[is_playback_row]
    assert 150 < len(rows) < 300
    expected_commands = bench.make_wave(300).signal("zn", Tap.CMD)[rows]
    np.testing.assert_allclose(samples.command[is_playback_row, 5], expected_commands, atol=5.1e-10)
    assert (np.diff(rows) > 0).all()
    elapsed_s = samples.device_time_s[is_playback_row] - samples.device_time_s[is_playback_row][0]
    np.testing.assert_allclose(elapsed_s, (rows - rows[0]) * 0.005, atol=2e-6)


def test_boards_with_different_crystals_stay_synchronous(open_bench):
    bench = open_bench(crystal_ppm=(200.0, -200.0))
    bench.run(18.0, round_s=0.02)
    first, second = bench.driver._open_session.boards
    number = first.find_sample_number(bench.clock())
    true_s = [
        bench.boards.boards[index].clock.find_tick(board.grid.find_time_us(number) % (1 << 32), 0)
        for index, board in enumerate((first, second))
    ]
    assert abs(true_s[0] - true_s[1]) * bench.boards.tick_s < 0.005
    assert len(bench.run(0.5)) > 90


def test_a_lost_port_stops_the_other_board_and_closes_both_ports(bench):
    first, second = bench.ports

    def raise_connection_lost(_data):
        raise ConnectionLostError("first: the port has disappeared")

    first.write = raise_connection_lost
    write_count = len(second.written)
    with pytest.raises(ConnectionLostError, match="disappeared"):
        bench.driver.close()
    assert second.written[write_count][1].startswith(b"\0\0")
    assert (first.is_closed, second.is_closed) == (True, True)
