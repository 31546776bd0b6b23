"""Virtual boards report that they are virtual. All other boards count as real."""

import pytest

from rotemina.drivers.contract import ConnectionLostError, MachineKind
from rotemina.drivers.mc68hc11.protocol import (
    BoardKind,
    FrameDecoder,
    FrameRefused,
    RefusalReason,
    SerialFrame,
    encode_frame,
)


def replace_kind_messages(change):
    """Return a filter of a line that passes each message about the board's kind to ``change``.

    ``change`` gets the frame and its bytes, and returns the bytes that arrive.
    """
    decoder = FrameDecoder()

    def alter(data):
        return b"".join(
            change(frame, encode_frame(frame))
            if frame.type == BoardKind.TYPE
            else encode_frame(frame)
            for frame in decoder.feed(data)
        )

    return alter


def refuse_as_older_firmware(frame, _data):
    refused = FrameRefused(frame.number, RefusalReason.UNKNOWN_TYPE)
    return encode_frame(
        SerialFrame(frame.address, frame.number, FrameRefused.TYPE, refused.pack(), True)
    )


def answer_with_other_kind(frame, _data):
    return encode_frame(frame._replace(payload=b"virtua"))


@pytest.fixture(params=[2, 1], ids=["two lines", "shared bus"])
def bench(request, robot, make_bench):
    return make_bench(robot, ports=request.param)


def open_with_changed_kind(bench, change, *, lines=2):
    """Open the driver while the messages about the kind of board are changed on some lines."""
    open_port = bench._open_port

    def open_altered_port(url, baud):
        port = open_port(url, baud)
        if lines == 2 or url == "second":
            port.to_host = replace_kind_messages(change)
        return port

    bench.driver._open_port = open_altered_port
    bench.driver.open()
    return bench.driver


@pytest.mark.parametrize(
    "change",
    [
        refuse_as_older_firmware,
        lambda _frame, data: data[:4] + data[5:],
        answer_with_other_kind,
    ],
    ids=["refused", "lost byte", "other word"],
)
def test_boards_without_an_intact_virtual_report_are_real(bench, change):
    assert open_with_changed_kind(bench, change).machine_kind is MachineKind.REAL


def test_one_real_board_makes_a_real_machine(robot, make_bench):
    driver = open_with_changed_kind(make_bench(robot, ports=2), refuse_as_older_firmware, lines=1)
    assert driver.machine_kind is MachineKind.REAL


def test_the_kind_is_requested_again_after_a_lost_answer(bench):
    addresses_of_lost_answers = []

    def lose_first_answer(frame, data):
        if frame.address in addresses_of_lost_answers:
            return data
        addresses_of_lost_answers.append(frame.address)
        return b""

    assert open_with_changed_kind(bench, lose_first_answer).machine_kind is MachineKind.VIRTUAL
    assert sorted(addresses_of_lost_answers) == [1, 2]


def test_virtual_boards_keep_their_kind_until_other_boards_answer(bench):
    driver = bench.driver
    assert not driver.is_identified
    driver.open()
    assert driver.machine_kind is MachineKind.VIRTUAL
    bench.set_cut(True)
    with pytest.raises(ConnectionLostError):
        bench.run(2.0)
    driver.close()
    assert driver.machine_kind is MachineKind.VIRTUAL
    assert open_with_changed_kind(bench, refuse_as_older_firmware).machine_kind is MachineKind.REAL
