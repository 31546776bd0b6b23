"""How boards move and halt their axes."""

from binascii import crc_hqx

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotemina.drivers.mc68hc11.board_messages import Captured, Done, Telemetry
from rotemina.drivers.mc68hc11.framing import STOP_BYTES
from rotemina.drivers.mc68hc11.host_messages import (
    AbortProfile,
    ArmProfile,
    BeginProfile,
    BeginStream,
    Capture,
    ClearFault,
    Home,
    MoveTo,
    MoveVelocity,
    Quadratic,
    Segments,
    SetPoint,
    SetTelemetry,
    SetVoltage,
    Stop,
    TriggerProfile,
    Watch,
)
from rotemina.drivers.mc68hc11.profile_upload import profile_of, segments_of
from rotemina.drivers.mc68hc11.protocol_codes import Fault, Refusal, State
from rotemina.drivers.virtual_board.fault_injection import inject

Z = 400_000  # where z stands at first


def test_a_move_arrives_and_the_machine_with_it(host):
    assert host.ask(MoveTo(0, 276_000, 100_000)) == Done(host.number)
    assert host.telemetry().state == State.MOVING
    host.live(0.3)
    sample = host.telemetry()
    assert sample.state == 0
    reading, command = sample.samples()[0]
    assert command == 276_000
    assert abs(reading - command) <= 3
    assert host.boards.machine.position[0] == pytest.approx(0.0276, abs=1e-6)


def test_a_lease_that_runs_out_halts_the_axis_without_a_fault(host):
    host.say(MoveVelocity(0, 10_000, 150))
    host.live(0.1)
    host.say(MoveVelocity(0, 10_000, 150))
    host.live(0.14)
    assert host.boards.boards[0].moving
    host.live(0.06)
    sample = host.telemetry()
    assert (sample.state, sample.fault) == (0, 0)
    # 250 ms at full speed, and 5 ms that starting and halting take together.
    assert host.commands()[0] - 275_000 == pytest.approx(2500, abs=60)


@pytest.mark.parametrize("in_flight", [b"", b"\x04\x01\x07"])
def test_a_stop_is_heard_within_a_byte_at_the_true_baud(host, in_flight):
    host.say(MoveVelocity(0, 50_000, 5000))
    host.live(0.3)
    written_s = host.time_s
    host.write(in_flight + STOP_BYTES)
    host.live(0.2)
    note = host.boards.notes.stops[0]
    first = (len(in_flight) + (2 if in_flight else 1)) * 80e-6
    assert note.heard_s - written_s == pytest.approx(first, abs=1e-9)
    # From 5 mm/s at 0.2 m/s² in 25 ms, and one tick.
    assert 0.022 < note.rest_s - note.heard_s < 0.0265
    assert host.refusal(MoveTo(0, 275_000, 1000)) == Refusal.FAULTY
    assert host.ask(ClearFault()) == Done(host.number)
    assert host.ask(MoveTo(0, 275_000, 1000)) == Done(host.number)


def test_a_stop_keeps_the_voltage_of_piezos(host):
    host.say(MoveVelocity(2, 5000, 5000), 2)
    host.live(0.5)
    at = host.commands(2)[2]
    host.say(Stop(), 2)
    host.live(0.01)
    assert host.commands(2)[2] == pytest.approx(at, abs=250)
    held = host.commands(2)
    host.live(1.0)
    assert host.commands(2) == held
    assert host.telemetry(2).fault == Fault.STOPPED


def test_braking_ends_before_a_fault_can_be_cleared(host):
    host.say(MoveVelocity(0, 100_000, 5000))
    host.live(0.3)
    host.write(STOP_BYTES)
    assert host.refusal(ClearFault()) == Refusal.FAULTY
    host.live(0.1)
    assert host.ask(ClearFault()) == Done(host.number)


def test_silence_halts_and_counts_only_once_a_host_spoke(hosts):
    host = hosts()
    host.live(2.0)
    assert host.boards.boards[0].fault is Fault.NONE
    host.ask(Watch(200))
    host.say(MoveVelocity(0, 10_000, 5000))
    host.live(0.19)
    assert host.boards.boards[0].fault is Fault.NONE
    host.live(0.03)
    assert host.boards.boards[0].fault is Fault.WATCHDOG
    host.live(0.05)
    assert not host.boards.moving
    assert host.boards.boards[1].fault is Fault.NONE


