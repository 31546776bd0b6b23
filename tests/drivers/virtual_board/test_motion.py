"""How boards move and halt their axes."""

from binascii import crc_hqx
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotemina.drivers.mc68hc11.codes import Fault, Refusal, State
from rotemina.drivers.mc68hc11.framing import STOP_BYTES
from rotemina.drivers.mc68hc11.reports import Captured, Done, Telemetry
from rotemina.drivers.mc68hc11.requests import (
    AbortProfile,
    ArmProfile,
    BeginProfile,
    Capture,
    ClearFault,
    Home,
    MoveTo,
    MoveVelocity,
    Segment,
    SetPoint,
    SetTelemetry,
    SetVoltage,
    Stop,
    TriggerProfile,
    Watch,
)
from rotemina.drivers.virtual_board.faults import inject

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
    row = points(host, 12)
    for index, point in enumerate(row):
        host.say(replace(point, first=275_000 - 1000 * index))
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
    host.live(0.1)
    assert host.commands(2) == [0, 0, 0]


def test_a_code_of_the_converter_moves_the_piezo(host):
    assert host.ask(SetVoltage(2, 65_535), 2) == Done(host.number)
    host.live(0.2)
    assert host.commands(2)[2] == 65_000
    assert host.boards.machine.position[5] == pytest.approx(65e-6, rel=1e-3)


def points(host, count, period_us=10_000, ahead_us=30_000):
    begin_us = (host.now_us() + ahead_us) // 5000 * 5000
    return [
        SetPoint(
            index % 256,
            min(count - 1 - index, 255),
            (begin_us + index * period_us) & 0xFFFF_FFFF,
            275_000 + 10 * index,
            275_000,
            Z,
        )
        for index in range(count)
    ]


def test_a_stream_is_played_as_it_is_timed(host):
    host.say(SetTelemetry(5, 0))
    host.live(0.02)
    row = points(host, 120)
    for point in row:
        host.say(point)
        host.live(0.01)
    host.live(0.1)
    sampled = [m for who, m, _ in host.heard if isinstance(m, Telemetry) and who == 1]
    commands = {one.time_us: one.samples()[0][1] for one in sampled}
    told = [commands[point.time_us] for point in row if point.time_us in commands]
    wanted = [point.first for point in row if point.time_us in commands]
    assert len(wanted) == 120
    assert told == wanted
    assert host.boards.boards[0].fault is Fault.NONE
    assert not host.boards.boards[0].stream.playing


def test_set_points_are_taken_in_order_and_said_again_from_the_first_that_is_missing(host):
    row = points(host, 6, ahead_us=300_000)
    assert host.ask(row[0]) == Done(host.number)
    assert host.refusal(row[2]) == Refusal.OUT_OF_ORDER
    assert host.refusal(row[3]) == Refusal.OUT_OF_ORDER
    assert host.ask(row[1]) == Done(host.number)
    assert host.ask(row[0]) == Done(host.number)  # had already
    for point in row[2:]:
        assert host.ask(point) == Done(host.number)
    host.live(0.6)
    assert host.commands()[0] == 275_050
    assert host.boards.boards[0].fault is Fault.NONE


def test_the_queue_has_room_for_sixteen(host):
    row = points(host, 20, ahead_us=1_000_000)
    answers = [host.ask(point) for point in row]
    assert [isinstance(one, Done) for one in answers] == [True] * 16 + [False] * 4
    assert answers[16].reason == Refusal.QUEUE_FULL


def test_a_stream_that_runs_dry_or_comes_late_holds_where_it_was_sent_last(host):
    row = points(host, 5)
    for point in row[:3]:
        host.say(point)
    host.live(0.1)
    assert host.boards.boards[0].fault is Fault.LATE_SETPOINT
    host.live(0.1)
    assert host.commands()[0] == 275_020
    host.ask(ClearFault())
    late = points(host, 5, ahead_us=-5000)
    assert host.refusal(late[0]) == Refusal.FAULTY
    assert host.boards.boards[0].fault is Fault.LATE_SETPOINT
    assert host.commands()[0] == 275_020


def test_a_set_point_beyond_the_limits_halts(host):
    row = points(host, 3, ahead_us=100_000)
    host.ask(row[0])
    beyond = SetPoint(1, 1, row[1].time_us, 550_001, 0, 0)
    assert host.refusal(beyond) == Refusal.BAD_VALUE
    assert host.boards.boards[0].fault is Fault.SOFT_LIMIT
    host.live(0.3)
    assert host.commands() == [275_000, 275_000, Z]


def thrust(host, *segments, board=2, axis=2, trigger=0):
    check = crc_hqx(b"".join(one.packed() for one in segments), 0xFFFF)
    said = [BeginProfile(axis, len(segments)), *segments, ArmProfile(trigger, check)]
    answers = [host.ask(one, board) for one in said]
    assert all(isinstance(one, Done) for one in answers), answers


def test_a_thrust_is_followed_at_the_boards_own_rate(host):
    """50 µm in 50 ms, out and back: 5 mm/s is what the axis may go at most."""
    host.ask(MoveTo(2, 5000, 5_000_000), 2)
    host.live(0.3)
    thrust(host, Segment(0, 50_000, 0, 150_000, -100_000), Segment(1, 50_000, 0, -150_000, 100_000))
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
    slow = Segment(0, 1_000_000, 10_000, 0, 0)
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
    thrust(host, Segment(0, 100_000, 40_000, 0, 0))
    host.ask(TriggerProfile(), 2)
    host.live(0.2)
    sample = host.telemetry(2)
    assert sample.fault == Fault.SOFT_LIMIT
    assert 64_000 < sample.samples()[2][1] <= 65_000


def test_a_profile_too_fast_or_damaged_is_not_armed(host):
    one = Segment(0, 1000, 50_000, 0, 0)
    host.ask(BeginProfile(2, 1), 2)
    assert host.refusal(Segment(1, 1000, 0, 0, 0), 2) == Refusal.OUT_OF_ORDER
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
        SetPoint, st.just(0), st.integers(0, 3), st.integers(0, 2**32 - 1), _near, _near, _near
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
    thrust(host, Segment(0, 100_000, 1000, 0, 0), board=1, axis=0)
    row = points(host, 3, ahead_us=100_000)
    host.ask(row[0])
    assert host.refusal(TriggerProfile()) == Refusal.OUT_OF_ORDER
    assert host.refusal(BeginProfile(0, 1)) == Refusal.BUSY
    assert host.telemetry().state & State.ARMED == 0
