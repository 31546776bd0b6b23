"""The parts of the link: requests, set-points, the board's clock, its sampling instants."""

from itertools import count

import numpy as np
import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import Gate
from rotemina.drivers.line_quality import total_quality
from rotemina.drivers.mc68hc11.board_clock import BoardClock
from rotemina.drivers.mc68hc11.board_messages import Done, Inputs, Refused, Telemetry
from rotemina.drivers.mc68hc11.dialogue import Dialogue, Request, Urgency
from rotemina.drivers.mc68hc11.framing import RESYNC, STOP_BYTES, Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import MoveTo, Poll, SetPoint, Stop, Watch
from rotemina.drivers.mc68hc11.messages import message_of
from rotemina.drivers.mc68hc11.protocol_codes import Refusal
from rotemina.drivers.mc68hc11.sampling_grid import Grid
from rotemina.drivers.mc68hc11.segment_window import SetpointWindow
from rotemina.drivers.mc68hc11.serial_link import Link

TURN = 1 << 32


def test_a_request_is_repeated_after_its_time_until_it_is_answered():
    dialogue, answers = Dialogue(1, 0.01), []
    dialogue.ask(Request(message=Watch(100), answered=lambda told, at_s: answers.append(at_s)))
    assert dialogue.offer(0.0) is Urgency.COMMAND
    frame = dialogue.take(0.0, 7, 0.002).data
    assert dialogue.offer(0.011) is None
    assert dialogue.offer(0.013) is Urgency.COMMAND
    assert dialogue.take(0.013, 8, 0.002).data == RESYNC + frame
    assert not dialogue.receive(Done(6), 0.02)
    assert dialogue.receive(Done(7), 0.02)
    assert not dialogue.receive(Done(7), 0.021)
    assert answers == [0.02]
    assert dialogue.repeated == 1


def test_the_most_urgent_request_goes_first_and_a_stop_is_not_dropped():
    dialogue = Dialogue(1, 0.01)
    dialogue.ask(Request(message=Watch(1), urgency=Urgency.BACKGROUND))
    dialogue.ask(Request(message=MoveTo(0, 1, 1)))
    dialogue.ask(Request(message=Stop(), urgency=Urgency.STOP))
    dialogue.drop()
    assert dialogue.offer(0.0) is Urgency.STOP
    dialogue.take(0.0, 1, 0.0)
    dialogue.drop()
    assert dialogue.waiting
    dialogue.receive(Done(1), 0.001)
    assert not dialogue.busy


def test_a_request_whose_time_is_over_is_said_no_more():
    dialogue, refusals = Dialogue(1, 0.01), []
    dialogue.ask(Request(message=MoveTo(0, 1, 1), refused=refusals.append, expires_s=0.02))
    dialogue.take(0.0, 1, 0.0)
    assert dialogue.offer(0.03) is None
    assert refusals == [None]
    assert not dialogue.busy


def test_queues_are_bounded():
    dialogue = Dialogue(1, 0.01)
    for _ in range(96):
        dialogue.ask(Request(message=Watch(1)))
    with pytest.raises(StateError, match="wait"):
        dialogue.ask(Request(message=Watch(1)))


class BoardQueue:
    """Takes segments as a board does: in order only; says nothing of those that it takes."""

    def __init__(self):
        self.taken = []

    def hear(self, data):
        for frame in Decoder().feed(data):
            one = message_of(frame.type, frame.payload)
            assert isinstance(one, SetPoint)
            expected = len(self.taken)
            if one.index == expected % 256:
                self.taken.append(one)
                return None
            if 0 < (expected - one.index) % 256 <= 16:
                return None
            return Refused(frame.number, Refusal.OUT_OF_ORDER)
        raise AssertionError(data)

    def telemetry(self):
        return Telemetry.of(0, 0, 0, 0, len(self.taken) % 256, ())


def window_of(count):
    return SetpointWindow(
        1,
        count,
        lambda one: SetPoint.of(one % 256, 10, [(one, -one)]),
        lambda: 0.04,
        Gate().permit(),
    )


