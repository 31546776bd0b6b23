"""Bytes in time: pacing, the shared bus, clocks that turn, captures, and disturbances."""

import time
from collections import Counter

import numpy as np
import pytest

from rotemina.drivers.mc68hc11.board_messages import Captured, Done, Inputs, Telemetry
from rotemina.drivers.mc68hc11.framing import BROADCAST, RESYNC, STOP_BYTES, Decoder
from rotemina.drivers.mc68hc11.host_messages import (
    Capture,
    ClearFault,
    Identify,
    MoveTo,
    MoveVelocity,
    Poll,
    SetTelemetry,
)
from rotemina.drivers.mc68hc11.protocol_codes import Ability, Fault, State
from rotemina.drivers.virtual_board.clock import BoardClock
from rotemina.drivers.virtual_board.fault_injection import FaultCommandError, RandomFaults, inject

BYTE_S = 80e-6


def test_bytes_take_their_time_in_both_directions(hosts):
    host = hosts()
    said = host.wire(Identify(1))
    line = host.boards.lines[0]
    line.receive(said, 0.0)
    asked_s = len(said) * BYTE_S
    assert line.advance(asked_s + 0.5 * BYTE_S) == b""
    got = b""
    for count in range(1, 40):
        got += line.advance(asked_s + count * BYTE_S + 1e-9)
        assert len(got) <= count
    assert len(Decoder().feed(got)) == 1
    assert hosts(baud=9600).boards.serial[0].byte_s == pytest.approx(10 / 9600)


def test_unpaced_an_answer_is_there_at_once(hosts):
    host = hosts(paced=False)
    host.write(host.wire(Identify(1)))
    assert len(Decoder().feed(host.boards.lines[0].advance(0.0))) == 1


def test_telemetry_comes_unasked_at_the_times_it_was_asked_for(host):
    begin_us = host.now_us() // 5000 * 5000 + 20_000
    host.say(SetTelemetry(5, begin_us))
    said = [m for m in host.live(0.3) if isinstance(m, Telemetry | Inputs)]
    times = [one.time_us for one in said if isinstance(one, Telemetry)]
    assert times == [begin_us + 5000 * k for k in range(len(times))]
    assert len(times) >= 50
    places = [k for k, one in enumerate(said) if isinstance(one, Inputs)]
    assert places == list(range(4, len(said), 5))


def test_a_sample_is_read_before_its_command_acts(host):
    """The command of a step is told from its own instant on, the reading only after it."""
    host.say(SetTelemetry(5, host.now_us(2)), 2)
    host.live(0.05)
    host.say(MoveTo(2, 33_500, 5_000_000), 2)
    samples = [m.samples()[2] for m in host.live(0.1) if isinstance(m, Telemetry)]
    moved = next(k for k, (_, command) in enumerate(samples) if command != 32_500)
    assert abs(samples[moved - 1][0] - 32_500) < 100
    assert samples[-1][1] == 33_500


