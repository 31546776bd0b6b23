"""The parts of the serial link: requests, set-points, the board's clock, its sampling grid."""

import numpy as np
import pytest

from rotemina.drivers.contract import Gate, StateError, VirtualClock, combine_link_quality
from rotemina.drivers.mc68hc11.board_clock import BoardClockEstimator
from rotemina.drivers.mc68hc11.dialogue import BoardDialogue, BoardRequest, RequestUrgency
from rotemina.drivers.mc68hc11.protocol import (
    RESYNC_BYTES,
    STOP_BYTES,
    FrameDecoder,
    FrameDone,
    FrameRefused,
    MoveTo,
    OperatorInputs,
    PollBoard,
    RefusalReason,
    SerialFrame,
    SetWatchdog,
    StopBoard,
    StreamSegment,
    Telemetry,
    encode_frame,
)
from rotemina.drivers.mc68hc11.sampling_grid import SamplingGrid
from rotemina.drivers.mc68hc11.segment_window import SegmentWindow
from rotemina.drivers.mc68hc11.serial_link import SerialLink

CLOCK_PERIOD_US = 1 << 32


def test_a_request_is_repeated_until_it_is_answered():
    dialogue, answers = BoardDialogue(1, 0.01), []
    dialogue.ask(
        BoardRequest(message=SetWatchdog(100), on_answer=lambda message, at_s: answers.append(at_s))
    )
    assert dialogue.find_next_urgency(0.0) is RequestUrgency.COMMAND
    frame = dialogue.take_frame(0.0, 7, 0.002).data
    assert dialogue.find_next_urgency(0.011) is None
    assert dialogue.find_next_urgency(0.013) is RequestUrgency.COMMAND
    assert dialogue.take_frame(0.013, 8, 0.002).data == RESYNC_BYTES + frame
    assert not dialogue.receive(FrameDone(6), 0.02)
    assert dialogue.receive(FrameDone(7), 0.02)
    assert not dialogue.receive(FrameDone(7), 0.021)
    assert answers == [0.02]
    assert dialogue.repeat_count == 1


def test_the_most_urgent_request_is_sent_first_and_a_stop_is_never_dropped():
    dialogue = BoardDialogue(1, 0.01)
    dialogue.ask(BoardRequest(message=SetWatchdog(1), urgency=RequestUrgency.BACKGROUND))
    dialogue.ask(BoardRequest(message=MoveTo(0, 1, 1)))
    dialogue.ask(BoardRequest(message=StopBoard(), urgency=RequestUrgency.STOP))
    dialogue.cancel_requests()
    assert dialogue.find_next_urgency(0.0) is RequestUrgency.STOP
    dialogue.take_frame(0.0, 1, 0.0)
    dialogue.cancel_requests()
    assert dialogue.is_awaiting_answer
    dialogue.receive(FrameDone(1), 0.001)
    assert not dialogue.has_requests


def test_an_expired_request_is_not_repeated():
    dialogue, refusals = BoardDialogue(1, 0.01), []
    dialogue.ask(BoardRequest(message=MoveTo(0, 1, 1), on_refusal=refusals.append, expires_s=0.02))
    dialogue.take_frame(0.0, 1, 0.0)
    assert dialogue.find_next_urgency(0.03) is None
    assert refusals == [None]
    assert not dialogue.has_requests


def test_queues_are_bounded():
    dialogue = BoardDialogue(1, 0.01)
    for _ in range(96):
        dialogue.ask(BoardRequest(message=SetWatchdog(1)))
    with pytest.raises(StateError, match="wait"):
        dialogue.ask(BoardRequest(message=SetWatchdog(1)))


def make_window(count):
    return SegmentWindow(
        1,
        count,
        lambda index: StreamSegment.from_differences(index % 256, 10, [(index, -index)]),
        lambda: 0.04,
        Gate().permit(),
    )


