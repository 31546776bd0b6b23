"""What boards answer: the page of the protocol, line by line."""

import pytest

from rotemina.drivers.mc68hc11 import board_messages
from rotemina.drivers.mc68hc11.board_messages import Done, Refused
from rotemina.drivers.mc68hc11.framing import BROADCAST, RESYNC, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import (
    AskRates,
    Capture,
    ClearFault,
    DescribeAxis,
    Home,
    Identify,
    MoveTo,
    MoveVelocity,
    Poll,
    ReadParameter,
    SetTelemetry,
    SetVoltage,
    ShowText,
    Stop,
    Watch,
    WriteParameter,
)
from rotemina.drivers.mc68hc11.parameters import fingerprint, parameters_of
from rotemina.drivers.mc68hc11.protocol_codes import Ability, Fault, Refusal, State
from rotemina.sim.errors import InputError


def test_boards_say_who_they_are(host, robot):
    first, second = host.ask(Identify(1), 1), host.ask(Identify(9), 2)
    assert (first.version, first.axes, first.parameters, first.baud) == (2, 3, 24, 125_000)
    own = host.boards.boards[0].axes
    assert first.fingerprint == fingerprint(parameters_of(robot, own))
    assert first.abilities & Ability.HOMING
    assert not first.abilities & (Ability.DAC | Ability.HALF_DUPLEX)
    assert second.abilities & Ability.DAC
    assert not second.abilities & Ability.HOMING
    assert first.name != second.name


def test_axes_and_rates(host, robot):
    for number, axis in enumerate(host.boards.boards[1].axes):
        assert host.ask(DescribeAxis(number), 2) == axis.described(robot)
    assert host.ask(AskRates()) == board_messages.Rates(200, 50, 2000, 500, 100, 2000)


@pytest.mark.parametrize(
    ("said", "reason"),
    [
        (MoveTo(0, 600_000, 1000), Refusal.BAD_VALUE),
        (MoveTo(3, 0, 1000), Refusal.BAD_VALUE),
        (MoveTo(0, 1000, 0), Refusal.BAD_VALUE),
        (MoveVelocity(0, 10, 0), Refusal.BAD_VALUE),
        (DescribeAxis(3), Refusal.BAD_VALUE),
        (Watch(0), Refusal.BAD_VALUE),
        (ReadParameter(24), Refusal.BAD_VALUE),
        (WriteParameter(0, 600_000), Refusal.BAD_VALUE),
        (WriteParameter(2, 0), Refusal.BAD_VALUE),
        (SetVoltage(0, 1), Refusal.NOT_ABLE),
        (Home(8), Refusal.BAD_VALUE),
        (Home(0), Refusal.BAD_VALUE),
        (SetTelemetry(4, 0), Refusal.BAD_VALUE),
        (Capture(1, 400, 10), Refusal.BAD_VALUE),
        (ShowText(2, 0, b"x"), Refusal.BAD_VALUE),
        (ShowText(0, 18, b"xxx"), Refusal.BAD_VALUE),
    ],
)
def test_what_makes_no_sense_is_refused(host, said, reason):
    assert host.refusal(said) == reason


def test_unknown_types_and_wrong_lengths_are_refused(host):
    host.write(encoded(Frame(1, 200, 0x7F)))
    host.write(encoded(Frame(1, 201, DescribeAxis.TYPE, b"\0\0")))
    assert host.live(0.02) == [
        Refused(200, Refusal.UNKNOWN_TYPE),
        Refused(201, Refusal.WRONG_LENGTH),
    ]


def test_a_piezo_cannot_be_homed(host):
    assert host.refusal(Home(1), 2) == Refusal.NOT_ABLE


def test_a_frame_that_is_said_again_is_answered_again_and_not_executed(host):
    assert host.ask(MoveTo(0, 276_000, 100_000), number=9) == Done(9)
    host.live(0.3)
    assert host.ask(MoveTo(0, 275_000, 100_000)) == Done(host.number)
    host.live(0.3)
    # The same number as the one before, whatever it says now.
    number = host.number
    assert host.ask(MoveTo(0, 290_000, 100_000), number=number) == Done(number)
    host.live(0.3)
    assert host.commands()[0] == 275_000


def test_a_refusal_is_repeated_too_and_identify_is_always_executed(host):
    assert host.ask(MoveTo(0, 10**6, 1), number=5) == Refused(5, Refusal.BAD_VALUE)
    assert host.ask(MoveTo(0, 276_000, 1), number=5) == Refused(5, Refusal.BAD_VALUE)
    assert isinstance(host.ask(Identify(1), number=5), board_messages.Identity)


