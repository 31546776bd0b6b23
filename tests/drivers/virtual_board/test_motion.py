"""Boards move and stop their axes."""

from binascii import crc_hqx

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from rotemina.drivers.mc68hc11.profile_upload import fit_segments, make_segment_messages
from rotemina.drivers.mc68hc11.protocol import (
    STOP_BYTES,
    AbortProfile,
    ArmProfile,
    BeginCapture,
    BeginProfile,
    BeginStream,
    BoardFault,
    BoardState,
    CaptureSamples,
    ClearFault,
    FrameDone,
    HomeAxes,
    LoadSegments,
    MoveTo,
    MoveVelocity,
    QuadraticSegment,
    RefusalReason,
    SetTelemetry,
    SetVoltage,
    SetWatchdog,
    StopBoard,
    StreamSegment,
    Telemetry,
    TriggerProfile,
)
from rotemina.drivers.virtual_board import inject_fault

INITIAL_Z = 400_000


def test_an_expired_lease_stops_the_axis_without_a_fault(host):
    host.send(MoveVelocity(0, 10_000, 150))
    host.run(0.1)
    host.send(MoveVelocity(0, 10_000, 150))
    host.run(0.14)
    assert host.boards.boards[0].moving
    host.run(0.06)
    sample = host.read_telemetry()
    assert (sample.state, sample.fault) == (0, 0)
    # 250 ms at full speed, and 5 ms for acceleration and braking together.
    assert host.read_commands()[0] - 275_000 == pytest.approx(2500, abs=60)


@pytest.mark.parametrize("in_flight", [b"", b"\x04\x01\x07"])
def test_a_stop_takes_effect_within_a_byte_at_the_true_baud_rate(host, in_flight):
    host.send(MoveVelocity(0, 50_000, 5000))
    host.run(0.3)
    written_s = host.time_s
    host.write(in_flight + STOP_BYTES)
    # The axis still brakes.
    assert host.find_refusal_reason(ClearFault()) == RefusalReason.FAULTY
    host.run(0.2)
    note = host.boards.notes.stops[0]
    delay_s = (len(in_flight) + (2 if in_flight else 1)) * 80e-6
    assert note.received_s - written_s == pytest.approx(delay_s, abs=1e-9)
    # It brakes from 5 mm/s at 0.2 m/s² in 25 ms, and one tick.
    assert 0.022 < note.rest_s - note.received_s < 0.0265
    assert host.find_refusal_reason(MoveTo(0, 275_000, 1000)) == RefusalReason.FAULTY
    assert host.ask(ClearFault()) == FrameDone(host.number)
    assert host.ask(MoveTo(0, 275_000, 1000)) == FrameDone(host.number)


def test_a_stop_keeps_the_voltage_of_piezos(host):
    host.send(MoveVelocity(2, 5000, 5000), 2)
    host.run(0.5)
    position = host.read_commands(2)[2]
    host.send(StopBoard(), 2)
    host.run(0.01)
    assert host.read_commands(2)[2] == pytest.approx(position, abs=250)
    held_commands = host.read_commands(2)
    host.run(1.0)
    assert host.read_commands(2) == held_commands
    assert host.read_telemetry(2).fault == BoardFault.STOPPED


def test_the_watchdog_starts_with_the_first_frame_and_stops_the_axes(make_host):
    host = make_host()
    host.run(2.0)
    assert host.boards.boards[0].fault is BoardFault.NONE
    host.ask(SetWatchdog(200))
    host.send(MoveVelocity(0, 10_000, 5000))
    host.run(0.19)
    assert host.boards.boards[0].fault is BoardFault.NONE
    host.run(0.03)
    assert host.boards.boards[0].fault is BoardFault.WATCHDOG
    host.run(0.05)
    assert not host.boards.moving
    assert host.boards.boards[1].fault is BoardFault.NONE


def test_the_first_fault_is_kept(host):
    host.send(SetWatchdog(50))
    host.run(0.1)
    host.write(STOP_BYTES)
    host.run(0.01)
    assert host.read_telemetry().fault == BoardFault.WATCHDOG