def test_only_released_segments_are_sent_and_only_a_few_at_a_time():
    window = make_window(100)
    assert not window.has_segment_to_send(0.0)
    window.release(50)
    for number in range(8):
        assert window.has_segment_to_send(0.0)
        window.take_frame(0.0, number, 0.0)
    assert not window.has_segment_to_send(0.0)
    window.receive(Telemetry.from_samples(0, 0, 0, 0, 2, ()), 0.001)
    assert window.acknowledged_count == 2
    assert window.has_segment_to_send(0.001)


def test_telemetry_of_another_stream_acknowledges_nothing():
    window = make_window(100)
    window.release(50)
    for number in range(3):
        window.take_frame(0.0, number, 0.0)
    window.receive(Telemetry.from_samples(0, 0, 0, 0, 40, ()), 0.001)
    assert window.acknowledged_count == 0


def test_a_refused_segment_ends_the_window():
    window = make_window(10)
    window.release(10)
    window.take_frame(0.0, 3, 0.0)
    window.receive(FrameRefused(3, RefusalReason.FAULTY), 0.001)
    assert window.refusal == RefusalReason.FAULTY
    assert not window.has_segment_to_send(1.0)


def test_the_clock_follows_its_board_despite_overflow_and_drift():
    generator = np.random.default_rng(1)
    clock, begin_us = BoardClockEstimator(), CLOCK_PERIOD_US - 20_000_000
    for index in range(12_000):
        true_s = 100.0 + 0.005 * index
        board_us = round(begin_us + 1e6 * (true_s - 100.0) * (1.0 + 60e-6))
        time_us = clock.unwrap(board_us % CLOCK_PERIOD_US)
        assert time_us == board_us
        clock.observe(time_us, true_s + float(generator.exponential(2e-3)))
    expected_us = round(begin_us + 1e6 * 65.0 * (1.0 + 60e-6))
    assert clock.to_host_time_s(expected_us) == pytest.approx(165.0, abs=3e-3)
    assert abs(clock.to_board_time_us(165.0) - expected_us) < 3000


def test_only_an_early_or_future_time_is_a_jump_of_the_clock():
    clock = BoardClockEstimator()
    clock.observe(10_000_000, 50.0)
    assert not clock.has_jumped(clock.unwrap(10_005_000), 53.0)
    assert clock.has_jumped(clock.unwrap(100_000), 50.01)
    assert clock.has_jumped(clock.unwrap(20_000_000), 50.01)


def test_the_sampling_grid_numbers_samples_and_can_be_shifted():
    grid = SamplingGrid(5000, 100_000)
    assert [grid.find_number(100_000 + delay_us) for delay_us in (0, 5000, 5300, 7500)] == [
        0,
        1,
        1,
        None,
    ]
    assert grid.find_number(0) is None
    grid.shift(151_000, 10)
    assert grid.find_number(151_000) == 10
    assert grid.find_number(145_000) == 9
    assert grid.find_latest_number(155_999) == 10
    assert (grid.find_time_us(9), grid.find_time_us(11)) == (145_000, 156_000)


class FakePort:
    def __init__(self):
        self.writes, self.waiting_count, self.incoming = [], 0, b""

    def read(self):
        received, self.incoming = self.incoming, b""
        return received

    def write(self, data):
        self.writes.append(data)

    def waiting(self):
        return self.waiting_count

    def close(self):
        pass


def make_link(clock, port, poll=lambda _: None, on_message=lambda *_: None):
    link = SerialLink(port, "test", 125_000, (1, 2), 0.015, clock, on_message, poll)
    link.half_duplex = False
    return link


def test_frames_are_written_one_at_a_time_but_a_stop_at_once():
    clock, port = VirtualClock(), FakePort()
    link = make_link(clock, port)
    for address in (1, 2):
        link.dialogues[address].ask(BoardRequest(message=MoveTo(0, 1, 1)))
    link.send()
    link.send()
    assert len(port.writes) == 1
    link.stop()
    assert port.writes[-1] == STOP_BYTES
    assert link.read_quality().stop_s == pytest.approx((len(port.writes[0]) + 4) * 80e-6)
    clock.advance(0.003)
    port.waiting_count = 5
    link.send()
    assert len(port.writes) == 2
    port.waiting_count = 0
    link.send()
    assert len(port.writes) == 3