def test_frames_to_others_and_broken_ones_are_not_answered(host):
    host.write(host.wire(Identify(1), board=2), board=1)
    host.write(host.wire(Stop(), board=BROADCAST), board=2)
    broken = bytearray(host.wire(MoveTo(0, 0, 1000)))
    broken[3] ^= 4
    host.write(bytes(broken) + RESYNC)
    assert host.live(0.05) == []
    assert host.telemetry(2).fault == Fault.STOPPED
    assert host.commands(1)[0] == 275_000


def test_every_fourth_poll_tells_what_the_operator_holds(host):
    host.boards.set_inputs((1, 2048, 4095), buttons=2)
    answers = [host.ask(Poll()) for _ in range(8)]
    assert [isinstance(one, board_messages.Inputs) for one in answers] == [
        False,
        False,
        False,
        True,
    ] * 2
    assert answers[3].readings() == (1, 2048, 4095)
    assert answers[3].buttons == 2
    assert answers[4].switches == 2 << 6


def test_the_display_shows_what_it_is_told(host):
    assert host.ask(ShowText(1, 4, b"x = 1.5 um")) == Done(host.number)
    assert host.boards.lcd() == (" " * 20, "    x = 1.5 um      ")


def test_parameters_are_kept_over_a_reset_and_their_limits_hold(host):
    before = host.ask(Identify(1)).fingerprint
    assert host.ask(WriteParameter(1, 300_000)) == Done(host.number)
    assert host.ask(ReadParameter(1)) == board_messages.Parameter(1, 300_000)
    assert host.ask(Identify(1)).fingerprint != before
    assert host.refusal(MoveTo(0, 300_001, 1000)) == Refusal.BAD_VALUE
    host.boards.boards[0].reset(Fault.RESET)
    assert host.ask(ReadParameter(1)) == board_messages.Parameter(1, 300_000)


def test_parameters_hold_at_once_and_are_written_40_ms_each(host):
    host.ask(WriteParameter(1, 300_000), within_s=0.005)
    host.ask(WriteParameter(2, 90_000), within_s=0.005)
    assert host.ask(ReadParameter(2)) == board_messages.Parameter(2, 90_000)
    assert host.telemetry().state == State.WRITING
    host.boards.boards[0].reset(Fault.RESET)  # after 50 ms: the first one is written
    assert host.ask(ReadParameter(1)) == board_messages.Parameter(1, 300_000)
    assert host.ask(ReadParameter(2)) == board_messages.Parameter(2, 100_000)
    host.ask(WriteParameter(2, 90_000))
    assert host.telemetry().state & State.WRITING
    host.live(0.05)
    assert not host.telemetry().state & State.WRITING


def test_a_limit_that_is_written_behind_an_axis_lets_it_come_back_without_a_leap(host):
    assert host.ask(WriteParameter(1, 274_000)) == Done(host.number)
    assert host.commands()[0] == 275_000
    assert host.ask(MoveVelocity(0, 1000, 500)) == Done(host.number)
    host.live(0.2)
    assert host.commands()[0] == 275_000
    host.ask(MoveTo(0, 273_000, 10_000))
    host.live(0.02)
    assert 274_000 < host.commands()[0] < 275_000
    host.live(0.5)
    assert host.commands()[0] == 273_000


def test_nothing_is_written_while_an_axis_moves(host):
    host.ask(MoveTo(0, 400_000, 10_000))
    assert host.telemetry().state == State.MOVING
    assert host.refusal(WriteParameter(2, 5)) == Refusal.BUSY


def test_after_power_up_nothing_moves_but_homing(hosts):
    host = hosts(position_known=False).patient()
    sample = host.telemetry()
    assert sample.fault == Fault.RESET
    assert sample.state == State.FAULT | State.POSITION_UNKNOWN
    assert host.commands() == [0, 0, 0]
    assert host.refusal(MoveTo(0, 1, 1000)) == Refusal.FAULTY
    assert host.refusal(Home(7)) == Refusal.FAULTY
    assert host.ask(ClearFault()) == Done(host.number)
    assert host.refusal(MoveTo(0, 1, 1000)) == Refusal.NOT_HOMED
    assert host.refusal(MoveVelocity(0, 1, 1000)) == Refusal.NOT_HOMED
    # A board with piezos alone knows where they are, once their voltages have come down.
    host.live(1.0)
    assert host.telemetry(2).state == State.FAULT
    assert host.ask(ClearFault(), 2) == Done(host.number)
    assert host.ask(MoveTo(0, 100, 1000), 2) == Done(host.number)


def test_robots_that_boards_cannot_move_and_lines_that_are_none(one_board, hosts):
    with pytest.raises(InputError, match="moved by a force"):
        hosts(robot=one_board.emps)
    with pytest.raises(InputError, match="need only one board"):
        hosts(robot=one_board.fsm, ports=2)
    with pytest.raises(InputError, match="9600"):
        hosts(baud=19_200)
    host = hosts(robot=one_board.fsm, ports=1)
    assert not host.ask(Identify(1)).abilities & Ability.HALF_DUPLEX