def test_homing_finds_the_position_of_the_machine(make_host):
    host = make_host(position_known=False, start_fraction=0.03).with_long_watchdogs()
    host.ask(ClearFault())
    assert host.ask(HomeAxes(3)) == FrameDone(host.number)
    assert host.find_refusal_reason(MoveTo(0, 0, 1000)) == RefusalReason.NOT_HOMED
    assert host.read_telemetry().state & BoardState.HOMING
    host.run(1.5)
    assert host.read_telemetry().state == BoardState.POSITION_UNKNOWN  # because of z
    host.ask(HomeAxes(4))
    host.run(2.5)
    sample = host.read_telemetry()
    assert sample.state == 0
    for reading, command in sample.unpack_samples():
        assert command == 0
        assert abs(reading) < 20
    assert host.boards.machine.position[:3] == pytest.approx([0.0] * 3, abs=2e-6)


def test_a_limit_switch_stops_the_axis_but_not_in_the_other_direction(host):
    machine = host.boards.machine
    # The lost steps put the machine just before its low switch.
    inject_fault(host.boards, "lose x 280000")
    host.run(0.4)
    host.read_telemetry()
    assert machine.position[0] < 0.0
    host.send(MoveVelocity(0, -10_000, 5000))
    host.run(0.7)
    sample = host.read_telemetry()
    assert sample.fault == BoardFault.LIMIT_SWITCH
    assert sample.switches & 1
    host.ask(ClearFault())
    host.send(MoveVelocity(0, 10_000, 500))
    host.run(0.6)
    sample = host.read_telemetry()
    assert (sample.fault, sample.switches & 1) == (0, 0)


def test_a_limit_switch_ends_a_stream(host):
    inject_fault(host.boards, "lose x 280400")
    host.ask(SetTelemetry(5, 0))
    host.run(0.4)
    for index, _ in enumerate(begin_stream(host, 12)):
        host.send(
            StreamSegment.from_differences(index, 20, [(-1000 if index else 0, 0), (0, 0), (0, 0)])
        )
        host.run(0.01)
    host.run(0.1)
    assert host.read_telemetry().fault == BoardFault.LIMIT_SWITCH
    assert not host.boards.boards[0].stream.playing


def test_lost_steps_a_frozen_sensor_and_a_reset_show_in_telemetry(host):
    inject_fault(host.boards, "lose x 40")
    host.run(0.2)
    reading, command = host.read_telemetry().unpack_samples()[0]
    assert command - reading == pytest.approx(40, abs=3)
    inject_fault(host.boards, "freeze y")
    host.send(MoveTo(1, 276_000, 100_000))
    host.run(0.3)
    assert host.read_telemetry().unpack_samples()[1] == (275_000, 276_000)
    inject_fault(host.boards, "thaw y")
    host.run(0.01)
    assert host.read_telemetry().unpack_samples()[1][0] > 275_990
    inject_fault(host.boards, "brown-out 1")
    sample = host.read_telemetry()
    assert sample.fault == BoardFault.BROWN_OUT
    assert sample.state & BoardState.POSITION_UNKNOWN
    assert sample.unpack_samples()[0] == (0, 0)
    assert sample.time_us < 1_000_000


def test_after_a_reset_piezo_voltages_decrease_at_the_slew_limit(host):
    position_before = host.read_commands(2)[2]
    inject_fault(host.boards, "reset 2")
    host.run(0.01)
    position_between = host.read_commands(2)[2]
    assert 0 < position_between < position_before
    host.run(0.5)
    assert host.read_commands(2) == [0, 0, 0]


@pytest.mark.parametrize(("axis", "expected_steps"), [(0, 58_177), (2, 65_000)])
def test_a_piezo_hardly_rings_after_a_converter_code(host, axis, expected_steps):
    assert host.ask(SetVoltage(axis, 65_535), 2) == FrameDone(host.number)
    machine, max_position = host.boards.machine, 0.0
    for _ in range(550):
        host.run(1e-3)
        machine.simulate()
        max_position = max(max_position, float(machine.position[3 + axis]))
    assert host.read_commands(2)[axis] == expected_steps
    expected_position = expected_steps * float(machine.step_size[3 + axis])
    assert expected_position < max_position < 1.001 * expected_position


def begin_stream(host, count, hold=20, ahead_us=30_000):
    """Begin a stream, and return its segments. Each moves x by 10 steps."""
    begin_us = (host.read_time_us() + ahead_us) // 5000 * 5000
    host.ask(BeginStream(begin_us & 0xFFFF_FFFF, count, hold, 0))
    return [
        StreamSegment.from_differences(index % 256, hold, [(10, 0), (0, 0), (0, 0)])
        for index in range(count)
    ]


