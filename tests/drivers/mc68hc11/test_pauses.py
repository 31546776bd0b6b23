"""A program that does not run for a while, as on a suspended computer: nothing resumes then."""

import numpy as np
import pytest

from rotemina.drivers.errors import StateError
from rotemina.drivers.mc68hc11.connection import MAX_PAUSE_S
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

IDLE, FAULT = DeviceState.IDLE, DeviceState.FAULT


@pytest.fixture
def ports():
    return 2


@pytest.fixture
def bench(ports, robot, joined_bench):
    # The boards wait longer for the host than the pause lasts: they are no help.
    made = joined_bench(robot, ports=ports, settings={"watchdog_s": 10.0})
    made.driver.open()
    made.run(0.1)
    yield made
    made.driver.close()


on_both_kinds_of_lines = pytest.mark.parametrize("ports", [2, 1], ids=["two lines", "shared bus"])


def play(bench):
    time_s = np.arange(2000) * 0.005
    signals = {("zn", Tap.CMD): 30e-6 + 1e-6 * np.sin(2 * np.pi * time_s)}
    bench.driver.play(Record.from_signals(time_s, signals, {"zn": "m"}))


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


BUSY = {
    "a move": (move, 0.3),
    "a move that nobody has answered": (move, 0.0),
    "a move that waits for a stop": (stop_and_move, 0.0),
    "a jog": (jog, 0.1),
    "the way to a trajectory": (play, 0.02),
    "the rest before a trajectory": (play, 0.22),
    "a trajectory": (play, 1.0),
}


@pytest.mark.parametrize(("begin", "after_s"), BUSY.values(), ids=BUSY.keys())
def test_after_a_pause_in_mid_motion_nothing_goes_on_by_itself(bench, begin, after_s):
    begin(bench)
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
def test_a_pause_at_rest_is_no_fault_and_a_move_right_after_it_begins(bench):
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
