"""The ports of all kinds, also where the other end takes no bytes, and why one does not open."""

import os
import pty
import select
import socket
import struct
import threading
import time
import tty
from contextlib import closing
from functools import partial

import pytest
import serial
from serial.rfc2217 import PortManager

from rotemina.drivers import byte_channels
from rotemina.drivers.byte_channels import (
    ByteChannel,
    TelnetChannel,
    WindowsChannel,
    open_channel,
)
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.errors import ConnectionLostError, DriverError
from rotemina.drivers.serial_port import MAX_BLOCKED_S, SerialPort, UrgentBytes, open_port

STOP = UrgentBytes(b"!")


@pytest.fixture
def terminal():
    master, slave = pty.openpty()
    tty.setraw(slave)
    yield master, os.ttyname(slave)
    for each in (master, slave):
        try:
            os.close(each)
        except OSError:
            continue


class NarrowChannel(ByteChannel):
    """Takes so many bytes as there is room for."""

    def __init__(self, room=0):
        self.room = room
        self.out = b""
        self.calls = 0

    def read(self):
        return b""

    def write(self, data):
        self.calls += 1
        taken = data[: self.room]
        self.room -= len(taken)
        self.out += taken
        return len(taken)

    def close(self):
        self.room = 0


@pytest.fixture
def clock():
    return VirtualClock(1000.0)


@pytest.fixture
def channel():
    return NarrowChannel()


@pytest.fixture
def port(channel, clock):
    return SerialPort("narrow", channel, clock)


def read_all(port, count):
    received = b""
    end_s = time.monotonic() + 2.0
    while len(received) < count and time.monotonic() < end_s:
        received += port.read()
    return received


def use(port):
    for _ in range(100):
        port.read()
        port.write(b"\0")


