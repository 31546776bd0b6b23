"""Commands that no upper layer has checked: none beyond a limit of an axis reaches the line."""

import numpy as np
import pytest

from rotemina.drivers.errors import LimitError
from rotemina.drivers.mc68hc11.framing import Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import (
    BeginProfile,
    BeginStream,
    MoveTo,
    MoveVelocity,
    Quadratic,
    Segments,
    SetPoint,
    TriggerProfile,
)
from rotemina.drivers.mc68hc11.profile_upload import FRACTION, profile_of
from rotemina.drivers.mc68hc11.segment_player import Player
from rotemina.drivers.mc68hc11.wire_guard import LineGuard, StepLimits, WireGuard
from rotemina.drivers.samples import DeviceState
from rotemina.sim.records.record import Record, Tap

LIMITS = {0: StepLimits("x", -100, 100, 50), 1: StepLimits("y", 0, 1000, 500)}
IDLE, FAULT = DeviceState.IDLE, DeviceState.FAULT


@pytest.fixture
def bench(robot, joined_bench):
    made = joined_bench(robot)
    made.driver.open()
    made.run(0.1)
    yield made
    made.driver.close()


@pytest.fixture
def guard():
    made = LineGuard()
    made.add(1, WireGuard(LIMITS, lambda: (90, 10)))
    return made


def say(guard, *messages):
    for message in messages:
        guard.check(encoded(Frame(1, 7, message.TYPE, message.packed())))


def stream(*segments, hold=10):
    yield BeginStream(0, len(segments), hold, fraction=0)
    for index, (rows, differences) in enumerate(segments):
        yield SetPoint.of(index % 256, rows * hold, differences)


ALLOWED = {
    "the ends": [MoveTo(0, 100, 50), MoveTo(0, -100, 50)],
    "the top speed": [MoveVelocity(0, -50, 100)],
    "a stream to the end": stream((2, [(5, 0), (0, 0)]), (2, [(-1, 0), (0, 0)])),
    # Up by 4, 3, 2, 1, 0, -1: the highest command is at the end of the range.
    "a stream that turns": stream((6, [(5, -1), (0, 0)])),
    "a profile to the end": [*profile_of(0, [Quadratic(10, FRACTION, 0)], 0), TriggerProfile()],
    "another board": [],
}
REFUSED = {
    "a target": ([MoveTo(0, 101, 50)], "101 steps is outside its range -100 to 100"),
    "a speed of a move": ([MoveTo(0, 0, 51)], "51 steps/s is above its limit 50"),
    "a jog": ([MoveVelocity(1, -501, 100)], "-501 steps/s is above its limit 500"),
    "an axis": ([MoveTo(2, 0, 1)], "axis 2, which the board does not have"),
    "a set-point": (stream((1, [(11, 0), (0, 0)])), "101 steps"),
    "a sum of set-points": (stream(*[(2, [(3, 0), (0, 0)])] * 2), "102 steps"),
    "the turn inside a segment": (stream((11, [(6, -1), (0, 0)])), "105 steps"),
    "a set-point out of nowhere": ([SetPoint.of(3, 10, [(0, 0)] * 2)], "where it begins"),
    "a profile": ([*profile_of(0, [Quadratic(11, FRACTION, 0)], 0), TriggerProfile()], "101 steps"),
    "a profile of two parts": (
        [
            BeginProfile(1, 2),
            Segments.of(0, [Quadratic(5, -FRACTION, 0)]),
            Segments.of(1, [Quadratic(6, -FRACTION, 0)]),
            TriggerProfile(),
        ],
        "-1 steps",
    ),
}


@pytest.mark.parametrize("messages", ALLOWED.values(), ids=ALLOWED.keys())
def test_commands_up_to_the_limits_pass(guard, messages):
    say(guard, *messages)
    guard.check(encoded(Frame(2, 7, MoveTo.TYPE, MoveTo(0, 999, 999).packed())))


@pytest.mark.parametrize(("messages", "match"), REFUSED.values(), ids=REFUSED.keys())
def test_commands_beyond_a_limit_are_refused(guard, messages, match):
    with pytest.raises(LimitError, match=match):
        say(guard, *messages)


def test_segments_that_are_sent_again_are_checked_from_where_they_began(guard):
    segments = list(stream(*[(1, [(1, 0), (0, 0)])] * 300))
    with pytest.raises(LimitError, match="101 steps"):
        say(guard, *segments)
    begin, *sent = list(stream(*[(1, [(1, 0), (0, 0)])] * 10))
    say(guard, begin, *sent, *sent[4:], *sent[7:])


def written(bench, kind):
    return [
        kind.unpacked(frame.payload)
        for port in bench.ports
        for _, data in port.written
        for frame in Decoder(of_board=True).feed(data)
        if frame.type == kind.TYPE
    ]


@pytest.mark.parametrize(
    "order",
    [MoveTo(0, 1 << 24, 1000), MoveVelocity(0, 32_000_000, 100)],
    ids=["target", "speed"],
)
def test_an_order_that_nothing_has_checked_is_not_written_and_halts_the_driver(
    bench, caplog, order
):
    bench.driver.move_to({"y": 0.03})
    bench.run(0.05)
    first = bench.driver._running.boards[0]
    first.orders.give("unchecked", order, permit=bench.driver.gate.permit())
    bench.run(0.01)
    status = bench.driver.status()
    assert "a motion was not sent: axis x" in status.fault
    assert "a frame was held back" in caplog.text
    bench.run(1.0)
    assert order not in written(bench, type(order))
    assert bench.driver.status().state is FAULT
    commands = bench.run(0.1).command
    assert np.ptp(commands, axis=0).max() == 0.0
    bench.driver.clear_fault()
    bench.driver.move_to({"x": 0.029})
    bench.run_until(IDLE)


def test_a_trajectory_that_leaves_the_range_on_its_way_ends_there(bench, monkeypatch):
    inner = Player._at

    def wrong(player, b, instant):
        steps = inner(player, b, instant)
        return tuple(each + (2_000_000 if instant > 200 else 0) for each in steps)

    monkeypatch.setattr(Player, "_at", wrong)
    time_s = np.arange(1000) * 0.005
    signals = {("zn", Tap.CMD): 30e-6 + 1e-6 * np.sin(2 * np.pi * time_s)}
    bench.driver.play(Record.from_signals(time_s, signals, {"zn": "m"}))
    samples = bench.run(4.0)
    assert "is outside its range" in bench.driver.status().fault
    assert np.ptp(samples.command[:, bench.driver.axes.index("zn")]) < 1e-4