def test_the_first_fault_stays(host):
    host.say(Watch(50))
    host.live(0.1)
    host.write(STOP_BYTES)
    host.live(0.01)
    assert host.telemetry().fault == Fault.WATCHDOG


def test_homing_finds_where_the_machine_is(hosts):
    host = hosts(position_known=False, start_fraction=0.03).patient()
    host.ask(ClearFault())
    assert host.ask(Home(3)) == Done(host.number)
    assert host.refusal(MoveTo(0, 0, 1000)) == Refusal.NOT_HOMED
    assert host.telemetry().state & State.HOMING
    host.live(1.5)
    assert host.telemetry().state == State.POSITION_UNKNOWN  # z is not homed yet
    host.ask(Home(4))
    host.live(2.5)
    sample = host.telemetry()
    assert sample.state == 0
    for reading, command in sample.samples():
        assert command == 0
        assert abs(reading) < 20
    assert host.boards.machine.position[:3] == pytest.approx([0.0] * 3, abs=2e-6)


def test_a_limit_switch_halts_and_lets_go_in_the_other_direction(host):
    machine = host.boards.machine
    inject(host.boards, "lose x 280000")  # so far behind: just before the low switch
    host.live(0.4)
    host.telemetry()
    assert machine.position[0] < 0.0
    host.say(MoveVelocity(0, -10_000, 5000))
    host.live(0.7)
    sample = host.telemetry()
    assert sample.fault == Fault.LIMIT_SWITCH
    assert sample.switches & 1
    host.ask(ClearFault())
    host.say(MoveVelocity(0, 10_000, 500))
    host.live(0.6)
    sample = host.telemetry()
    assert (sample.fault, sample.switches & 1) == (0, 0)


def test_a_limit_switch_ends_a_stream_too(host):
    inject(host.boards, "lose x 280400")
    host.ask(SetTelemetry(5, 0))
    host.live(0.4)
    for index, _ in enumerate(streamed(host, 12)):
        host.say(SetPoint.of(index, 20, [(-1000 if index else 0, 0), (0, 0), (0, 0)]))
        host.live(0.01)
    host.live(0.1)
    assert host.telemetry().fault == Fault.LIMIT_SWITCH
    assert not host.boards.boards[0].stream.playing


def test_lost_steps_a_frozen_sensor_and_a_reset_show_in_telemetry(host):
    inject(host.boards, "lose x 40")
    host.live(0.2)
    reading, command = host.telemetry().samples()[0]
    assert command - reading == pytest.approx(40, abs=3)
    inject(host.boards, "freeze y")
    host.say(MoveTo(1, 276_000, 100_000))
    host.live(0.3)
    assert host.telemetry().samples()[1] == (275_000, 276_000)
    inject(host.boards, "thaw y")
    host.live(0.01)
    assert host.telemetry().samples()[1][0] > 275_990
    inject(host.boards, "brown-out 1")
    sample = host.telemetry()
    assert sample.fault == Fault.BROWN_OUT
    assert sample.state & State.POSITION_UNKNOWN
    assert sample.samples()[0] == (0, 0)
    assert sample.time_us < 1_000_000


def test_after_a_reset_piezos_go_to_zero_volts_no_faster_than_the_slew_limit(host):
    before = host.commands(2)[2]
    inject(host.boards, "reset 2")
    host.live(0.01)
    between = host.commands(2)[2]
    assert 0 < between < before
    host.live(0.5)
    assert host.commands(2) == [0, 0, 0]


@pytest.mark.parametrize(("axis", "end"), [(0, 58_177), (2, 65_000)])
def test_a_code_of_the_converter_moves_the_piezo_and_hardly_rings(host, axis, end):
    assert host.ask(SetVoltage(axis, 65_535), 2) == Done(host.number)
    machine, farthest = host.boards.machine, 0.0
    for _ in range(550):
        host.live(1e-3)
        machine.simulate()
        farthest = max(farthest, float(machine.position[3 + axis]))
    assert host.commands(2)[axis] == end
    most = end * float(machine.step[3 + axis])
    assert most < farthest < 1.001 * most


