"""The timing of bytes: pacing, the shared bus, overflowing clocks, captures, and faults."""

from collections import Counter

import numpy as np
import pytest

from rotemina.drivers.contract import FaultCommandError
from rotemina.drivers.mc68hc11.protocol import (
    BROADCAST_ADDRESS,
    RESYNC_BYTES,
    BeginCapture,
    BoardAbility,
    BoardFault,
    BoardState,
    CaptureSamples,
    ClearFault,
    FrameDecoder,
    FrameDone,
    IdentifyBoard,
    MoveTo,
    MoveVelocity,
    OperatorInputs,
    PollBoard,
    SetTelemetry,
    Telemetry,
)
from rotemina.drivers.virtual_board import RandomFaults, inject_fault
from rotemina.drivers.virtual_board.clock import CrystalClock

BYTE_S = 80e-6


def test_bytes_take_time_in_both_directions(make_host):
    host = make_host()
    frame = host.encode(IdentifyBoard(1))
    line = host.boards.host_ports[0]
    line.receive(frame, 0.0)
    request_duration_s = len(frame) * BYTE_S
    assert line.advance(request_duration_s + 0.5 * BYTE_S) == b""
    reply = b""
    for count in range(1, 40):
        reply += line.advance(request_duration_s + count * BYTE_S + 1e-9)
        assert len(reply) <= count
    assert len(FrameDecoder().feed(reply)) == 1
    assert make_host(baud=9600).boards.serial_lines[0].byte_s == pytest.approx(10 / 9600)


def test_a_line_without_pacing_answers_at_once(make_host):
    host = make_host(paced=False)
    host.write(host.encode(IdentifyBoard(1)))
    assert len(FrameDecoder().feed(host.boards.host_ports[0].advance(0.0))) == 1


def test_telemetry_is_sent_periodically_at_the_requested_times(host):
    begin_us = host.read_time_us() // 5000 * 5000 + 20_000
    host.send(SetTelemetry(5, begin_us))
    messages = [m for m in host.run(0.3) if isinstance(m, Telemetry | OperatorInputs)]
    times = [message.time_us for message in messages if isinstance(message, Telemetry)]
    assert times == [begin_us + 5000 * index for index in range(len(times))]
    assert len(times) >= 50
    input_indices = [
        index for index, message in enumerate(messages) if isinstance(message, OperatorInputs)
    ]
    assert input_indices == list(range(4, len(messages), 5))


def test_a_reading_is_taken_before_its_command_acts(host):
    """At the instant of a step, telemetry has the new command, but still the old reading."""
    host.send(SetTelemetry(5, host.read_time_us(2)), 2)
    host.run(0.05)
    host.send(MoveTo(2, 33_500, 5_000_000), 2)
    samples = [m.unpack_samples()[2] for m in host.run(0.1) if isinstance(m, Telemetry)]
    first_moved = next(index for index, (_, command) in enumerate(samples) if command != 32_500)
    assert abs(samples[first_moved - 1][0] - 32_500) < 100
    assert samples[-1][1] == 33_500


