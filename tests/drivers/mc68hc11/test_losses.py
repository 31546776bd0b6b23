"""The driver on lines that lose, change and double bytes, are cut, and on boards that are reset."""

import numpy as np
import pytest

from rotemina.drivers.errors import ConnectionLostError, DeviceResetError, StateError
from rotemina.drivers.mc68hc11.protocol_codes import Fault
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.drivers.virtual_board.clock import BoardClock
from rotemina.sim.records.record import Record, Tap

IDLE, MOVING, FAULT = DeviceState.IDLE, DeviceState.MOVING, DeviceState.FAULT


@pytest.fixture
def bench(robot, joined_bench):
    made = joined_bench(robot)
    made.driver.open()
    made.run(0.05)
    yield made
    made.driver.close()


def cut(bench, *, off=True):
    for port in bench.ports:
        port.cut = off


def hold(axis, at, rows=2000):
    time_s = np.arange(rows) * 0.005
    wave = 1e-6 * np.sin(2 * np.pi * time_s)
    return Record.from_signals(time_s, {(axis, Tap.CMD): at + wave}, {axis: "m"})


def test_a_short_loss_is_masked_and_nothing_begins_to_move(bench):
    bench.driver.move_to({"x": 0.0285})
    bench.run(0.05)
    cut(bench)
    samples = bench.run(0.2)
    assert len(samples) <= 2
    status = bench.driver.status()
    assert 0.1 < status.silent_s < 0.25
    with pytest.raises(StateError, match="has been silent"):
        bench.driver.move_to({"y": 0.03})
    cut(bench, off=False)
    later = bench.run_until(IDLE)
    assert bench.driver.status().silent_s == 0.0
    assert later.command[-1, 0] == pytest.approx(0.0285, abs=1e-15)
    assert later.device_time_s[0] - samples.device_time_s[-1] > 0.15 if len(samples) else True


def test_a_long_loss_raises_and_nothing_resumes(bench):
    bench.driver.play(hold("zn", 30e-6))
    bench.run(0.5)
    cut(bench)
    with pytest.raises(ConnectionLostError, match="has not answered"):
        bench.run(1.0)
    status = bench.driver.status()
    assert (status.state, status.position_known) == (FAULT, False)
    said = len(bench.ports[1].written)
    cut(bench, off=False)
    for _ in range(100):
        bench.clock.advance(0.005)
        with pytest.raises(ConnectionLostError):
            bench.driver.read()
    assert len(bench.ports[1].written) == said
    bench.ports[1].read()
    assert not bench.boards.moving
    assert bench.boards.boards[1].fault is not Fault.NONE


def test_a_stream_that_starves_is_a_fault_and_both_boards_halt(bench):
    bench.driver.play(hold("zn", 30e-6))
    bench.run(0.8)
    cut(bench)
    bench.run(0.4)
    cut(bench, off=False)
    bench.run_until(FAULT)
    assert "set-point came too late" in bench.driver.status().fault
    bench.run(0.2)
    assert bench.driver.status().progress < 1.0
    bench.driver.clear_fault()
    bench.run_until(IDLE)
    bench.driver.move_to({"zn": 20e-6})
    assert bench.run_until(IDLE).command[-1, 5] == pytest.approx(20e-6, abs=1e-15)


def test_a_computer_that_is_busy_for_300_ms_cuts_no_playback_off(bench):
    bench.driver.play(hold("zn", 30e-6, rows=200))
    bench.run(0.35)  # at rest at the first row; set-points have begun to go out
    parts = []
    for _ in range(3):
        bench.clock.advance(0.3)
        parts.append(bench.run(0.3))
    samples = Samples.joined([*parts, bench.run_until(IDLE, MOVING, FAULT)], 6)
    assert bench.driver.status().fault is None
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(200))


def test_a_board_that_is_reset_in_mid_move_ends_the_connection(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.2)
    bench.boards.boards[0].reset(Fault.RESET)
    with pytest.raises(DeviceResetError, match="reset"):
        bench.run(1.0)
    assert not bench.driver.status().position_known
    bench.driver.close()
    bench.clock.advance(1.0)
    bench.driver.open()
    assert bench.driver.status().unhomed == ("x", "y", "z")


def test_the_boards_clock_turns_unseen(robot, joined_bench):
    bench = joined_bench(robot)
    for board in bench.boards.boards:
        board.clock = BoardClock(bench.boards.tick_s, (1 << 32) - 1_000_000)
    bench.driver.open()
    samples = bench.run(1.5)
    np.testing.assert_allclose(np.diff(samples.device_time_s), 0.005, atol=2e-6)
    bench.driver.move_to({"zn": 40e-6})
    bench.run_until(IDLE)