def streamed(host, count, hold=20, ahead_us=30_000):
    """Begin a stream; return its segments, each a set-point of 10 steps more in x."""
    begin_us = (host.now_us() + ahead_us) // 5000 * 5000
    host.ask(BeginStream(begin_us & 0xFFFF_FFFF, count, hold, 0))
    return [SetPoint.of(index % 256, hold, [(10, 0), (0, 0), (0, 0)]) for index in range(count)]


def test_a_stream_is_played_as_it_is_timed(host):
    host.say(SetTelemetry(5, 0))
    host.live(0.02)
    row = streamed(host, 120)
    begin_us = host.boards.boards[0].stream.starts_us
    before = len(host.heard)
    for segment in row:
        host.say(segment)
        host.live(0.01)
    host.live(0.1)
    sampled = [m for who, m, _ in host.heard if isinstance(m, Telemetry) and who == 1]
    commands = {one.time_us: one.samples()[0][1] for one in sampled}
    told = [commands[begin_us + 10_000 * index] for index in range(120)]
    assert told == [275_010 + 10 * index for index in range(120)]
    assert host.boards.boards[0].fault is Fault.NONE
    assert not host.boards.boards[0].stream.playing
    # What is there is told by telemetry alone.
    assert not [m for who, m, _ in host.heard[before:] if isinstance(m, Done) and who == 1]
    expected = [one.expected for one in sampled]
    assert max(expected) == 120
    assert expected[-1] == 0


@pytest.mark.parametrize("fraction", [0, 16])
def test_differences_are_added_up_as_the_chip_does(host, fraction):
    """Every tick, with its fraction; whole steps are where half a step more is cut off."""
    first, second = [(7 << fraction) + 1, -40 << fraction, 0], [-(1 << fraction >> 3), 1, -1]
    host.ask(BeginStream(host.now_us() + 30_000 & 0xFFFF_FFFF, 2, 1, fraction))
    host.say(SetPoint.of(0, 50, list(zip(first, second, strict=True))))
    host.say(SetPoint.of(1, 50, [(0, 0), (0, 0), (1 << fraction, 0)]))
    host.live(0.2)
    place = [(at << fraction) + (1 << fraction >> 1) for at in (275_000, 275_000, Z)]
    for _ in range(50):
        first = [one + two for one, two in zip(first, second, strict=True)]
        place = [one + two for one, two in zip(place, first, strict=True)]
    place[2] += 50 << fraction
    assert host.boards.boards[0].fault is Fault.NONE
    assert host.commands() == [one >> fraction for one in place]


def test_segments_are_taken_in_order_and_said_again_from_the_first_that_is_missing(host):
    row = streamed(host, 6, ahead_us=300_000)
    assert host.ask(row[0]) is None
    assert host.refusal(row[2]) == Refusal.OUT_OF_ORDER
    assert host.refusal(row[3]) == Refusal.OUT_OF_ORDER
    assert host.ask(row[1]) is None
    assert host.ask(row[0]) is None  # had already
    assert host.telemetry().expected == 2
    for segment in row[2:]:
        assert host.ask(segment) is None
    host.live(0.6)
    assert host.commands()[0] == 275_060
    assert host.boards.boards[0].fault is Fault.NONE


def test_the_queue_has_room_for_32(host):
    row = streamed(host, 36, ahead_us=1_000_000)
    answers = [host.ask(segment, within_s=0.006) for segment in row]
    assert answers[:32] == [None] * 32
    assert answers[32].reason == Refusal.QUEUE_FULL


def test_a_stream_that_runs_dry_or_comes_late_holds_where_it_was_sent_last(host):
    row = streamed(host, 5)
    for segment in row[:3]:
        host.say(segment)
    host.live(0.1)
    assert host.boards.boards[0].fault is Fault.LATE_SETPOINT
    host.live(0.1)
    assert host.commands()[0] == 275_030
    host.ask(ClearFault())
    late = streamed(host, 5, ahead_us=-5000)
    assert host.refusal(late[0]) == Refusal.OUT_OF_ORDER
    assert host.boards.boards[0].fault is Fault.LATE_SETPOINT
    assert host.commands()[0] == 275_030


