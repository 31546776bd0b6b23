"""A command beyond a limit of an axis never reaches the line, even if no upper layer checks it."""

import numpy as np
import pytest

from rotemina.drivers.contract import DeviceState, LimitError
from rotemina.drivers.mc68hc11 import UNITS_PER_STEP
from rotemina.drivers.mc68hc11.profile_upload import make_segment_messages
from rotemina.drivers.mc68hc11.protocol import (
    BeginProfile,
    BeginStream,
    FrameDecoder,
    LoadSegments,
    MoveTo,
    MoveVelocity,
    QuadraticSegment,
    SerialFrame,
    StreamSegment,
    TriggerProfile,
    encode_frame,
)
from rotemina.drivers.mc68hc11.segment_player import SegmentPlayer
from rotemina.drivers.mc68hc11.wire_guard import LineGuard, StepLimits, WireGuard

LIMITS = {0: StepLimits("x", -100, 100, 50), 1: StepLimits("y", 0, 1000, 500)}
IDLE, FAULT = DeviceState.IDLE, DeviceState.FAULT


@pytest.fixture
def guard():
    guard = LineGuard()
    guard.add(1, WireGuard(LIMITS, lambda: (90, 10)))
    return guard


def check_messages(guard, *messages):
    for message in messages:
        guard.check(encode_frame(SerialFrame(1, 7, message.TYPE, message.pack())))


def make_stream(*segments, hold=10):
    yield BeginStream(0, len(segments), hold, fraction=0)
    for index, (rows, differences) in enumerate(segments):
        yield StreamSegment.from_differences(index % 256, rows * hold, differences)


ALLOWED = {
    "the ends": [MoveTo(0, 100, 50), MoveTo(0, -100, 50)],
    "the top speed": [MoveVelocity(0, -50, 100)],
    "a stream to the end": make_stream((2, [(5, 0), (0, 0)]), (2, [(-1, 0), (0, 0)])),
    # Up by 4, 3, 2, 1, 0, -1: the highest command is at the end of the range.
    "a stream that turns": make_stream((6, [(5, -1), (0, 0)])),
    "a profile to the end": [
        *make_segment_messages(0, [QuadraticSegment(10, UNITS_PER_STEP, 0)], 0),
        TriggerProfile(),
    ],
    "another board": [],
}
REFUSED = {
    "a target": ([MoveTo(0, 101, 50)], "101 steps is outside its range -100 to 100"),
    "a speed of a move": ([MoveTo(0, 0, 51)], "51 steps/s is above its limit 50"),
    "a jog": ([MoveVelocity(1, -501, 100)], "-501 steps/s is above its limit 500"),
    "an axis": ([MoveTo(2, 0, 1)], "axis 2, which the board does not have"),
    "a set-point": (make_stream((1, [(11, 0), (0, 0)])), "101 steps"),
    "a sum of set-points": (make_stream(*[(2, [(3, 0), (0, 0)])] * 2), "102 steps"),
    "the turning point inside a segment": (make_stream((11, [(6, -1), (0, 0)])), "105 steps"),
    "a set-point without a stream": (
        [StreamSegment.from_differences(3, 10, [(0, 0)] * 2)],
        "its start position is unknown",
    ),
    "a profile": (
        [*make_segment_messages(0, [QuadraticSegment(11, UNITS_PER_STEP, 0)], 0), TriggerProfile()],
        "101 steps",
    ),
    "a profile of two parts": (
        [
            BeginProfile(1, 2),
            LoadSegments.from_segments(0, [QuadraticSegment(5, -UNITS_PER_STEP, 0)]),
            LoadSegments.from_segments(1, [QuadraticSegment(6, -UNITS_PER_STEP, 0)]),
            TriggerProfile(),
        ],
        "-1 steps",
    ),
}


@pytest.mark.parametrize("messages", ALLOWED.values(), ids=ALLOWED.keys())
def test_commands_up_to_the_limits_pass(guard, messages):
    check_messages(guard, *messages)
    guard.check(encode_frame(SerialFrame(2, 7, MoveTo.TYPE, MoveTo(0, 999, 999).pack())))


@pytest.mark.parametrize(("messages", "match"), REFUSED.values(), ids=REFUSED.keys())
def test_commands_beyond_a_limit_are_refused(guard, messages, match):
    with pytest.raises(LimitError, match=match):
        check_messages(guard, *messages)


def test_repeated_segments_are_checked_from_their_start_position(guard):
    segments = list(make_stream(*[(1, [(1, 0), (0, 0)])] * 300))
    with pytest.raises(LimitError, match="101 steps"):
        check_messages(guard, *segments)
    begin, *setpoints = list(make_stream(*[(1, [(1, 0), (0, 0)])] * 10))
    check_messages(guard, begin, *setpoints, *setpoints[4:], *setpoints[7:])


def find_written_messages(bench, kind):
    return [
        kind.unpack(frame.payload)
        for port in bench.ports
        for _, data in port.written
        for frame in FrameDecoder(is_board=True).feed(data)
        if frame.type == kind.TYPE
    ]


@pytest.mark.parametrize(
    "order",
    [MoveTo(0, 1 << 24, 1000), MoveVelocity(0, 32_000_000, 100)],
    ids=["target", "speed"],
)
def test_an_unchecked_order_is_not_written_and_stops_the_driver(bench, caplog, order):
    bench.driver.move_to({"y": 0.03})
    bench.run(0.05)
    board = bench.driver._open_session.boards[0]
    board.orders.queue_order("unchecked", order, permit=bench.driver.gate.permit())
    bench.run(0.01)
    status = bench.driver.status()
    assert "a motion was not sent: axis x" in status.fault
    assert "a frame was held back" in caplog.text
    bench.run(1.0)
    assert order not in find_written_messages(bench, type(order))
    assert bench.driver.status().state is FAULT
    commands = bench.run(0.1).command
    assert np.ptp(commands, axis=0).max() == 0.0
    bench.driver.clear_fault()
    bench.driver.move_to({"x": 0.029})
    bench.run_until(IDLE)


def test_a_trajectory_that_leaves_the_range_ends_at_its_limit(bench, monkeypatch):
    find_steps = SegmentPlayer._find_steps

    def find_wrong_steps(player, b, instant):
        steps = find_steps(player, b, instant)
        return tuple(step + (2_000_000 if instant > 200 else 0) for step in steps)

    monkeypatch.setattr(SegmentPlayer, "_find_steps", find_wrong_steps)
    bench.driver.play(bench.make_wave(1000))
    samples = bench.run(2.0)
    assert "is outside its range" in bench.driver.status().fault
    assert np.ptp(samples.command[:, bench.driver.axes.index("zn")]) < 1e-4