def use_in_vain(port):
    for _ in range(1024 // 8):
        port.write(b"8 bytes.")


def fill(port, piece):
    """Write until the system takes no more of what the other end does not read."""
    for _ in range(100_000):
        port.write(piece)
        if port._queue:
            return
    raise AssertionError("the port takes any number of bytes")


# --- what a port takes, and what waits -------------------------------------------------------


def test_what_the_port_does_not_take_is_sent_later_in_order_and_whole(port, channel):
    channel.room = 2
    port.write(b"first")
    port.write(b"second")
    assert channel.out == b"fi"
    assert port.waiting() == 9
    channel.room = 5
    port.read()
    assert channel.out == b"firstse"
    channel.room = 100
    port.write(b"third")
    assert channel.out == b"firstsecondthird"
    assert port.waiting() == 0


def test_a_stop_finishes_the_frame_under_way_and_replaces_what_waits(port, channel):
    channel.room = 2
    for frame in (b"begun", b"motion", b"more"):
        port.write(frame)
    port.write(STOP)
    port.write(b"after")
    channel.room = 100
    port.read()
    assert channel.out == b"begun!after"


def test_stops_of_two_kinds_keep_their_order_and_one_that_is_repeated_is_sent_once(port, channel):
    for data in (b"motion", STOP, STOP, UrgentBytes(b"\x18"), UrgentBytes(b"\x18"), b"?"):
        port.write(data)
    port.write(STOP)
    channel.room = 100
    port.read()
    assert channel.out == b"!\x18!"


def test_a_port_that_takes_nothing_is_lost_after_its_time_and_sends_nothing_old(
    port, channel, clock
):
    port.write(b"motion")
    clock.advance(MAX_BLOCKED_S)
    port.read()
    clock.advance(0.001)
    channel.room = 100
    with pytest.raises(ConnectionLostError, match="takes no more bytes: 6 bytes"):
        port.read()
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        port.write(b"more")
    with pytest.raises(ConnectionLostError, match="reconnect"):
        port.read()
    assert channel.out == b""


def test_a_stop_is_tried_even_on_a_port_that_is_lost(port, channel, clock):
    port.write(b"motion")
    clock.advance(60.0)
    channel.room = 100
    with pytest.raises(ConnectionLostError):
        port.write(STOP)
    assert channel.out == b"!"


def test_a_port_that_takes_byte_by_byte_is_not_lost(port, channel, clock):
    port.write(b"slowly")
    for _ in range(6):
        clock.advance(0.9 * MAX_BLOCKED_S)
        channel.room = 1
        port.read()
    assert channel.out == b"slowly"
    clock.advance(60.0)
    port.read()


def test_no_more_waits_than_the_bound_but_stops_do(port, channel):
    use_in_vain(port)
    port.write(STOP)
    port.write(b"fits again")
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        use_in_vain(port)


def test_a_blocked_port_is_tried_once_a_call(port, channel):
    port.write(b"motion")
    before = channel.calls
    port.read()
    assert channel.calls == before + 1


def test_frames_of_two_threads_are_not_torn_and_none_is_lost(port, channel):
    gate = threading.Barrier(2)

    def write(frame):
        gate.wait()
        for _ in range(100):
            port.write(frame)
            channel.room += 3

    threads = [threading.Thread(target=write, args=(frame,)) for frame in (b"<ab>", b"<cd>")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    channel.room = 10_000
    port.read()
    parts = channel.out.replace(b"<ab>", b"").replace(b"<cd>", b"")
    assert (len(channel.out), parts) == (800, b"")


# --- the kinds of ports ----------------------------------------------------------------------


def test_bytes_go_both_ways_and_nothing_waits(terminal):
    master, name = terminal
    port = open_port(name, 9600)
    begin_s = time.monotonic()
    assert port.read() == b""
    assert time.monotonic() - begin_s < 0.5
    port.write(b"\x00\x01\xff")
    assert os.read(master, 10) == b"\x00\x01\xff"
    os.write(master, bytes(range(256)))
    assert read_all(port, 256) == bytes(range(256))
    assert port.waiting() == 0
    port.close()
    port.close()


def read_descriptor(master):
    os.set_blocking(master, False)
    while True:
        try:
            yield os.read(master, 1 << 16)
        except BlockingIOError:
            return


def test_a_device_that_takes_no_bytes_blocks_neither_a_write_nor_a_stop(terminal, clock):
    master, name = terminal
    port = SerialPort(name, open_channel(name, 9600), clock)
    fill(port, b"x" * 500)
    port.write(STOP)
    port.read()
    assert port.waiting() > 0
    assert b"".join(read_descriptor(master)).strip(b"x") == b""
    port.read()
    received = b"".join(read_descriptor(master))
    assert (received.strip(b"x"), len(received) < 500) == (b"!", True)
    fill(port, b"x" * 500)
    clock.advance(MAX_BLOCKED_S + 0.001)
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        port.read()
    port.close()


def test_a_network_peer_that_takes_no_bytes_blocks_nothing(clock):
    with socket.create_server(("127.0.0.1", 0)) as server:
        url = f"socket://127.0.0.1:{server.getsockname()[1]}"
        port = SerialPort(url, open_channel(url, 9600), clock)
        accepted, _ = server.accept()
        with closing(port), accepted:
            fill(port, b"x" * 1_000_000)
            port.write(STOP)
            while port.waiting():
                accepted.recv(1 << 20)
                port.read()
            accepted.shutdown(socket.SHUT_WR)
            port.close()
            received = b"".join(iter(partial(accepted.recv, 1 << 20), b""))
            assert received.strip(b"x") == b"!"


class TelnetSerial:
    """What of pyserial's RFC 2217 port is used, on a pair of sockets."""

    def __init__(self, connection):
        connection.settimeout(5.0)  # as pyserial does
        self._socket = connection
        self._write_lock = threading.Lock()
        self.in_waiting = 0

    def read(self, _size):
        return b""

    def close(self):
        self._socket.close()


def test_a_remote_port_that_takes_no_bytes_blocks_nothing(clock):
    here, there = socket.socketpair()
    with there:
        fake = TelnetSerial(here)
        port = SerialPort("rfc2217://x", TelnetChannel(fake), clock)
        port.write(b"\x01\xff\xff\x02")
        assert there.recv(100) == b"\x01\xff\xff\xff\xff\x02"
        fill(port, b"x" * 100_000)
        with fake._write_lock:  # pyserial answers the server, and waits
            port.write(STOP)
        while port.waiting():
            there.recv(1 << 20)
            port.read()
        port.close()
        assert b"".join(iter(partial(there.recv, 1 << 20), b"")).strip(b"x") == b"!"


class WindowsSerial:
    """What of pyserial's COM port is used: every write is taken and completes later."""

    def __init__(self):
        self.out_waiting = 0
        self.out = b""
        self.discarded = False

    def read(self, _size):
        return b""

    def write(self, data):
        self.out += data
        self.out_waiting += len(data)
        return len(data)

    def reset_output_buffer(self):
        self.discarded = True

    def close(self):
        self.out_waiting = 0


def test_a_com_port_that_completes_no_write_is_not_given_more_and_more(clock):
    com = WindowsSerial()
    port = SerialPort("COM3", WindowsChannel(com), clock)
    for _ in range(20):
        port.write(b"0123456789abcdef")
    assert com.out == 16 * b"0123456789abcdef"
    port.write(STOP)
    com.out_waiting = 0
    port.read()
    assert com.out == 16 * b"0123456789abcdef" + b"!"
    for _ in range(17):
        port.write(b"0123456789abcdef")
    clock.advance(MAX_BLOCKED_S + 0.001)
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        port.read()
    port.close()
    assert com.discarded


def test_a_loop_gives_back_what_it_took_and_waits_when_it_is_full():
    port = open_port("loop://", 9600)
    port.write(b"x" * 4090)
    port.write(b"0123456789")
    assert port.waiting() == 4
    assert port.read() + port.read() == b"x" * 4090 + b"0123456789"
    port.close()


def serve_remote_port(server, device):
    """Serve RFC 2217 to one client, and read from it nothing but what it negotiates."""
    accepted, _ = server.accept()
    with accepted:
        connection = type("Connection", (), {"write": staticmethod(accepted.sendall)})()
        manager = PortManager(device, connection)
        while data := accepted.recv(1024):
            accepted.sendall(b"".join(manager.escape(b"".join(manager.filter(data)))))


@pytest.mark.filterwarnings("ignore:set(Daemon|Name):DeprecationWarning")
def test_a_remote_port_by_rfc_2217_echoes_every_byte():
    device = serial.serial_for_url("loop://", timeout=0)
    with socket.create_server(("127.0.0.1", 0)) as server:
        serving = threading.Thread(target=serve_remote_port, args=(server, device), daemon=True)
        serving.start()
        port = open_port(f"rfc2217://127.0.0.1:{server.getsockname()[1]}", 9600)
        port.write(bytes(range(256)))
        assert read_all(port, 256) == bytes(range(256))
        port.close()
        serving.join()


def test_a_kind_of_port_whose_writes_may_wait_is_refused(monkeypatch):
    class Waiting:
        def close(self):
            pass

    monkeypatch.setattr(byte_channels.serial, "serial_for_url", lambda *_, **__: Waiting())
    with pytest.raises(DriverError, match="a write to cp2110:// may wait"):
        open_port("cp2110://x", 9600)


# --- ports that are taken, gone or absent ----------------------------------------------------


def test_a_port_that_is_taken_says_so(terminal):
    _, name = terminal
    first = open_port(name, 9600)
    with pytest.raises(DriverError, match="another program uses it"):
        open_port(name, 9600)
    first.close()
    open_port(name, 9600).close()


def test_a_port_that_is_pulled_out_is_lost(terminal):
    master, name = terminal
    port = open_port(name, 9600)
    os.close(master)
    with pytest.raises(ConnectionLostError, match="the port has disappeared"):
        use(port)
    port.close()


def test_a_closed_port_is_lost(terminal):
    _, name = terminal
    port = open_port(name, 9600)
    port.close()
    with pytest.raises(ConnectionLostError):
        port.write(b"\0")


@pytest.mark.parametrize(
    ("error", "match"),
    [
        (PermissionError(13, "Permission denied"), "dialout"),
        (serial.SerialException(13, "could not open port x: Permission denied"), "dialout"),
        (serial.SerialException(16, "Device or resource busy"), "another program"),
        (serial.SerialException("could not open port 'COM3': PermissionError(13, ...)"), "dialout"),
        (serial.SerialException(2, "could not open port"), "no such port"),
        (ValueError("invalid URL, protocol 'x' not known"), "cannot be opened"),
    ],
)
def test_what_is_wrong_is_said_with_what_to_do(monkeypatch, error, match):
    def refuse(*_args, **_kwargs):
        raise error

    monkeypatch.setattr(byte_channels.serial, "serial_for_url", refuse)
    with pytest.raises(DriverError, match=match) as raised:
        open_port("/dev/ttyX", 9600)
    assert raised.value.__cause__ is error


def test_a_port_that_is_not_there():
    with pytest.raises(DriverError, match="no such port"):
        open_port("/dev/does-not-exist", 9600)
    with pytest.raises(DriverError, match="no serial port is set"):
        open_port("", 9600)


def test_a_socket_is_closed_though_its_other_end_is_gone():
    with socket.create_server(("127.0.0.1", 0)) as server:
        channel = open_channel(f"socket://127.0.0.1:{server.getsockname()[1]}", 9600)
        accepted, _ = server.accept()
        # With this option closing resets the connection, as a process does that is killed.
        accepted.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        accepted.close()
        connection = channel._serial._socket
        select.select([connection], [], [], 5.0)
        channel.close()
    assert connection.fileno() == -1


def test_a_socket_works_with_a_warning(caplog):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = open_port(f"socket://127.0.0.1:{server.getsockname()[1]}", 9600)
        assert "authenticated" in caplog.text
        accepted, _ = server.accept()
        with accepted:
            port.write(b"\0\0")
            assert accepted.recv(10) == b"\0\0"
            accepted.sendall(b"hello")
            assert read_all(port, 5) == b"hello"
            assert port.read() == b""
            assert port.waiting() == 0
        with pytest.raises(ConnectionLostError):
            read_all(port, 1)
        port.close()