def test_a_stream_begins_at_rest_only_and_with_something_in_it(host):
    begin_us = host.now_us() + 1_000_000
    assert host.refusal(BeginStream(begin_us, 0, 10, 0)) == Refusal.BAD_VALUE
    assert host.refusal(BeginStream(begin_us, 1, 0, 0)) == Refusal.BAD_VALUE
    assert host.refusal(BeginStream(begin_us, 1, 10, 17)) == Refusal.BAD_VALUE
    host.ask(BeginStream(begin_us, 2, 10, 0))
    assert host.refusal(BeginStream(begin_us, 2, 10, 0)) == Refusal.BUSY
    assert host.refusal(SetPoint.of(0, 15, [(0, 0)] * 3)) == Refusal.BAD_VALUE
    assert host.refusal(SetPoint.of(0, 10, [(0, 0)] * 2)) == Refusal.WRONG_LENGTH
    host.ask(Stop())
    host.ask(ClearFault())
    host.ask(MoveVelocity(0, 100, 500))
    assert host.refusal(BeginStream(begin_us, 2, 10, 0)) == Refusal.BUSY


def test_a_set_point_beyond_the_limits_halts(host):
    row = streamed(host, 3, ahead_us=100_000)
    host.ask(row[0])
    beyond = SetPoint.of(1, 20, [(275_000, 0), (0, 0), (0, 0)])
    assert host.refusal(beyond) == Refusal.BAD_VALUE
    assert host.boards.boards[0].fault is Fault.SOFT_LIMIT
    host.live(0.3)
    assert host.commands() == [275_000, 275_000, Z]


@pytest.mark.parametrize("index", [0, 1, 3])
def test_a_set_point_that_no_axis_reaches_in_its_time_halts(host, index):
    row = streamed(host, 5, ahead_us=200_000)
    for segment in row[:index]:
        assert host.ask(segment) is None
    # At 10 mm/s 1000 steps in 10 ms; the first one is where the axes stand.
    leap = SetPoint.of(index, 20, [(1002, 0), (0, 0), (0, 0)])
    assert host.refusal(leap) == Refusal.BAD_VALUE
    assert host.boards.boards[0].fault is Fault.TOO_FAST
    host.live(0.4)
    assert host.commands() == [275_000, 275_000, Z]


@pytest.mark.parametrize(("hold", "steps"), [(1, 500), (5, 500), (9, 500), (10, 502)])
def test_leaps_that_are_held_for_less_time_than_the_axis_needs_are_refused(host, hold, steps):
    """At 10 mm/s an axis makes 50 steps a tick: 500 at once take ten."""
    host.ask(BeginStream(host.now_us() + 100_000 & 0xFFFF_FFFF, 2, hold, 0))
    assert host.ask(SetPoint.of(0, 4 * hold, [(0, 0)] * 3)) is None
    leaps = SetPoint.of(1, 4 * hold, [(steps, 0), (0, 0), (0, 0)])
    assert host.refusal(leaps) == Refusal.BAD_VALUE
    assert host.boards.boards[0].fault is Fault.TOO_FAST
    host.live(0.3)
    assert host.commands() == [275_000, 275_000, Z]


def test_leaps_at_the_greatest_speed_are_played(host):
    host.ask(BeginStream(host.now_us() + 100_000 & 0xFFFF_FFFF, 2, 10, 0))
    host.say(SetPoint.of(0, 10, [(0, 0)] * 3))
    host.say(SetPoint.of(1, 40, [(500, 0), (0, 0), (0, 0)]))
    host.live(0.3)
    assert host.boards.boards[0].fault is Fault.NONE
    assert host.commands() == [277_000, 275_000, Z]


def thrust(host, *segments, board=2, axis=2, trigger=0):
    answers = [host.ask(one, board) for one in profile_of(axis, segments, trigger)]
    assert all(isinstance(one, Done) for one in answers), answers


def test_a_thrust_is_followed_at_the_boards_own_rate(host):
    """50 µm in 50 ms, out and back: 5 mm/s is what the axis may go at most."""
    host.ask(MoveTo(2, 5000, 5_000_000), 2)
    host.live(0.3)
    share = np.arange(101) / 100  # of 50 ms, at ticks of 0.5 ms
    out = 50_000 * (3.0 * share**2 - 2.0 * share**3)
    thrust(host, *segments_of(np.append(out, out[-2::-1])))
    assert host.telemetry(2).state == State.ARMED
    host.ask(Capture(4, 500, 400), 2, within_s=0.005)
    host.ask(TriggerProfile(), 2, within_s=0.01)
    host.live(0.4)
    frames = [m for who, m, _ in host.heard if isinstance(m, Captured) and who == 2]
    path = np.concatenate([np.frombuffer(one.samples, ">u2") for one in frames]).astype(float)
    assert len(path) == 400
    assert path.max() == pytest.approx(55_000, abs=700)
    assert np.abs(np.diff(path)).max() < 5000  # 1.5 · 50 µm / 50 ms · 0.5 ms, and vibration
    assert host.commands(2)[2] == 5000
    assert host.telemetry(2).state == 0