def test_a_stream_is_played_at_its_times(host):
    host.send(SetTelemetry(5, 0))
    host.run(0.02)
    segments = begin_stream(host, 120)
    begin_us = host.boards.boards[0].stream.next_start_us
    received_before = len(host.received)
    for segment in segments:
        host.send(segment)
        host.run(0.01)
    host.run(0.1)
    samples = [m for board, m, _ in host.received if isinstance(m, Telemetry) and board == 1]
    command_at = {sample.time_us: sample.unpack_samples()[0][1] for sample in samples}
    commands = [command_at[begin_us + 10_000 * index] for index in range(120)]
    assert commands == [275_010 + 10 * index for index in range(120)]
    assert host.boards.boards[0].fault is BoardFault.NONE
    assert not host.boards.boards[0].stream.playing
    # Only telemetry acknowledges segments.
    replies = [m for board, m, _ in host.received[received_before:] if board == 1]
    assert not [reply for reply in replies if isinstance(reply, FrameDone)]
    expected = [sample.next_segment_index for sample in samples]
    assert max(expected) == 120
    assert expected[-1] == 0


@pytest.mark.parametrize("fraction", [0, 16])
def test_differences_are_added_as_on_the_chip(host, fraction):
    """Differences are added in every tick with their fractions, and the sum is rounded."""
    first, second = [(7 << fraction) + 1, -40 << fraction, 0], [-(1 << fraction >> 3), 1, -1]
    host.ask(BeginStream(host.read_time_us() + 30_000 & 0xFFFF_FFFF, 2, 1, fraction))
    host.send(StreamSegment.from_differences(0, 50, list(zip(first, second, strict=True))))
    host.send(StreamSegment.from_differences(1, 50, [(0, 0), (0, 0), (1 << fraction, 0)]))
    host.run(0.2)
    positions = [
        (start << fraction) + (1 << fraction >> 1) for start in (275_000, 275_000, INITIAL_Z)
    ]
    for _ in range(50):
        first = [left + right for left, right in zip(first, second, strict=True)]
        positions = [left + right for left, right in zip(positions, first, strict=True)]
    positions[2] += 50 << fraction
    assert host.boards.boards[0].fault is BoardFault.NONE
    assert host.read_commands() == [position >> fraction for position in positions]


def test_segments_are_accepted_only_in_order(host):
    segments = begin_stream(host, 6, ahead_us=300_000)
    assert host.ask(segments[0]) is None
    assert host.find_refusal_reason(segments[2]) == RefusalReason.OUT_OF_ORDER
    assert host.find_refusal_reason(segments[3]) == RefusalReason.OUT_OF_ORDER
    assert host.ask(segments[1]) is None
    # The board already has this segment.
    assert host.ask(segments[0]) is None
    assert host.read_telemetry().next_segment_index == 2
    for segment in segments[2:]:
        assert host.ask(segment) is None
    host.run(0.6)
    assert host.read_commands()[0] == 275_060
    assert host.boards.boards[0].fault is BoardFault.NONE


def test_the_queue_has_room_for_32_segments(host):
    segments = begin_stream(host, 36, ahead_us=1_000_000)
    answers = [host.ask(segment, within_s=0.006) for segment in segments]
    assert answers[:32] == [None] * 32
    assert answers[32].reason == RefusalReason.QUEUE_FULL


def test_an_empty_or_late_stream_stops_at_its_last_set_point(host):
    segments = begin_stream(host, 5)
    for segment in segments[:3]:
        host.send(segment)
    host.run(0.1)
    assert host.boards.boards[0].fault is BoardFault.LATE_SETPOINT
    host.run(0.1)
    assert host.read_commands()[0] == 275_030
    host.ask(ClearFault())
    late_segments = begin_stream(host, 5, ahead_us=-5000)
    assert host.find_refusal_reason(late_segments[0]) == RefusalReason.OUT_OF_ORDER
    assert host.boards.boards[0].fault is BoardFault.LATE_SETPOINT
    assert host.read_commands()[0] == 275_030


def test_a_stream_begins_only_at_rest_and_with_valid_values(host):
    begin_us = host.read_time_us() + 1_000_000
    assert host.find_refusal_reason(BeginStream(begin_us, 0, 10, 0)) == RefusalReason.BAD_VALUE
    assert host.find_refusal_reason(BeginStream(begin_us, 1, 0, 0)) == RefusalReason.BAD_VALUE
    assert host.find_refusal_reason(BeginStream(begin_us, 1, 10, 17)) == RefusalReason.BAD_VALUE
    host.ask(BeginStream(begin_us, 2, 10, 0))
    assert host.find_refusal_reason(BeginStream(begin_us, 2, 10, 0)) == RefusalReason.BUSY
    assert (
        host.find_refusal_reason(StreamSegment.from_differences(0, 15, [(0, 0)] * 3))
        == RefusalReason.BAD_VALUE
    )
    assert (
        host.find_refusal_reason(StreamSegment.from_differences(0, 10, [(0, 0)] * 2))
        == RefusalReason.WRONG_LENGTH
    )
    host.ask(StopBoard())
    host.ask(ClearFault())
    host.ask(MoveVelocity(0, 100, 500))
    assert host.find_refusal_reason(BeginStream(begin_us, 2, 10, 0)) == RefusalReason.BUSY