@pytest.mark.parametrize("seed", range(5))
def test_segments_arrive_once_each_and_in_order_whatever_is_lost(seed):
    generator = np.random.default_rng(seed)
    window = window_of(600)
    board, now_s, number, answers = BoardQueue(), 0.0, 0, []
    for turn in count():
        assert now_s < 60.0
        now_s += 0.002
        window.release(int(now_s / 0.004))
        if turn % 5 == 0:
            answers.append(board.telemetry())
        if answers and generator.random() < 0.7:
            answer = answers.pop(0)
            if generator.random() > 0.05:
                window.receive(answer, now_s)
        if window.taken == 600:
            break
        if window.offer(now_s):
            number = (number + 1) % 256
            data = window.take(now_s, number, 0.002).data
            if generator.random() > 0.05 and (said := board.hear(data)) is not None:
                answers.append(said)
    assert [one.differences()[0][0] for one in board.taken] == list(range(600))
    assert window.repeated < 600


def test_only_so_many_segments_are_under_way_and_none_before_its_turn():
    window = window_of(100)
    assert not window.offer(0.0)
    window.release(50)
    for number in range(8):
        assert window.offer(0.0)
        window.take(0.0, number, 0.0)
    assert not window.offer(0.0)
    window.receive(Telemetry.of(0, 0, 0, 0, 2, ()), 0.001)
    assert window.taken == 2
    assert window.offer(0.001)


def test_telemetry_of_another_stream_acknowledges_nothing():
    window = window_of(100)
    window.release(50)
    for number in range(3):
        window.take(0.0, number, 0.0)
    window.receive(Telemetry.of(0, 0, 0, 0, 40, ()), 0.001)
    assert window.taken == 0


def test_a_refused_segment_ends_the_window():
    window = window_of(10)
    window.release(10)
    window.take(0.0, 3, 0.0)
    window.receive(Refused(3, Refusal.FAULTY), 0.001)
    assert window.refusal == Refusal.FAULTY
    assert not window.offer(1.0)


def test_the_clock_follows_its_board_over_the_turn_and_its_drift():
    generator = np.random.default_rng(1)
    clock, begin_us = BoardClock(), TURN - 20_000_000
    for index in range(12_000):
        true_s = 100.0 + 0.005 * index
        board_us = round(begin_us + 1e6 * (true_s - 100.0) * (1.0 + 60e-6))
        time_us = clock.unwrapped(board_us % TURN)
        assert time_us == board_us
        clock.observe(time_us, true_s + float(generator.exponential(2e-3)))
    later_us = round(begin_us + 1e6 * 65.0 * (1.0 + 60e-6))
    assert clock.host_time_s(later_us) == pytest.approx(165.0, abs=3e-3)
    assert abs(clock.time_us(165.0) - later_us) < 3000


def test_a_late_answer_is_no_jump_but_a_time_before_or_to_come_is():
    clock = BoardClock()
    clock.observe(10_000_000, 50.0)
    assert not clock.jumped(clock.unwrapped(10_005_000), 53.0)
    assert clock.jumped(clock.unwrapped(100_000), 50.01)
    assert clock.jumped(clock.unwrapped(20_000_000), 50.01)


def test_the_grid_counts_and_moves():
    grid = Grid(5000, 100_000)
    assert [grid.number(100_000 + one) for one in (0, 5000, 5300, 7500)] == [0, 1, 1, None]
    assert grid.number(0) is None
    grid.move(151_000, 10)
    assert grid.number(151_000) == 10
    assert grid.number(145_000) == 9
    assert grid.latest(155_999) == 10
    assert (grid.time_us(9), grid.time_us(11)) == (145_000, 156_000)


class Wire:
    def __init__(self):
        self.out, self.held, self.incoming = [], 0, b""

    def read(self):
        received, self.incoming = self.incoming, b""
        return received

    def write(self, data):
        self.out.append(data)

    def waiting(self):
        return self.held

    def close(self):
        pass


def linked(clock, wire, poll=lambda _: None, heard=lambda *_: None):
    link = Link(wire, "test", 125_000, (1, 2), 0.015, clock, heard, poll)
    link.half_duplex = False
    return link


