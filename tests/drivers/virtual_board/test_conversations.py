"""Boards answer as the page about the protocol describes."""

import pytest

from rotemina.drivers.mc68hc11.protocol import (
    BROADCAST_ADDRESS,
    RESYNC_BYTES,
    BeginCapture,
    BoardAbility,
    BoardFault,
    BoardState,
    ClearFault,
    DescribeAxis,
    FrameDone,
    FrameRefused,
    HomeAxes,
    IdentifyBoard,
    MoveTo,
    MoveVelocity,
    PollBoard,
    ReadParameter,
    RefusalReason,
    SerialFrame,
    SetTelemetry,
    SetVoltage,
    SetWatchdog,
    ShowText,
    StopBoard,
    WriteParameter,
    board_messages,
    compute_fingerprint,
    encode_frame,
    make_parameters,
)
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot


def test_boards_identify_themselves(host, robot):
    first, second = host.ask(IdentifyBoard(1), 1), host.ask(IdentifyBoard(9), 2)
    assert (first.version, first.axes, first.parameters, first.baud) == (2, 3, 24, 125_000)
    axes = host.boards.boards[0].axes
    assert first.fingerprint == compute_fingerprint(make_parameters(robot, axes))
    assert first.abilities & BoardAbility.HOMING
    assert not first.abilities & (BoardAbility.DAC | BoardAbility.HALF_DUPLEX)
    assert second.abilities & BoardAbility.DAC
    assert not second.abilities & BoardAbility.HOMING
    assert first.name != second.name


def test_invalid_requests_are_refused(host):
    for message in (
        MoveTo(0, 600_000, 1000),
        MoveTo(3, 0, 1000),
        MoveTo(0, 1000, 0),
        MoveVelocity(0, 10, 0),
        DescribeAxis(3),
        SetWatchdog(0),
        ReadParameter(24),
        WriteParameter(0, 600_000),
        WriteParameter(2, 0),
        HomeAxes(8),
        HomeAxes(0),
        SetTelemetry(4, 0),
        BeginCapture(1, 400, 10),
        ShowText(2, 0, b"x"),
        ShowText(0, 18, b"xxx"),
    ):
        assert host.find_refusal_reason(message) == RefusalReason.BAD_VALUE, message
    assert host.find_refusal_reason(SetVoltage(0, 1)) == RefusalReason.NOT_ABLE
    # A piezo has no switch.
    assert host.find_refusal_reason(HomeAxes(1), 2) == RefusalReason.NOT_ABLE


def test_unknown_types_and_wrong_lengths_are_refused(host):
    host.write(encode_frame(SerialFrame(1, 200, 0x7F)))
    host.write(encode_frame(SerialFrame(1, 201, DescribeAxis.TYPE, b"\0\0")))
    assert host.run(0.02) == [
        FrameRefused(200, RefusalReason.UNKNOWN_TYPE),
        FrameRefused(201, RefusalReason.WRONG_LENGTH),
    ]


def test_a_repeated_frame_is_answered_again_but_not_executed_again(host):
    assert host.ask(MoveTo(0, 276_000, 100_000), number=9) == FrameDone(9)
    host.run(0.3)
    assert host.ask(MoveTo(0, 275_000, 100_000)) == FrameDone(host.number)
    host.run(0.3)
    # This frame has the number of the previous one, but another target.
    number = host.number
    assert host.ask(MoveTo(0, 290_000, 100_000), number=number) == FrameDone(number)
    host.run(0.3)
    assert host.read_commands()[0] == 275_000


def test_a_refusal_is_repeated_too_and_identify_is_always_executed(host):
    assert host.ask(MoveTo(0, 10**6, 1), number=5) == FrameRefused(5, RefusalReason.BAD_VALUE)
    assert host.ask(MoveTo(0, 276_000, 1), number=5) == FrameRefused(5, RefusalReason.BAD_VALUE)
    assert isinstance(host.ask(IdentifyBoard(1), number=5), board_messages.BoardIdentity)


def test_damaged_frames_and_frames_to_other_boards_are_not_answered(host):
    host.write(host.encode(IdentifyBoard(1), board=2), board=1)
    host.write(host.encode(StopBoard(), board=BROADCAST_ADDRESS), board=2)
    damaged = bytearray(host.encode(MoveTo(0, 0, 1000)))
    damaged[3] ^= 4
    host.write(bytes(damaged) + RESYNC_BYTES)
    assert host.run(0.05) == []
    assert host.read_telemetry(2).fault == BoardFault.STOPPED
    assert host.read_commands(1)[0] == 275_000


