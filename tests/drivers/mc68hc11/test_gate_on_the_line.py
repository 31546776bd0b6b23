"""After a stop, no motion that was requested before it reaches the line."""

import numpy as np
import pytest

from rotemina.drivers.contract import DeviceState, GateError, StateError
from rotemina.drivers.mc68hc11.protocol import (
    ArmProfile,
    BeginStream,
    BoardFault,
    ClearFault,
    FrameDecoder,
    HomeAxes,
    MoveTo,
    MoveVelocity,
    SetVoltage,
    StreamSegment,
    TriggerProfile,
    WriteParameter,
)
from rotemina.sim.records import Record, Tap

MOTION_TYPES = {
    message.TYPE
    for message in (
        ArmProfile,
        BeginStream,
        ClearFault,
        HomeAxes,
        MoveTo,
        MoveVelocity,
        StreamSegment,
        SetVoltage,
        TriggerProfile,
        WriteParameter,
    )
}
IDLE = DeviceState.IDLE


class LineRecord:
    """The types of the frames that the host has written, from now on or since the start."""

    def __init__(self, bench, *, from_start=False):
        self._bench = bench
        self._begin = [0 if from_start else len(port.written) for port in bench.ports]

    @property
    def types(self):
        return {
            frame.type
            for port, begin in zip(self._bench.ports, self._begin, strict=True)
            for _, data in port.written[begin:]
            for frame in FrameDecoder().feed(data)
        }


def stop_between_decision_and_write(bench, monkeypatch):
    """Let a stop reach the gate when the next frame has been chosen and is not written yet."""
    for link in bench.driver._open_session.links:
        choose_next_frame = link._choose_next_frame

        def choose_and_stop(now_s, choose_next_frame=choose_next_frame):
            choice = choose_next_frame(now_s)
            if choice is not None and choice[1].permit is not None:
                bench.driver.gate.stop()
            return choice

        monkeypatch.setattr(link, "_choose_next_frame", choose_and_stop)


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
def test_a_frame_requested_before_a_stop_is_not_written(bench, monkeypatch, name):
    line = LineRecord(bench)
    stop_between_decision_and_write(bench, monkeypatch)
    REQUESTS[name](bench.driver)
    samples = bench.run(0.3)
    assert not line.types & MOTION_TYPES
    assert (np.ptp(samples.command, axis=0) == 0.0).all()


def test_no_set_point_follows_a_stop_of_the_gate(bench):
    time_s = np.arange(401) * 0.005
    path = 0.0275 + 2e-4 * np.sin(np.pi * time_s)
    bench.driver.play(Record.from_signals(time_s, {("x", Tap.CMD): path}, {"x": "m"}))
    line = LineRecord(bench)
    bench.run(0.6)
    assert StreamSegment.TYPE in line.types
    # The gate is closed, but the boards have not received the stop yet.
    bench.driver.gate.stop()
    line = LineRecord(bench)
    bench.run(0.05)
    assert not line.types & MOTION_TYPES
    bench.driver.halt()
    bench.run_until(IDLE)


def test_a_latched_stop_blocks_clearing_faults_and_motion(bench):
    driver = bench.driver
    driver.move_to({"x": 0.03})
    bench.run(0.1)
    driver.gate.stop("emergency stop")
    driver.halt()
    line = LineRecord(bench)
    for request in (*REQUESTS.values(), lambda driver: driver.clear_fault()):
        with pytest.raises((GateError, StateError)):
            request(driver)
    bench.run(0.5)
    assert not line.types & MOTION_TYPES
    driver.gate.release()
    driver.move_to({"x": 0.0285})
    samples = bench.run_until(IDLE)
    # The move after the release clears the fault of the stop.
    assert ClearFault.TYPE in line.types
    assert samples.command[-1, 0] == pytest.approx(0.0285)


@pytest.mark.parametrize(
    ("halt", "latch"),
    [
        (lambda driver: driver.abort(), "emergency stop"),
        (lambda driver: driver.move_velocity({"x": 0.0}, 0.15), None),
    ],
    ids=["abort", "speed 0"],
)
def test_a_halt_after_a_stop_clears_no_fault(bench, halt, latch):
    """Releasing a stick or a key must not enable motion again."""
    driver = bench.driver
    driver.move_to({"x": 0.03})
    bench.run(0.1)
    driver.gate.stop(latch)
    driver.halt()
    bench.run_until(IDLE)
    line = LineRecord(bench)
    halt(driver)
    bench.run(0.5)
    assert not line.types & MOTION_TYPES


@pytest.mark.parametrize("fault", [BoardFault.STOPPED, BoardFault.RESET])
def test_opening_with_a_latched_stop_keeps_the_faults_of_the_boards(robot, make_bench, fault):
    bench = make_bench(robot)
    for board in bench.boards.boards:
        board.fault = fault
    driver = bench.driver
    driver.gate.stop("emergency stop")
    driver.open()
    bench.run(0.3)
    assert ClearFault.TYPE not in LineRecord(bench, from_start=True).types
    assert driver.status().state is DeviceState.FAULT
    with pytest.raises(GateError):
        driver.clear_fault()
    driver.gate.release()
    driver.clear_fault()
    bench.run_until(IDLE)
    driver.move_to({"x": 0.028})
    bench.run_until(IDLE)
    driver.close()


def test_parameters_must_be_written_again_after_a_stop_during_writing(robot, make_bench):
    bench = make_bench(robot)
    bench.boards.boards[0].parameters.write(2, 90_000)
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