def test_telemetry_continues_when_the_clock_of_a_board_overflows(host):
    host.time_s = 59.9
    host.send(SetTelemetry(5, host.read_time_us(2) // 5000 * 5000), 2)
    times = [m.time_us for m in host.run(0.3) if isinstance(m, Telemetry)]
    assert max(times) > 2**32 - 50_000
    assert min(times) < 50_000
    assert set(np.diff(times) % 2**32) == {5000}


@pytest.mark.parametrize("ppm", [0.0, -80.0])
def test_ticks_are_found_from_board_times(ppm):
    clock = CrystalClock(5e-4, 2**32 - 1_000_000, ppm=ppm)
    for now in (1, 1999, 2001, 10_000_000):
        for ahead_us in (-700, 0, 1, 499, 500, 123_456):
            time_us = (clock.find_time_us(now) + ahead_us) % 2**32
            tick = clock.find_tick(time_us, now)
            after = (clock.find_time_us(tick) - time_us + 2**31) % 2**32 - 2**31
            before = (clock.find_time_us(tick - 1) - time_us + 2**31) % 2**32 - 2**31
            assert before < 0 <= after


def test_a_capture_begins_at_the_telemetry_that_reports_its_start(host):
    host.send(SetTelemetry(20, 0))
    host.run(0.05)
    # The axis passes 65 536 steps within a second.
    host.send(MoveVelocity(0, 100_000, 5000))
    host.run(0.01)
    host.send(BeginCapture(1, 500, 2000))
    assert FrameDone(host.number) in host.run(1.1)
    messages = [message for board, message, _ in host.received if board == 1]
    telemetry = [message for message in messages if isinstance(message, Telemetry)]
    first = next(sample for sample in telemetry if sample.state & BoardState.CAPTURING)
    frames = [message for message in messages if isinstance(message, CaptureSamples)]
    low_words = np.concatenate([np.frombuffer(frame.samples, ">u2") for frame in frames]).astype(
        np.int64
    )
    assert len(low_words) == 2000
    assert [frame.first_number for frame in frames] == list(range(0, 2000, 11))
    path = first.unpack_samples()[0][0] + np.concatenate(
        ([0], np.cumsum((np.diff(low_words) + 2**15) % 2**16 - 2**15))
    )
    assert low_words[0] == first.unpack_samples()[0][0] % 2**16
    for sample in telemetry:
        index = (sample.time_us - first.time_us) // 500
        if 0 <= index < 2000:
            assert path[index] == sample.unpack_samples()[0][0]


def test_on_a_shared_bus_boards_answer_in_their_slots(make_host):
    host = make_host(ports=1)
    assert host.ask(IdentifyBoard(1), 2).abilities & BoardAbility.HALF_DUPLEX
    frame = host.encode(PollBoard(), BROADCAST_ADDRESS)
    began_s = host.time_s
    host.write(frame)
    line = host.boards.host_ports[0]
    first_s = began_s + (len(frame) + 3) * BYTE_S
    assert line.advance(first_s + 0.5 * BYTE_S) == b""
    length = len(line.advance(first_s + 31.5 * BYTE_S))
    assert 20 < length <= 32
    frames = FrameDecoder()
    host.time_s = first_s + 31.5 * BYTE_S
    assert [f.address for f in frames.feed(line.advance(host.time_s + 40 * BYTE_S))] == [2]


def test_on_a_shared_bus_boards_send_only_when_they_are_polled(make_host):
    host = make_host(ports=1).with_long_watchdogs()
    host.received.clear()
    host.send(SetTelemetry(10, 0), 1)
    host.run(0.05)
    assert [m for _, m, _ in host.received] == [FrameDone(host.number)]
    # A stop in the slot of a board suppresses its answer to the request before.
    host.write(host.encode(MoveVelocity(0, 10_000, 900)) + b"\0")
    assert host.run(0.1) == []
    assert [board.fault.name for board in host.boards.boards] == ["STOPPED", "STOPPED"]


def test_on_a_shared_bus_captured_samples_wait_for_polls(make_host):
    host = make_host(ports=1).with_long_watchdogs()
    host.send(SetTelemetry(50, 0))
    host.run(0.06)
    host.ask(BeginCapture(1, 1000, 33), within_s=0.01)
    host.run(0.2)
    answers = [host.ask(PollBoard()) for _ in range(10)]
    kinds = [type(answer) for answer in answers]
    assert kinds[0] is Telemetry
    assert [answer.first_number for answer in answers if isinstance(answer, CaptureSamples)] == [
        0,
        11,
        22,
    ]
    assert OperatorInputs in kinds


def test_disturbed_bytes_never_cause_an_unrequested_motion(make_host):
    host = make_host(seed=3).with_long_watchdogs()
    random_faults = RandomFaults(host.boards, 20.0, seed=5)
    answers = []
    for k in range(150):
        random_faults.advance(host.time_s + 0.01)
        host.time_s = host.boards.now_s
        host.write(RESYNC_BYTES)
        answers.append(host.ask(MoveTo(0, 275_000 + k, 100_000)))
        # An additional zero byte is a valid stop.
        if host.boards.boards[0].fault:
            assert host.boards.boards[0].fault is BoardFault.STOPPED
            host.ask(ClearFault())
    kinds = Counter(type(answer) for answer in answers)
    assert kinds[FrameDone] > 75
    assert kinds[type(None)] > 3
    assert 274_999 <= host.boards.boards[0].drives[0].position <= 275_150


def test_bytes_can_be_dropped_repeated_corrupted_and_delayed(host):
    inject_fault(host.boards, "drop 3 board line 1")
    assert host.ask(IdentifyBoard(1)) is None
    host.write(RESYNC_BYTES)
    inject_fault(host.boards, "double 1 host")
    # A host ignores a repeated zero byte.
    assert host.ask(IdentifyBoard(1)) is not None
    inject_fault(host.boards, "corrupt 5 host")
    assert host.ask(IdentifyBoard(1)) is None
    inject_fault(host.boards, "delay 50 ms host")
    assert host.ask(IdentifyBoard(1)) is None
    assert len(host.run(0.06)) == 1


def test_an_invalid_fault_command_is_refused_with_the_reason(host):
    for command, message in {
        "": "unknown command",
        "explode": "unknown command; use brown-out",
        "drop": "must be a number from 1",
        "drop x": "must be a number from 1",
        "drop 3 4": "'4' is not allowed here",
        "drop 3 line 3": "from 1 to 2",
        "delay 5": "enter a time such as '5 ms'",
        "silence 5 h": "enter a time such as",
        "space": "enter a time such as",
        "reset 3": "from 1 to 2",
        "freeze q": "one of x, y, z",
        "lose zn 4": "is not a stepper",
        "joystick 1 2": "three readings",
        "joystick 1 2 5000": "three readings",
    }.items():
        with pytest.raises(FaultCommandError, match=message):
            inject_fault(host.boards, command)


def test_the_output_does_not_depend_on_the_reading_interval(make_host):
    def read_output(step_s):
        host = make_host(seed=7).with_long_watchdogs()
        host.send(SetTelemetry(5, 0))
        host.send(MoveVelocity(0, 30_000, 200))
        host.run(0.02)
        output = b""
        for k in range(round(0.4 / step_s)):
            output += host.boards.host_ports[0].advance(host.time_s + (k + 1) * step_s)
        return output

    assert read_output(0.4) == read_output(0.001) == read_output(0.02)