def test_every_fourth_poll_returns_the_operator_inputs(host):
    host.boards.set_inputs((1, 2048, 4095), buttons=2)
    answers = [host.ask(PollBoard()) for _ in range(8)]
    are_inputs = [isinstance(answer, board_messages.OperatorInputs) for answer in answers]
    assert are_inputs == [False, False, False, True] * 2
    assert answers[3].unpack_readings() == (1, 2048, 4095)
    assert answers[3].buttons == 2
    assert answers[4].switches == 2 << 6


def test_parameters_survive_a_reset_and_limit_motion(host):
    fingerprint_before = host.ask(IdentifyBoard(1)).fingerprint
    assert host.ask(WriteParameter(1, 300_000)) == FrameDone(host.number)
    assert host.ask(ReadParameter(1)) == board_messages.ParameterValue(1, 300_000)
    assert host.ask(IdentifyBoard(1)).fingerprint != fingerprint_before
    assert host.find_refusal_reason(MoveTo(0, 300_001, 1000)) == RefusalReason.BAD_VALUE
    host.boards.boards[0].reset(BoardFault.RESET)
    assert host.ask(ReadParameter(1)) == board_messages.ParameterValue(1, 300_000)


def test_parameters_apply_at_once_and_are_written_in_40_ms_each(host):
    host.ask(WriteParameter(1, 300_000), within_s=0.005)
    host.ask(WriteParameter(2, 90_000), within_s=0.005)
    assert host.ask(ReadParameter(2)) == board_messages.ParameterValue(2, 90_000)
    assert host.read_telemetry().state == BoardState.WRITING
    # After 50 ms, only the first parameter is written.
    host.boards.boards[0].reset(BoardFault.RESET)
    assert host.ask(ReadParameter(1)) == board_messages.ParameterValue(1, 300_000)
    assert host.ask(ReadParameter(2)) == board_messages.ParameterValue(2, 100_000)
    host.ask(WriteParameter(2, 90_000))
    assert host.read_telemetry().state & BoardState.WRITING
    host.run(0.05)
    assert not host.read_telemetry().state & BoardState.WRITING


def test_an_axis_beyond_a_new_limit_returns_without_a_jump(host):
    assert host.ask(WriteParameter(1, 274_000)) == FrameDone(host.number)
    assert host.read_commands()[0] == 275_000
    assert host.ask(MoveVelocity(0, 1000, 500)) == FrameDone(host.number)
    host.run(0.2)
    assert host.read_commands()[0] == 275_000
    host.ask(MoveTo(0, 273_000, 10_000))
    host.run(0.02)
    assert 274_000 < host.read_commands()[0] < 275_000
    host.run(0.5)
    assert host.read_commands()[0] == 273_000


def test_no_parameter_is_written_while_an_axis_moves(host):
    host.ask(MoveTo(0, 400_000, 10_000))
    assert host.read_telemetry().state == BoardState.MOVING
    assert host.find_refusal_reason(WriteParameter(2, 5)) == RefusalReason.BUSY


def test_after_power_up_only_homing_may_move(make_host):
    host = make_host(position_known=False).with_long_watchdogs()
    sample = host.read_telemetry()
    assert sample.fault == BoardFault.RESET
    assert sample.state == BoardState.FAULT | BoardState.POSITION_UNKNOWN
    assert host.read_commands() == [0, 0, 0]
    assert host.find_refusal_reason(MoveTo(0, 1, 1000)) == RefusalReason.FAULTY
    assert host.find_refusal_reason(HomeAxes(7)) == RefusalReason.FAULTY
    assert host.ask(ClearFault()) == FrameDone(host.number)
    assert host.find_refusal_reason(MoveTo(0, 1, 1000)) == RefusalReason.NOT_HOMED
    assert host.find_refusal_reason(MoveVelocity(0, 1, 1000)) == RefusalReason.NOT_HOMED
    # A board with only piezos knows their positions when their voltages have decreased to zero.
    host.run(1.0)
    assert host.read_telemetry(2).state == BoardState.FAULT
    assert host.ask(ClearFault(), 2) == FrameDone(host.number)
    assert host.ask(MoveTo(0, 100, 1000), 2) == FrameDone(host.number)


def test_unsuitable_robots_and_lines_are_refused(make_host):
    with pytest.raises(InputError, match="moved by a force"):
        make_host(robot=load_robot("emps"))
    with pytest.raises(InputError, match="need only one board"):
        make_host(robot=load_robot("fsm"), ports=2)
    with pytest.raises(InputError, match="9600"):
        make_host(baud=19_200)
    host = make_host(robot=load_robot("fsm"), ports=1)
    assert not host.ask(IdentifyBoard(1)).abilities & BoardAbility.HALF_DUPLEX
