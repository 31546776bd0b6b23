"""Opening: what is said when the wrong thing, or nothing, is at the other end."""

import pytest

from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import DriverError, DriverTimeoutError, ProtocolError
from rotemina.drivers.mc68hc11.board_messages import Identity, Refused, Telemetry
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.mc68hc11.framing import Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.protocol_codes import Refusal
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.file import load_robot


class Scripted:
    """A port whose other end answers each frame as a function says."""

    def __init__(self, answer):
        self.answer = answer
        self.decoder = Decoder(of_board=True)
        self.said = b""
        self.closed = False

    def read(self):
        said, self.said = self.said, b""
        return said

    def write(self, data):
        for frame in self.decoder.feed(data):
            self.said += self.answer(frame)

    def waiting(self):
        return 0

    def close(self):
        self.closed = True


def opened(robot, answer):
    clock = VirtualClock()
    port = Scripted(answer)
    driver = MC68HC11(
        robot,
        {"port": "first"},
        clock=clock,
        open_port=lambda url, baud: port,
        pause=clock.advance,
    )
    return driver, port, clock


def identity(version=2, axes=3):
    message = Identity(version, 0xFFFF, axes, 125_000, 24, 0, b"other")
    return lambda frame: encoded(
        Frame(frame.address, 0, Identity.TYPE, message.packed(), from_board=True)
    )


def echo(frame):
    return encoded(frame)


def older_identity(frame):
    return encoded(Frame(frame.address, 0, Identity.TYPE, b"\x01\xff", from_board=True))


def refusal(frame):
    refused = Refused(frame.number, Refusal.WRONG_LENGTH)
    return encoded(Frame(frame.address, 0, Refused.TYPE, refused.packed(), from_board=True))


def board_3(_frame):
    telemetry = Telemetry(1, 0, 0, 0, 0, bytes(15))
    return encoded(Frame(3, 0, Telemetry.TYPE, telemetry.packed(), from_board=True))


@pytest.mark.parametrize(
    ("answer", "error", "match"),
    [
        (lambda _: b"Grbl", ProtocolError, r"\d+ bytes arrive at 125000 baud, but no valid"),
        (echo, DriverTimeoutError, r"what this program sends comes back \(7 frames\)"),
        (older_identity, ProtocolError, "not in version 2 of the protocol.*update the board's"),
        (refusal, ProtocolError, "not in version 2 of the protocol.*update the board's"),
        (board_3, ProtocolError, "board 3 answers there instead; exchange the cables"),
        (lambda _: b"", DriverTimeoutError, "no answer at 125000 baud.*9600"),
        (
            lambda _: b"\xf3\x81\x00\x9c\x1e\x00",
            ProtocolError,
            r"\d+ bytes arrive at 125000 baud, but no valid frame",
        ),
        (lambda _: b"ok\r\n\x00ok\r\n\x00", ProtocolError, "whether an MC68HC11 board"),
        (identity(version=3), ProtocolError, "version 3 .* this program 2; update the program"),
        (identity(version=1), ProtocolError, "update the board's program"),
        (identity(axes=2), DriverError, "has 2 axes.*has 3.*robot file"),
    ],
)
def test_the_wrong_end_is_told_apart_and_the_port_let_go(robot, answer, error, match):
    driver, port, clock = opened(robot, answer)
    with pytest.raises(error, match=match):
        driver.open()
    assert port.closed
    assert driver.status().state is DeviceState.CLOSED
    assert clock() < 3.0


def test_another_kind_of_axis_is_named(robot, joined_bench):
    # The axes of the second board first: piezos where steppers are wanted.
    bench = joined_bench(load_robot("rotemina"), ports=2)
    bench.driver._open_port = lambda url, baud: _swapped(bench, url)
    with pytest.raises(DriverError, match=r"no answer at"):
        bench.driver.open()
    assert all(port.closed for port in bench.ports)


def _swapped(bench, url):
    return bench._opened({"first": "second", "second": "first"}[url], 0)


def test_a_robot_that_no_board_moves_is_refused():
    driver, _, _ = opened(load_robot("emps"), lambda _: b"")
    with pytest.raises(DriverError, match="boards"):
        driver.open()


def test_it_opens_on_the_answers_of_the_second_try(robot, joined_bench):
    bench = joined_bench(robot)
    bench.driver._open_port = lambda url, baud: _deaf_at_first(bench._opened(url, baud))
    bench.driver.open()
    assert bench.driver.status().state is DeviceState.IDLE


def _deaf_at_first(port):
    frames = iter((False, True, False, False))
    port.to_board = lambda data: data if next(frames, True) else b""
    return port


@pytest.mark.parametrize("number", range(0, 256, 17))
def test_whatever_number_the_board_had_last(robot, number, joined_bench):
    bench = joined_bench(robot)
    bench.clock.advance(number / 1e3)
    bench.begin_s = bench.clock()
    bench.driver.open()
    bench.driver.close()
    bench.driver.open()
    assert bench.driver.status().state is DeviceState.IDLE
