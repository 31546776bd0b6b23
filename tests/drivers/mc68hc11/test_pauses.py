"""Nothing resumes after a pause of the program, as on a suspended computer."""

import numpy as np
import pytest

from rotemina.drivers.contract import DeviceState, StateError
from rotemina.drivers.mc68hc11.connection import MAX_PAUSE_S

IDLE, FAULT = DeviceState.IDLE, DeviceState.FAULT


@pytest.fixture
def ports():
    return 2


@pytest.fixture
def bench(ports, robot, make_bench):
    # The boards' watchdog is longer than the pause, so only the driver can react.
    bench = make_bench(robot, ports=ports, settings={"watchdog_s": 10.0})
    bench.driver.open()
    bench.run(0.1)
    yield bench
    bench.driver.close()


on_both_kinds_of_lines = pytest.mark.parametrize("ports", [2, 1], ids=["two lines", "shared bus"])


def play(bench):
    bench.driver.play(bench.make_wave(2000))


def move(bench):
    bench.driver.move_to({"x": 0.05})


def stop_and_move(bench):
    bench.driver.move_to({"x": 0.05})
    bench.run(0.2)
    bench.driver.stop()
    bench.driver.read()
    bench.driver.move_to({"x": 0.05})


def jog(bench):
    bench.driver.move_velocity({"x": 1e-3}, 0.4)


MOTIONS = {
    "a move": (move, 0.3),
    "a move without an answer so far": (move, 0.0),
    "a move that waits for a stop": (stop_and_move, 0.0),
    "a jog": (jog, 0.1),
    "the move to a trajectory": (play, 0.02),
    "the rest before a trajectory": (play, 0.22),
    "a trajectory": (play, 1.0),
}


@pytest.mark.parametrize(("start_motion", "after_s"), MOTIONS.values(), ids=MOTIONS.keys())
def test_no_motion_continues_after_a_pause(bench, start_motion, after_s):
    start_motion(bench)
    bench.run(after_s)
    bench.clock.advance(5.0)
    bench.run(0.2)
    commands = bench.run(0.6).command
    assert np.ptp(commands, axis=0).max() == 0.0
    status = bench.driver.status()
    assert status.state is FAULT
    assert "this program did not run for 5 s" in status.fault
    with pytest.raises(StateError, match="clear it"):
        bench.driver.move_to({"x": 0.04})
    bench.driver.clear_fault()
    bench.driver.move_to({"x": 0.0285})
    samples = bench.run_until(IDLE)
    assert samples.command[-1, 0] == pytest.approx(0.0285, abs=1e-15)


@on_both_kinds_of_lines
def test_a_pause_at_rest_is_no_fault_and_the_next_move_starts(bench):
    bench.clock.advance(5.0)
    bench.driver.move_to({"x": 0.0285})
    samples = bench.run_until(IDLE)
    assert samples.command[-1, 0] == pytest.approx(0.0285, abs=1e-15)


@on_both_kinds_of_lines
def test_a_short_pause_cancels_nothing(bench):
    bench.driver.move_to({"x": 0.0285})
    bench.run(0.05)
    bench.clock.advance(0.9 * MAX_PAUSE_S)
    samples = bench.run_until(IDLE)
    assert samples.command[-1, 0] == pytest.approx(0.0285, abs=1e-15)