def test_a_set_point_beyond_the_limits_is_a_fault(host):
    segments = begin_stream(host, 3, ahead_us=100_000)
    host.ask(segments[0])
    beyond = StreamSegment.from_differences(1, 20, [(275_000, 0), (0, 0), (0, 0)])
    assert host.find_refusal_reason(beyond) == RefusalReason.BAD_VALUE
    assert host.boards.boards[0].fault is BoardFault.SOFT_LIMIT
    host.run(0.3)
    assert host.read_commands() == [275_000, 275_000, INITIAL_Z]


@pytest.mark.parametrize("index", [0, 3])
def test_a_set_point_that_is_too_far_away_is_a_fault(host, index):
    segments = begin_stream(host, 5, ahead_us=200_000)
    for segment in segments[:index]:
        assert host.ask(segment) is None
    # At 10 mm/s, an axis makes 1000 steps in 10 ms. The first set-point is the present position.
    jump = StreamSegment.from_differences(index, 20, [(1002, 0), (0, 0), (0, 0)])
    assert host.find_refusal_reason(jump) == RefusalReason.BAD_VALUE
    assert host.boards.boards[0].fault is BoardFault.TOO_FAST
    host.run(0.4)
    assert host.read_commands() == [275_000, 275_000, INITIAL_Z]


@pytest.mark.parametrize(
    ("hold", "steps", "is_allowed"),
    [(1, 500, False), (9, 500, False), (10, 502, False), (10, 500, True)],
)
def test_jumps_that_are_held_too_briefly_are_refused(host, hold, steps, is_allowed):
    """At 10 mm/s an axis makes 50 steps per tick, so 500 steps at once take ten ticks."""
    host.ask(BeginStream(host.read_time_us() + 100_000 & 0xFFFF_FFFF, 2, hold, 0))
    assert host.ask(StreamSegment.from_differences(0, 4 * hold, [(0, 0)] * 3)) is None
    jumps = StreamSegment.from_differences(1, 4 * hold, [(steps, 0), (0, 0), (0, 0)])
    answer = host.ask(jumps)
    assert getattr(answer, "reason", None) == (None if is_allowed else RefusalReason.BAD_VALUE)
    host.run(0.3)
    fault, distance = (BoardFault.NONE, 4 * steps) if is_allowed else (BoardFault.TOO_FAST, 0)
    assert host.boards.boards[0].fault is fault
    assert host.read_commands() == [275_000 + distance, 275_000, INITIAL_Z]


def upload_profile(host, *segments, board=2, axis=2, trigger=0):
    messages = make_segment_messages(axis, segments, trigger)
    answers = [host.ask(message, board) for message in messages]
    assert all(isinstance(answer, FrameDone) for answer in answers), answers


def test_a_profile_is_followed_at_the_rate_of_the_board(host):
    """The profile moves 50 µm in 50 ms and back. The maximum speed of the axis is 5 mm/s."""
    host.ask(MoveTo(2, 5000, 5_000_000), 2)
    host.run(0.3)
    # Fraction of 50 ms at each tick of 0.5 ms.
    fraction = np.arange(101) / 100
    forward_path = 50_000 * (3.0 * fraction**2 - 2.0 * fraction**3)
    upload_profile(host, *fit_segments(np.append(forward_path, forward_path[-2::-1])))
    assert host.read_telemetry(2).state == BoardState.ARMED
    host.ask(BeginCapture(4, 500, 400), 2, within_s=0.005)
    host.ask(TriggerProfile(), 2, within_s=0.01)
    host.run(0.4)
    frames = [m for board, m, _ in host.received if isinstance(m, CaptureSamples) and board == 2]
    path = np.concatenate([np.frombuffer(frame.samples, ">u2") for frame in frames]).astype(float)
    assert len(path) == 400
    assert path.max() == pytest.approx(55_000, abs=700)
    # The bound is above 1.5 · 50 µm / 50 ms · 0.5 ms, because the axis vibrates.
    assert np.abs(np.diff(path)).max() < 5000
    assert host.read_commands(2)[2] == 5000
    assert host.read_telemetry(2).state == 0