def test_one_frame_at_a_time_is_with_the_operating_system_and_a_stop_at_once():
    clock, wire = VirtualClock(), Wire()
    link = linked(clock, wire)
    for address in (1, 2):
        link.dialogues[address].ask(Request(message=MoveTo(0, 1, 1)))
    link.send()
    link.send()
    assert len(wire.out) == 1
    link.stop()
    assert wire.out[-1] == STOP_BYTES
    assert link.quality().stop_s == pytest.approx((len(wire.out[0]) + 4) * 80e-6)
    clock.advance(0.003)
    wire.held = 5
    link.send()
    assert len(wire.out) == 2
    wire.held = 0
    link.send()
    assert len(wire.out) == 3


def test_on_a_shared_bus_the_host_waits_for_the_boards():
    clock, wire = VirtualClock(), Wire()
    link = linked(clock, wire, poll=lambda _: 15)
    link.half_duplex = True
    link.send()
    clock.advance(0.01)
    link.send()
    assert len(wire.out) == 1
    for address in (1, 2):
        wire.incoming += encoded(Frame(address, 0, Done.TYPE, b"\x63", from_board=True))
    link.receive()
    link.send()
    assert len(wire.out) == 2


def test_on_a_shared_bus_a_request_without_haste_is_said_however_much_there_is_to_poll_for():
    clock, wire = VirtualClock(), Wire()
    link = linked(clock, wire, poll=lambda _: 1)
    link.half_duplex = True
    link.dialogues[1].ask(Request(message=Watch(1), urgency=Urgency.BACKGROUND))
    for _ in range(2):
        link.send()
        clock.advance(0.01)
        wire.incoming += encoded(Frame(1, 0, Inputs.TYPE, bytes(6), from_board=True))
        link.receive()
    types = [frame.type for data in wire.out for frame in Decoder(of_board=True).feed(data)]
    assert types == [Poll.TYPE, Watch.TYPE]


def test_what_is_no_message_is_counted():
    clock, wire, heard = VirtualClock(), Wire(), []
    link = linked(clock, wire, heard=lambda *told: heard.append(told))
    wire.incoming = b"noise\0" + encoded(Frame(1, 0, 0x70, b"", from_board=True))
    wire.incoming += encoded(Frame(1, 0, Watch.TYPE, b"\0\1"))  # an echo of the host's own
    link.receive()
    assert heard == []
    assert link.quality().rejected == 2


def test_qualities_of_lines_are_joined():
    clock = VirtualClock()
    links = [linked(clock, Wire()) for _ in range(2)]
    for link in links:
        link.dialogues[1].ask(Request(message=Watch(1)))
        link.send()
    assert total_quality([link.quality() for link in links]).sent == 2
    assert total_quality([]).round_trip_s is None


@pytest.mark.parametrize("late", [Done(7), Refused(7, Refusal.BUSY)], ids=["done", "refused"])
def test_an_answer_to_a_request_that_a_stop_has_dropped_answers_no_later_one(late):
    dialogue, answers, refusals = Dialogue(1, 0.01), [], []
    dialogue.ask(Request(message=MoveTo(0, 1, 1)))
    dialogue.take(0.0, 7, 0.002)
    dialogue.drop()
    later = Request(
        message=MoveTo(0, 2, 1),
        answered=lambda told, at_s: answers.append(told),
        refused=refusals.append,
    )
    dialogue.ask(later)
    dialogue.take(0.01, 8, 0.002)
    assert not dialogue.receive(late, 0.02)
    assert (dialogue.waiting, answers, refusals) == (True, [], [])
    assert dialogue.receive(Done(8), 0.03)
    assert answers == [Done(8)]


def test_answers_are_told_apart_over_the_turn_of_their_numbers():
    dialogue = Dialogue(1, 0.01)
    for number in range(250, 520):
        dialogue.ask(Request(message=Watch(100)))
        dialogue.take(0.0, number % 256, 0.0)
        assert not dialogue.receive(Done((number - 1) % 256), 0.001)
        assert dialogue.receive(Done(number % 256), 0.002)
