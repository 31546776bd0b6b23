"""Opening fails with an explanation if the wrong device, or none, is connected."""

import pytest

from rotemina.drivers.contract import (
    DeviceState,
    DriverError,
    DriverTimeoutError,
    ProtocolError,
    VirtualClock,
)
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.mc68hc11.protocol import (
    BoardIdentity,
    FrameDecoder,
    FrameRefused,
    RefusalReason,
    SerialFrame,
    Telemetry,
    encode_frame,
)
from rotemina.sim.robot_files import load_robot


class ScriptedPort:
    """A port at which a function answers each frame."""

    def __init__(self, answer):
        self.answer = answer
        self.decoder = FrameDecoder(is_board=True)
        self.reply = b""
        self.is_closed = False

    def read(self):
        reply, self.reply = self.reply, b""
        return reply

    def write(self, data):
        for frame in self.decoder.feed(data):
            self.reply += self.answer(frame)

    def waiting(self):
        return 0

    def close(self):
        self.is_closed = True


def make_driver_with_answer(robot, answer):
    clock = VirtualClock()
    port = ScriptedPort(answer)
    driver = MC68HC11Driver(
        robot,
        {"port": "first"},
        clock=clock,
        open_port=lambda url, baud: port,
        pause=clock.advance,
    )
    return driver, port, clock


def encode_reply(address, message):
    return encode_frame(SerialFrame(address, 0, message.TYPE, message.pack(), from_board=True))


def answer_with_identity(version=2, axes=3):
    message = BoardIdentity(version, 0xFFFF, axes, 125_000, 24, 0, b"other")
    return lambda frame: encode_reply(frame.address, message)


def answer_with_older_identity(frame):
    return encode_frame(
        SerialFrame(frame.address, 0, BoardIdentity.TYPE, b"\x01\xff", from_board=True)
    )


def answer_with_refusal(frame):
    refusal = FrameRefused(frame.number, RefusalReason.WRONG_LENGTH)
    return encode_reply(frame.address, refusal)


OTHER_PROGRAM = "not in version 2 of the protocol.*update the board's"


@pytest.mark.parametrize(
    ("answer", "error", "match"),
    [
        (
            lambda _: b"ok\r\n\x00ok\r\n\x00",
            ProtocolError,
            r"\d+ bytes arrive at 125000 baud, but no valid.* whether an MC68HC11 board",
        ),
        (encode_frame, DriverTimeoutError, r"this program receives its own frames \(7\)"),
        (answer_with_older_identity, ProtocolError, OTHER_PROGRAM),
        (answer_with_refusal, ProtocolError, OTHER_PROGRAM),
        (
            lambda _: encode_reply(3, Telemetry(1, 0, 0, 0, 0, bytes(15))),
            ProtocolError,
            "board 3 answers there instead; swap the cables",
        ),
        (lambda _: b"", DriverTimeoutError, "no answer at 125000 baud.*9600"),
        (
            answer_with_identity(version=3),
            ProtocolError,
            "version 3 .* this program 2; update the program",
        ),
        (answer_with_identity(version=1), ProtocolError, "update the board's program"),
        (answer_with_identity(axes=2), DriverError, "has 2 axes.*has 3.*robot file"),
    ],
)
def test_a_wrong_answer_is_explained_and_the_port_closed(robot, answer, error, match):
    driver, port, clock = make_driver_with_answer(robot, answer)
    with pytest.raises(error, match=match):
        driver.open()
    assert port.is_closed
    assert driver.status().state is DeviceState.CLOSED
    assert clock() < 3.0


def test_swapped_boards_are_refused(robot, make_bench):
    # The axes of the second board come first, so that piezos take the place of steppers.
    bench = make_bench(robot)
    other_urls = {"first": "second", "second": "first"}
    bench.driver._open_port = lambda url, baud: bench._open_port(other_urls[url], baud)
    with pytest.raises(DriverError, match=r"no answer at"):
        bench.driver.open()
    assert all(port.is_closed for port in bench.ports)


def test_a_robot_without_boards_is_refused():
    driver, _, _ = make_driver_with_answer(load_robot("emps"), lambda _: b"")
    with pytest.raises(DriverError, match="boards"):
        driver.open()


def test_opening_succeeds_at_the_second_attempt(robot, make_bench):
    bench = make_bench(robot)
    bench.driver._open_port = lambda url, baud: _drop_first_frames(bench._open_port(url, baud))
    bench.driver.open()
    assert bench.driver.status().state is DeviceState.IDLE


def _drop_first_frames(port):
    is_delivered = iter((False, True, False, False))
    port.to_board = lambda data: data if next(is_delivered, True) else b""
    return port


@pytest.mark.parametrize("number", [0, 128, 255])
def test_opening_works_after_any_frame_number(robot, number, make_bench):
    bench = make_bench(robot)
    bench.clock.advance(number / 1e3)
    bench.begin_s = bench.clock()
    bench.driver.open()
    bench.driver.close()
    bench.driver.open()
    assert bench.driver.status().state is DeviceState.IDLE