def test_on_a_shared_bus_the_host_waits_for_the_boards():
    clock, port = VirtualClock(), FakePort()
    link = make_link(clock, port, poll=lambda _: 15)
    link.half_duplex = True
    link.send()
    clock.advance(0.01)
    link.send()
    assert len(port.writes) == 1
    for address in (1, 2):
        port.incoming += encode_frame(
            SerialFrame(address, 0, FrameDone.TYPE, b"\x63", from_board=True)
        )
    link.receive()
    link.send()
    assert len(port.writes) == 2


def test_polling_a_shared_bus_does_not_block_background_requests():
    clock, port = VirtualClock(), FakePort()
    link = make_link(clock, port, poll=lambda _: 1)
    link.half_duplex = True
    link.dialogues[1].ask(BoardRequest(message=SetWatchdog(1), urgency=RequestUrgency.BACKGROUND))
    for _ in range(2):
        link.send()
        clock.advance(0.01)
        port.incoming += encode_frame(
            SerialFrame(1, 0, OperatorInputs.TYPE, bytes(6), from_board=True)
        )
        link.receive()
    types = [frame.type for data in port.writes for frame in FrameDecoder(is_board=True).feed(data)]
    assert types == [PollBoard.TYPE, SetWatchdog.TYPE]


def test_invalid_messages_are_counted():
    clock, port, messages = VirtualClock(), FakePort(), []
    link = make_link(clock, port, on_message=lambda *message: messages.append(message))
    port.incoming = b"noise\0" + encode_frame(SerialFrame(1, 0, 0x70, b"", from_board=True))
    # An echo of a frame from the host.
    port.incoming += encode_frame(SerialFrame(1, 0, SetWatchdog.TYPE, b"\0\1"))
    link.receive()
    assert messages == []
    assert link.read_quality().rejected == 2


def test_the_qualities_of_several_lines_are_combined():
    clock = VirtualClock()
    links = [make_link(clock, FakePort()) for _ in range(2)]
    for link in links:
        link.dialogues[1].ask(BoardRequest(message=SetWatchdog(1)))
        link.send()
    assert combine_link_quality([link.read_quality() for link in links]).sent == 2
    assert combine_link_quality([]).round_trip_s is None


@pytest.mark.parametrize(
    "late_answer", [FrameDone(7), FrameRefused(7, RefusalReason.BUSY)], ids=["done", "refused"]
)
def test_an_answer_to_a_dropped_request_does_not_answer_a_later_one(late_answer):
    dialogue, answers, refusals = BoardDialogue(1, 0.01), [], []
    dialogue.ask(BoardRequest(message=MoveTo(0, 1, 1)))
    dialogue.take_frame(0.0, 7, 0.002)
    dialogue.cancel_requests()
    later_request = BoardRequest(
        message=MoveTo(0, 2, 1),
        on_answer=lambda message, at_s: answers.append(message),
        on_refusal=refusals.append,
    )
    dialogue.ask(later_request)
    dialogue.take_frame(0.01, 8, 0.002)
    assert not dialogue.receive(late_answer, 0.02)
    assert (dialogue.is_awaiting_answer, answers, refusals) == (True, [], [])
    assert dialogue.receive(FrameDone(8), 0.03)
    assert answers == [FrameDone(8)]


def test_answers_are_distinguished_when_their_numbers_wrap_around():
    dialogue = BoardDialogue(1, 0.01)
    for number in range(250, 520):
        dialogue.ask(BoardRequest(message=SetWatchdog(100)))
        dialogue.take_frame(0.0, number % 256, 0.0)
        assert not dialogue.receive(FrameDone((number - 1) % 256), 0.001)
        assert dialogue.receive(FrameDone(number % 256), 0.002)
