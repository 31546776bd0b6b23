"""What frames reach the line after a stop: none that moves anything was asked for before it."""

import numpy as np
import pytest

from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import GateError
from rotemina.drivers.mc68hc11.framing import Decoder
from rotemina.drivers.mc68hc11.host_messages import (
    ArmProfile,
    BeginStream,
    ClearFault,
    Home,
    MoveTo,
    MoveVelocity,
    SetPoint,
    SetVoltage,
    TriggerProfile,
    WriteParameter,
)
from rotemina.drivers.mc68hc11.protocol_codes import Fault
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

MOVING = {
    one.TYPE
    for one in (
        ArmProfile,
        BeginStream,
        ClearFault,
        Home,
        MoveTo,
        MoveVelocity,
        SetPoint,
        SetVoltage,
        TriggerProfile,
        WriteParameter,
    )
}
IDLE = DeviceState.IDLE


@pytest.fixture
def bench(robot, joined_bench):
    made = joined_bench(robot)
    made.driver.open()
    made.run(0.1)
    yield made
    made.driver.close()


class Line:
    """The types of the frames that the host has written since, or ever."""

    def __init__(self, bench, *, ever=False):
        self._bench = bench
        self._begin = [0 if ever else len(port.written) for port in bench.ports]

    @property
    def types(self):
        return {
            frame.type
            for port, begin in zip(self._bench.ports, self._begin, strict=True)
            for _, data in port.written[begin:]
            for frame in Decoder().feed(data)
        }


def stop_between_decision_and_write(bench, monkeypatch):
    """Let a stop reach the gate when the next frame has been chosen and is not written yet."""
    for link in bench.driver._running.links:
        inner = link._next

        def later(now_s, inner=inner):
            chosen = inner(now_s)
            if chosen is not None and chosen[1].permit is not None:
                bench.driver.gate.stop()
            return chosen

        monkeypatch.setattr(link, "_next", later)


REQUESTS = {
    "move_to": lambda driver: driver.move_to({"x": 0.05, "zn": 40e-6}),
    "move_velocity": lambda driver: driver.move_velocity({"x": 0.005}, 0.15),
    "home": lambda driver: driver.home(("x",)),
    "set_voltage": lambda driver: driver.set_voltage("zn", 70.0),
    "play": lambda driver: driver.play(
        Record.from_signals([0.0, 1.0], {("x", Tap.CMD): [0.03, 0.03]}, {"x": "m"})
    ),
}


@pytest.mark.parametrize("name", REQUESTS)
def test_a_frame_that_a_stop_overtakes_is_not_written(bench, monkeypatch, name):
    line = Line(bench)
    stop_between_decision_and_write(bench, monkeypatch)
    REQUESTS[name](bench.driver)
    samples = bench.run(0.3)
    assert not line.types & MOVING
    assert (np.ptp(samples.command, axis=0) == 0.0).all()


def test_no_set_point_follows_a_stop_not_even_before_the_driver_knows_of_it(bench):
    time_s = np.arange(401) * 0.005
    path = 0.0275 + 2e-4 * np.sin(np.pi * time_s)
    bench.driver.play(Record.from_signals(time_s, {("x", Tap.CMD): path}, {"x": "m"}))
    line = Line(bench)
    bench.run(0.6)
    assert SetPoint.TYPE in line.types
    bench.driver.gate.stop()  # the boards have yet to be told
    line = Line(bench)
    bench.run(0.05)
    assert not line.types & MOVING
    bench.driver.halt()
    bench.run_until(IDLE)


def test_while_a_stop_is_latched_no_fault_is_cleared_and_nothing_moves(bench):
    driver = bench.driver
    driver.move_to({"x": 0.03})
    bench.run(0.1)
    driver.gate.stop("emergency stop")
    driver.halt()
    line = Line(bench)
    for request in (*REQUESTS.values(), lambda one: one.clear_fault()):
        with pytest.raises((GateError, StateError)):
            request(driver)
    bench.run(0.5)
    assert not line.types & MOVING
    driver.gate.release()
    driver.move_to({"x": 0.0285})
    samples = bench.run_until(IDLE)
    assert ClearFault.TYPE in line.types  # of the stop, by the permit of what came after it
    assert samples.command[-1, 0] == pytest.approx(0.0285)


HALTS = {
    "abort": lambda driver: driver.abort(),
    "speed 0": lambda driver: driver.move_velocity({"x": 0.0}, 0.15),
}


@pytest.mark.parametrize(
    ("halt", "latch"), [("abort", None), ("abort", "emergency stop"), ("speed 0", None)]
)
def test_a_halt_after_a_stop_clears_no_fault(bench, halt, latch):
    """Nobody who only lets go of a stick, or of a key, asks that the boards may move again."""
    driver = bench.driver
    driver.move_to({"x": 0.03})
    bench.run(0.1)
    driver.gate.stop(latch)
    driver.halt()
    bench.run_until(IDLE)
    line = Line(bench)
    HALTS[halt](driver)
    bench.run(0.5)
    assert not line.types & MOVING


@pytest.mark.parametrize("fault", [Fault.STOPPED, Fault.WATCHDOG, Fault.RESET])
def test_while_a_stop_is_latched_boards_are_connected_with_their_faults(robot, joined_bench, fault):
    bench = joined_bench(robot)
    for board in bench.boards.boards:
        board.fault = fault
    driver = bench.driver
    driver.gate.stop("emergency stop")
    driver.open()
    bench.run(0.3)
    assert ClearFault.TYPE not in Line(bench, ever=True).types
    assert driver.status().state is DeviceState.FAULT
    with pytest.raises(GateError):
        driver.clear_fault()
    driver.gate.release()
    driver.clear_fault()
    bench.run_until(IDLE)
    driver.move_to({"x": 0.028})
    bench.run_until(IDLE)
    driver.close()


def test_a_stop_that_cuts_the_writing_of_parameters_off_leaves_them_to_be_written_again(
    robot, joined_bench
):
    bench = joined_bench(robot)
    bench.boards.boards[0].kept.write(2, 90_000)
    bench.driver.open()
    bench.driver.write_parameters()
    bench.driver.stop()
    bench.run(0.3)
    with pytest.raises(StateError, match="a stop interrupted the writing"):
        bench.driver.move_to({"x": 0.03})
    bench.driver.write_parameters()
    bench.run(0.3)
    assert bench.driver.differences == ()
    bench.driver.move_to({"x": 0.028})
    bench.run_until(IDLE)
    bench.driver.close()