def noise(generator, share):
    """Return a line that changes, drops and doubles a share of its bytes."""

    def passed(data):
        out = bytearray()
        for byte in data:
            kind = generator.random() / share
            if kind < 0.4:
                out.append(int(generator.integers(256)))
            elif kind < 0.7:
                continue
            elif kind < 1.0:
                out += bytes((byte, byte))
            else:
                out.append(byte)
        return bytes(out)

    return passed


def watched(bench):
    """Count how often each target is executed."""
    executed = {}
    for board in bench.boards.boards:
        for axis, drive in enumerate(board.drives):

            def counted(target, speed, key=(board.number, axis), then=drive.move_to):
                executed[(*key, target)] = executed.get((*key, target), 0) + 1
                then(target, speed)

            drive.move_to = counted
    return executed


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("ports", [1, 2])
def test_noise_repeats_no_command_and_moves_nothing_after_a_stop(robot, seed, ports, joined_bench):
    bench = joined_bench(robot, ports=ports)
    bench.driver.open()
    executed = watched(bench)
    generator = np.random.default_rng(seed)
    for port in bench.ports:
        port.to_board = noise(generator, 0.004)
        port.to_host = noise(generator, 0.004)
    targets = 0.0275 + 1e-6 * generator.permutation(1000)[:8]
    low, high = robot.axes["x"].range
    for target in targets:
        asked(bench, float(target))
        samples = bench.run(float(generator.uniform(0.01, 0.1)))
        bench.driver.stop()
        bench.run(0.2)
        still = bench.run(0.2)
        assert (still.command == still.command[:1]).all()
        for part in (samples, still):
            assert ((part.command[:, 0] >= low) & (part.command[:, 0] <= high)).all()
    assert executed
    assert max(executed.values()) == 1
    assert bench.driver.link_quality().rejected > 0


def asked(bench, target):
    """Ask for a move; a stop that the noise made up is cleared first."""
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


@pytest.mark.parametrize("seed", range(3))
def test_a_playback_survives_lost_frames(robot, seed, joined_bench):
    bench = joined_bench(robot)
    bench.driver.open()
    generator = np.random.default_rng(seed)

    def loses(data):
        # Whole frames, so that no stop is made up by the end of one and that of the next.
        return b"" if generator.random() < 0.02 else data

    bench.ports[1].to_board = loses
    bench.driver.play(hold("zn", 30e-6, rows=200))
    samples = bench.run_until(IDLE, MOVING, FAULT)
    assert bench.driver.status().fault is None
    rows = samples.playback_row[samples.playback_row >= 0]
    np.testing.assert_array_equal(rows, np.arange(200))
    assert bench.driver.link_quality().repeated > 0


def test_lost_telemetry_leaves_gaps_and_invents_nothing(bench):
    generator = np.random.default_rng(5)
    bench.ports[0].to_host = lambda data: b"" if generator.random() < 0.03 else data
    bench.driver.play(hold("zn", 30e-6, rows=300))
    samples = bench.run_until(IDLE, MOVING, FAULT)
    own = samples.playback_row >= 0
    rows = samples.playback_row[own]
    assert 150 < len(rows) < 300
    asked_for = hold("zn", 30e-6, rows=300).signal("zn", Tap.CMD)[rows]
    np.testing.assert_allclose(samples.command[own, 5], asked_for, atol=5.1e-10)
    assert (np.diff(rows) > 0).all()
    since = samples.device_time_s[own] - samples.device_time_s[own][0]
    np.testing.assert_allclose(since, (rows - rows[0]) * 0.005, atol=2e-6)


def test_boards_whose_quartzes_differ_stay_in_step(robot, joined_bench):
    bench = joined_bench(robot, crystal_ppm=(200.0, -200.0))
    bench.driver.open()
    bench.run(18.0, round_s=0.02)
    first, second = bench.driver._running.boards
    number = first.number_at(bench.clock())
    true_s = [
        bench.boards.boards[at].clock.tick_at(board.grid.time_us(number) % (1 << 32), 0)
        for at, board in enumerate((first, second))
    ]
    assert abs(true_s[0] - true_s[1]) * bench.boards.tick_s < 0.005
    assert len(bench.run(0.5)) > 90


def test_a_port_that_is_gone_leaves_no_other_board_moving_or_port_open(robot, joined_bench):
    bench = joined_bench(robot)
    bench.driver.open()
    bench.run(0.05)
    first, second = bench.ports

    def gone(_data):
        raise ConnectionLostError("first: the port has disappeared")

    first.write = gone
    said = len(second.written)
    with pytest.raises(ConnectionLostError, match="disappeared"):
        bench.driver.close()
    assert second.written[said][1].startswith(b"\0\0")
    assert (first.closed, second.closed) == (True, True)
