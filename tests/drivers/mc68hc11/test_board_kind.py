"""Boards say themselves that they are programs; without that word they are real ones."""

import pytest

from rotemina.drivers.driver import MachineKind
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.mc68hc11.board_messages import BoardKind, Refused
from rotemina.drivers.mc68hc11.framing import Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import AskKind
from rotemina.drivers.mc68hc11.protocol_codes import Refusal


def replaced(change):
    """Return a filter of a line in which ``change`` replaces each message about the board's kind.

    It gets the frame and its bytes, and returns the bytes that arrive.
    """
    decoder = Decoder()

    def alter(data):
        return b"".join(
            change(frame, encoded(frame)) if frame.type == BoardKind.TYPE else encoded(frame)
            for frame in decoder.feed(data)
        )

    return alter


def older_firmware(frame, _data):
    refused = Refused(frame.number, Refusal.UNKNOWN_TYPE)
    return encoded(Frame(frame.address, frame.number, Refused.TYPE, refused.packed(), True))


def other_word(frame, _data):
    return encoded(frame._replace(payload=b"virtua"))


@pytest.fixture(params=[2, 1], ids=["a line each", "shared bus"])
def bench(request, robot, joined_bench):
    return joined_bench(robot, ports=request.param)


def opened_with(bench, change, *, lines=2):
    """Open the driver while what boards say of their kind is changed on some lines."""
    open_port = bench._opened

    def altered(url, baud):
        port = open_port(url, baud)
        if lines == 2 or url == "second":
            port.to_host = replaced(change)
        return port

    bench.driver._open_port = altered
    bench.driver.open()
    return bench.driver


def test_the_shipped_boards_say_that_they_are_virtual(bench):
    assert not bench.driver.is_identified
    bench.driver.open()
    assert bench.driver.machine_kind is MachineKind.VIRTUAL


@pytest.mark.parametrize(
    "change",
    [
        older_firmware,
        lambda _frame, _data: b"",
        lambda _frame, data: data[:4] + data[5:],
        lambda _frame, data: data.replace(b"v", b"w"),
        other_word,
    ],
    ids=["refused", "not answered", "a byte lost", "a byte changed", "another word"],
)
def test_boards_that_do_not_say_so_undamaged_are_a_real_machine(bench, change):
    assert opened_with(bench, change).machine_kind is MachineKind.REAL


def test_one_real_board_makes_a_real_machine(robot, joined_bench):
    driver = opened_with(joined_bench(robot, ports=2), older_firmware, lines=1)
    assert driver.machine_kind is MachineKind.REAL


def test_a_lost_answer_is_asked_for_again(bench):
    lost = []

    def lose_first(frame, data):
        if frame.address in lost:
            return data
        lost.append(frame.address)
        return b""

    assert opened_with(bench, lose_first).machine_kind is MachineKind.VIRTUAL
    assert sorted(lost) == [1, 2]


def test_lost_boards_stay_what_they_said_until_others_answer_at_their_port(bench):
    driver = bench.driver
    driver.open()
    for port in bench.ports:
        port.cut = True
    with pytest.raises(ConnectionLostError):
        bench.run(2.0)
    driver.close()
    assert driver.machine_kind is MachineKind.VIRTUAL
    assert opened_with(bench, older_firmware).machine_kind is MachineKind.REAL


def test_a_board_is_asked_with_a_frame_of_its_own():
    assert AskKind().packed() == b""
    assert BoardKind(b"virtual").packed() == b"virtual"