def test_a_button_triggers_and_a_profile_can_be_given_up(host):
    slow = Quadratic(2000, 5 << 16, 0)  # 10 000 steps in a second
    thrust(host, slow, trigger=1)
    assert host.refusal(TriggerProfile(), 2) == Refusal.OUT_OF_ORDER
    host.boards.set_inputs((0, 0, 0), 1, board=2)
    host.live(0.5)
    assert host.telemetry(2).state == State.MOVING | State.PLAYING
    assert host.refusal(MoveTo(2, 0, 1000), 2) == Refusal.BUSY
    assert host.ask(AbortProfile(), 2) == Done(host.number)
    sample = host.telemetry(2)
    assert (sample.state, sample.fault) == (0, 0)
    assert host.commands(2)[2] - 32_500 == pytest.approx(5500, abs=400)


def test_a_profile_beyond_the_limits_is_held_there(host):
    thrust(host, Quadratic(200, 200 << 16, 0))
    host.ask(TriggerProfile(), 2)
    host.live(0.2)
    sample = host.telemetry(2)
    assert sample.fault == Fault.SOFT_LIMIT
    assert 64_000 < sample.samples()[2][1] <= 65_000


def test_a_profile_too_fast_or_damaged_is_not_armed(host):
    one = Segments.of(0, [Quadratic(2, 25_000 << 16, 0)])
    host.ask(BeginProfile(2, 1), 2)
    assert host.refusal(Segments.of(1, [Quadratic(2, 0, 0)]), 2) == Refusal.OUT_OF_ORDER
    host.ask(one, 2)
    check = crc_hqx(one.packed(), 0xFFFF)
    assert host.refusal(ArmProfile(0, check), 2) == Refusal.BAD_VALUE
    assert host.refusal(ArmProfile(0, check ^ 1), 2) == Refusal.BAD_VALUE


_axes = st.integers(0, 2)
_any = st.integers(-(2**31), 2**31 - 1)
_near = st.integers(-50_000, 600_000)
_orders = st.one_of(
    st.builds(MoveTo, _axes, _near | _any, st.integers(0, 2**32 - 1)),
    st.builds(MoveVelocity, _axes, _any, st.integers(0, 2000)),
    st.builds(Stop),
    st.builds(ClearFault),
    st.builds(
        BeginStream,
        st.integers(0, 2**32 - 1),
        st.integers(0, 3),
        st.integers(0, 9),
        st.integers(0, 17),
    ),
    st.builds(
        SetPoint.of,
        st.integers(0, 2),
        st.integers(0, 500),
        st.lists(st.tuples(_near | _any, st.integers(-(2**23), 2**23 - 1)), max_size=3),
    ),
    st.builds(BeginProfile, _axes, st.just(1)),
    st.builds(TriggerProfile),
    st.builds(SetVoltage, _axes, st.integers(0, 65_535)),
)


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
@given(st.lists(st.tuples(_orders, st.integers(1, 2), st.integers(1, 300)), max_size=12))
def test_limits_are_kept_whatever_is_said(hosts, orders):
    host = hosts().patient()
    for order, board, pause_ms in orders:
        host.say(order, board)
        host.time_s += 1e-3 * pause_ms
        host.live(1e-3)
        for one in host.boards.boards:
            for axis, drive in enumerate(one.drives):
                assert one.kept.inside(axis, round(drive.position))


def test_a_stream_and_a_profile_lie_in_the_same_memory(host):
    thrust(host, Quadratic(200, 5 << 16, 0), board=1, axis=0)
    streamed(host, 3, ahead_us=100_000)
    assert host.refusal(TriggerProfile()) == Refusal.OUT_OF_ORDER
    assert host.refusal(BeginProfile(0, 1)) == Refusal.BUSY
    assert host.telemetry().state & State.ARMED == 0