def test_a_button_triggers_a_profile_that_can_be_aborted(host):
    # 10 000 steps in a second.
    slow_segment = QuadraticSegment(2000, 5 << 16, 0)
    upload_profile(host, slow_segment, trigger=1)
    assert host.find_refusal_reason(TriggerProfile(), 2) == RefusalReason.OUT_OF_ORDER
    host.boards.set_inputs((0, 0, 0), 1, board=2)
    host.run(0.5)
    assert host.read_telemetry(2).state == BoardState.MOVING | BoardState.PLAYING
    assert host.find_refusal_reason(MoveTo(2, 0, 1000), 2) == RefusalReason.BUSY
    assert host.ask(AbortProfile(), 2) == FrameDone(host.number)
    sample = host.read_telemetry(2)
    assert (sample.state, sample.fault) == (0, 0)
    assert host.read_commands(2)[2] - 32_500 == pytest.approx(5500, abs=400)


def test_a_profile_beyond_the_limits_stops_at_the_limit(host):
    upload_profile(host, QuadraticSegment(200, 200 << 16, 0))
    host.ask(TriggerProfile(), 2)
    host.run(0.2)
    sample = host.read_telemetry(2)
    assert sample.fault == BoardFault.SOFT_LIMIT
    assert 64_000 < sample.unpack_samples()[2][1] <= 65_000


def test_a_damaged_profile_or_one_that_is_too_fast_is_not_armed(host):
    load_segments = LoadSegments.from_segments(0, [QuadraticSegment(2, 25_000 << 16, 0)])
    host.ask(BeginProfile(2, 1), 2)
    assert (
        host.find_refusal_reason(LoadSegments.from_segments(1, [QuadraticSegment(2, 0, 0)]), 2)
        == RefusalReason.OUT_OF_ORDER
    )
    host.ask(load_segments, 2)
    crc = crc_hqx(load_segments.pack(), 0xFFFF)
    assert host.find_refusal_reason(ArmProfile(0, crc), 2) == RefusalReason.BAD_VALUE
    assert host.find_refusal_reason(ArmProfile(0, crc ^ 1), 2) == RefusalReason.BAD_VALUE


_axes = st.integers(0, 2)
_any_steps = st.integers(-(2**31), 2**31 - 1)
_near_steps = st.integers(-50_000, 600_000)
_orders = st.one_of(
    st.builds(MoveTo, _axes, _near_steps | _any_steps, st.integers(0, 2**32 - 1)),
    st.builds(MoveVelocity, _axes, _any_steps, st.integers(0, 2000)),
    st.builds(StopBoard),
    st.builds(ClearFault),
    st.builds(
        BeginStream,
        st.integers(0, 2**32 - 1),
        st.integers(0, 3),
        st.integers(0, 9),
        st.integers(0, 17),
    ),
    st.builds(
        StreamSegment.from_differences,
        st.integers(0, 2),
        st.integers(0, 500),
        st.lists(st.tuples(_near_steps | _any_steps, st.integers(-(2**23), 2**23 - 1)), max_size=3),
    ),
    st.builds(BeginProfile, _axes, st.just(1)),
    st.builds(TriggerProfile),
    st.builds(SetVoltage, _axes, st.integers(0, 65_535)),
)


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
@given(st.lists(st.tuples(_orders, st.integers(1, 2), st.integers(1, 300)), max_size=12))
def test_any_orders_keep_the_limits(make_host, orders):
    host = make_host().with_long_watchdogs()
    for order, board, pause_ms in orders:
        host.send(order, board)
        host.time_s += 1e-3 * pause_ms
        host.run(1e-3)
        for simulated_board in host.boards.boards:
            for axis, drive in enumerate(simulated_board.drives):
                assert simulated_board.parameters.is_inside(axis, round(drive.position))


def test_a_stream_and_a_profile_use_the_same_memory(host):
    upload_profile(host, QuadraticSegment(200, 5 << 16, 0), board=1, axis=0)
    begin_stream(host, 3, ahead_us=100_000)
    assert host.find_refusal_reason(TriggerProfile()) == RefusalReason.OUT_OF_ORDER
    assert host.find_refusal_reason(BeginProfile(0, 1)) == RefusalReason.BUSY
    assert host.read_telemetry().state & BoardState.ARMED == 0