def test_the_second_boards_clock_turns_and_telemetry_goes_on(host):
    host.time_s = 59.9
    host.say(SetTelemetry(5, host.now_us(2) // 5000 * 5000), 2)
    times = [m.time_us for m in host.live(0.3) if isinstance(m, Telemetry)]
    assert max(times) > 2**32 - 50_000
    assert min(times) < 50_000
    assert set(np.diff(times) % 2**32) == {5000}


@pytest.mark.parametrize("ppm", [0.0, 80.0, -80.0])
def test_ticks_are_found_by_the_times_of_a_board(ppm):
    clock = BoardClock(5e-4, 2**32 - 1_000_000, ppm=ppm)
    for now in (1, 1999, 2001, 10_000_000):
        for ahead_us in (-700, 0, 1, 499, 500, 123_456):
            time_us = (clock.at_tick(now) + ahead_us) % 2**32
            tick = clock.tick_at(time_us, now)
            after = (clock.at_tick(tick) - time_us + 2**31) % 2**32 - 2**31
            before = (clock.at_tick(tick - 1) - time_us + 2**31) % 2**32 - 2**31
            assert before < 0 <= after


def test_captured_samples_begin_with_the_telemetry_that_says_so(host):
    host.say(SetTelemetry(20, 0))
    host.live(0.05)
    host.say(MoveVelocity(0, 100_000, 5000))  # 65 536 steps are passed within a second
    host.live(0.01)
    host.say(Capture(1, 500, 2000))
    assert Done(host.number) in host.live(1.1)
    own = [m for who, m, _ in host.heard if who == 1]
    first = next(m for m in own if isinstance(m, Telemetry) and m.state & State.CAPTURING)
    frames = [m for m in own if isinstance(m, Captured)]
    low = np.concatenate([np.frombuffer(one.samples, ">u2") for one in frames]).astype(np.int64)
    assert len(low) == 2000
    assert [one.begin for one in frames] == list(range(0, 2000, 11))
    path = first.samples()[0][0] + np.concatenate(
        ([0], np.cumsum((np.diff(low) + 2**15) % 2**16 - 2**15))
    )
    assert low[0] == first.samples()[0][0] % 2**16
    for sample in (m for m in own if isinstance(m, Telemetry)):
        index = (sample.time_us - first.time_us) // 500
        if 0 <= index < 2000:
            assert path[index] == sample.samples()[0][0]


def test_on_a_shared_bus_boards_answer_in_their_slots(hosts):
    host = hosts(ports=1)
    assert host.ask(Identify(1), 2).abilities & Ability.HALF_DUPLEX
    said = host.wire(Poll(), BROADCAST)
    began_s = host.time_s
    host.write(said)
    line = host.boards.lines[0]
    first_s = began_s + (len(said) + 3) * BYTE_S
    assert line.advance(first_s + 0.5 * BYTE_S) == b""
    length = len(line.advance(first_s + 31.5 * BYTE_S))
    assert 20 < length <= 32
    frames = Decoder()
    host.time_s = first_s + 31.5 * BYTE_S
    assert [f.address for f in frames.feed(line.advance(host.time_s + 40 * BYTE_S))] == [2]


def test_on_a_shared_bus_the_host_goes_first_and_nobody_speaks_unasked(hosts):
    host = hosts(ports=1).patient()
    host.heard.clear()
    host.say(SetTelemetry(10, 0), 1)
    host.live(0.05)
    assert [m for _, m, _ in host.heard] == [Done(host.number)]
    # A stop in the slot: the answer to what was asked before is left out.
    host.write(host.wire(MoveVelocity(0, 10_000, 900)) + b"\0")
    assert host.live(0.1) == []
    assert [board.fault.name for board in host.boards.boards] == ["STOPPED", "STOPPED"]


def test_captured_samples_wait_on_a_shared_bus_until_they_are_polled(hosts):
    host = hosts(ports=1).patient()
    host.say(SetTelemetry(50, 0))
    host.live(0.06)
    host.ask(Capture(1, 1000, 33), within_s=0.01)
    host.live(0.2)
    answers = [host.ask(Poll()) for _ in range(10)]
    kinds = [type(one) for one in answers]
    assert kinds[0] is Telemetry
    assert [one.begin for one in answers if isinstance(one, Captured)] == [0, 11, 22]
    assert Inputs in kinds


def test_disturbed_bytes_never_make_a_board_do_what_nobody_said(hosts):
    host = hosts(seed=3).patient()
    mishaps = RandomFaults(host.boards, 20.0, seed=5)
    answers = []
    for k in range(150):
        mishaps.live(host.time_s + 0.01)
        host.time_s = host.boards.now_s
        host.write(RESYNC)
        answers.append(host.ask(MoveTo(0, 275_000 + k, 100_000)))
        if host.boards.boards[0].fault:  # a zero too many says stop, and that is right
            assert host.boards.boards[0].fault is Fault.STOPPED
            host.ask(ClearFault())
    kinds = Counter(type(one) for one in answers)
    assert kinds[Done] > 75
    assert kinds[type(None)] > 3
    assert 274_999 <= host.boards.boards[0].drives[0].position <= 275_150


def test_a_line_held_at_space_stops_the_boards_and_comes_back(host):
    host.say(MoveVelocity(0, 10_000, 5000))
    host.live(0.1)
    inject(host.boards, "space 0.5 s")
    assert host.ask(Identify(1)) is None
    assert host.boards.boards[0].fault.name == "STOPPED"
    host.live(0.5)
    assert host.ask(Identify(1)) is not None


def test_bytes_dropped_doubled_delayed(host):
    inject(host.boards, "drop 3 board line 1")
    assert host.ask(Identify(1)) is None
    host.write(RESYNC)
    inject(host.boards, "double 1 host")
    assert host.ask(Identify(1)) is not None  # a zero twice is nothing to a host
    inject(host.boards, "corrupt 5 host")
    assert host.ask(Identify(1)) is None
    inject(host.boards, "delay 50 ms host")
    assert host.ask(Identify(1)) is None
    assert len(host.live(0.06)) == 1


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("", "unknown command"),
        ("explode", "unknown command; use brown-out"),
        ("drop", "must be a number from 1"),
        ("drop x", "must be a number from 1"),
        ("drop 3 4", "'4' is not allowed here"),
        ("drop 3 line 3", "from 1 to 2"),
        ("delay 5", "enter a time such as '5 ms'"),
        ("silence 5 h", "enter a time such as"),
        ("space", "enter a time such as"),
        ("reset 3", "from 1 to 2"),
        ("freeze q", "one of x, y, z"),
        ("lose zn 4", "is not a stepper"),
        ("joystick 1 2", "three readings"),
        ("joystick 1 2 5000", "three readings"),
    ],
)
def test_commands_that_make_no_sense_say_why(host, command, words):
    with pytest.raises(FaultCommandError, match=words):
        inject(host.boards, command)


def test_what_comes_out_does_not_depend_on_how_often_one_looks(hosts):
    def told(step_s):
        host = hosts(seed=7).patient()
        host.say(SetTelemetry(5, 0))
        host.say(MoveVelocity(0, 30_000, 200))
        host.live(0.02)
        out = b""
        for k in range(round(0.4 / step_s)):
            out += host.boards.lines[0].advance(host.time_s + (k + 1) * step_s)
        return out

    assert told(0.4) == told(0.001) == told(0.02)


def test_idle_life_costs_little(host):
    for board in (1, 2):
        host.say(SetTelemetry(5, host.now_us(board) // 5000 * 5000), board)
    host.live(0.1)
    began_s = time.process_time()
    for k in range(200):
        host.boards.live(host.time_s + 0.005 * (k + 1))
    assert time.process_time() - began_s < 0.4  # 0.1 s on a machine that does nothing else


def test_a_stop_reaches_both_boards_on_their_own_lines(host):
    for board in (1, 2):
        host.write(STOP_BYTES, board)
    host.live(0.01)
    assert [note.board for note in host.boards.notes.stops] == [1, 2]
