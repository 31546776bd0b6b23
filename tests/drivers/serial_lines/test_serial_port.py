"""Serial ports of all kinds, with connected devices that accept no bytes, and failed openings."""

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

from rotemina.drivers.contract import ConnectionLostError, DriverError, VirtualClock
from rotemina.drivers.serial_lines import UrgentBytes, byte_channels, open_port
from rotemina.drivers.serial_lines.byte_channels import (
    ByteChannel,
    TelnetChannel,
    WindowsChannel,
    open_channel,
)
from rotemina.drivers.serial_lines.serial_port import MAX_BLOCKED_S, SerialPort

STOP = UrgentBytes(b"!")


@pytest.fixture
def terminal():
    master, slave = pty.openpty()
    tty.setraw(slave)
    yield master, os.ttyname(slave)
    for descriptor in (master, slave):
        try:
            os.close(descriptor)
        except OSError:
            continue


class NarrowChannel(ByteChannel):
    """A channel that accepts as many bytes as it has room for."""

    def __init__(self, room=0):
        self.room = room
        self.accepted = b""
        self.calls = 0

    def read(self):
        return b""

    def write(self, data):
        self.calls += 1
        accepted_data = data[: self.room]
        self.room -= len(accepted_data)
        self.accepted += accepted_data
        return len(accepted_data)

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


def read_and_write(port):
    for _ in range(100):
        port.read()
        port.write(b"\0")


def fill_queue(port):
    for _ in range(1024 // 8):
        port.write(b"8 bytes.")


def fill_system_buffer(port, piece):
    """Write until the system accepts no more bytes, because the other end does not read."""
    for _ in range(100_000):
        port.write(piece)
        if port._queue:
            return
    raise AssertionError("the port takes any number of bytes")


def test_bytes_that_the_port_does_not_accept_are_sent_later_in_order(port, channel):
    channel.room = 2
    port.write(b"first")
    port.write(b"second")
    assert channel.accepted == b"fi"
    assert port.waiting() == 9
    channel.room = 5
    port.read()
    assert channel.accepted == b"firstse"
    channel.room = 100
    port.write(b"third")
    assert channel.accepted == b"firstsecondthird"
    assert port.waiting() == 0


def test_a_stop_follows_the_started_frame_and_replaces_waiting_frames(port, channel):
    channel.room = 2
    for frame in (b"begun", b"motion", b"more"):
        port.write(frame)
    port.write(STOP)
    port.write(b"after")
    channel.room = 100
    port.read()
    assert channel.accepted == b"begun!after"


def test_stops_of_two_kinds_keep_their_order_and_are_not_repeated(port, channel):
    for data in (b"motion", STOP, STOP, UrgentBytes(b"\x18"), UrgentBytes(b"\x18"), b"?"):
        port.write(data)
    port.write(STOP)
    channel.room = 100
    port.read()
    assert channel.accepted == b"!\x18!"


def test_a_blocked_port_is_lost_after_its_time_out_and_sends_nothing_old(port, channel, clock):
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
    assert channel.accepted == b""


def test_a_stop_is_tried_even_on_a_lost_port(port, channel, clock):
    port.write(b"motion")
    clock.advance(60.0)
    channel.room = 100
    with pytest.raises(ConnectionLostError):
        port.write(STOP)
    assert channel.accepted == b"!"


def test_a_port_that_accepts_single_bytes_is_not_lost(port, channel, clock):
    port.write(b"slowly")
    for _ in range(6):
        clock.advance(0.9 * MAX_BLOCKED_S)
        channel.room = 1
        port.read()
    assert channel.accepted == b"slowly"
    clock.advance(60.0)
    port.read()


def test_the_queue_is_bounded_except_for_stops(port, channel):
    fill_queue(port)
    port.write(STOP)
    port.write(b"fits again")
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        fill_queue(port)


def test_a_blocked_port_is_tried_once_per_call(port, channel):
    port.write(b"motion")
    calls_before = channel.calls
    port.read()
    assert channel.calls == calls_before + 1


def test_frames_of_two_threads_are_neither_split_nor_lost(port, channel):
    barrier = threading.Barrier(2)

    def write(frame):
        barrier.wait()
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
    torn_frames = channel.accepted.replace(b"<ab>", b"").replace(b"<cd>", b"")
    assert (len(channel.accepted), torn_frames) == (800, b"")


def test_bytes_are_sent_and_received_without_waiting(terminal):
    master, name = terminal
    port = open_port(name, 9600)
    assert port._channel._serial.timeout == 0
    assert port.read() == b""
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


def test_a_device_that_accepts_no_bytes_blocks_neither_a_write_nor_a_stop(terminal, clock):
    master, name = terminal
    port = SerialPort(name, open_channel(name, 9600), clock)
    fill_system_buffer(port, b"x" * 500)
    port.write(STOP)
    port.read()
    assert port.waiting() > 0
    assert b"".join(read_descriptor(master)).strip(b"x") == b""
    port.read()
    received = b"".join(read_descriptor(master))
    assert (received.strip(b"x"), len(received) < 500) == (b"!", True)
    fill_system_buffer(port, b"x" * 500)
    clock.advance(MAX_BLOCKED_S + 0.001)
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        port.read()
    port.close()


def test_a_network_peer_that_accepts_no_bytes_blocks_nothing(clock):
    with socket.create_server(("127.0.0.1", 0)) as server:
        url = f"socket://127.0.0.1:{server.getsockname()[1]}"
        port = SerialPort(url, open_channel(url, 9600), clock)
        connection, _ = server.accept()
        with closing(port), connection:
            fill_system_buffer(port, b"x" * 1_000_000)
            port.write(STOP)
            while port.waiting():
                connection.recv(1 << 20)
                port.read()
            connection.shutdown(socket.SHUT_WR)
            port.close()
            received = b"".join(iter(partial(connection.recv, 1 << 20), b""))
            assert received.strip(b"x") == b"!"


class TelnetSerial:
    """The used methods of pyserial's RFC 2217 port, on a pair of sockets."""

    def __init__(self, connection):
        # This is the time-out that pyserial sets.
        connection.settimeout(5.0)
        self._socket = connection
        self._write_lock = threading.Lock()
        self.in_waiting = 0

    def read(self, _size):
        return b""

    def close(self):
        self._socket.close()


def test_a_remote_port_that_accepts_no_bytes_blocks_nothing(clock):
    local, remote = socket.socketpair()
    with remote:
        telnet_serial = TelnetSerial(local)
        port = SerialPort("rfc2217://x", TelnetChannel(telnet_serial), clock)
        port.write(b"\x01\xff\xff\x02")
        assert remote.recv(100) == b"\x01\xff\xff\xff\xff\x02"
        fill_system_buffer(port, b"x" * 100_000)
        # pyserial holds the lock while it answers the server.
        with telnet_serial._write_lock:
            port.write(STOP)
        while port.waiting():
            remote.recv(1 << 20)
            port.read()
        port.close()
        assert b"".join(iter(partial(remote.recv, 1 << 20), b"")).strip(b"x") == b"!"


class WindowsSerial:
    """The used methods of pyserial's COM port, which accepts every write and completes it later."""

    def __init__(self):
        self.out_waiting = 0
        self.accepted = b""
        self.is_output_discarded = False

    def read(self, _size):
        return b""

    def write(self, data):
        self.accepted += data
        self.out_waiting += len(data)
        return len(data)

    def reset_output_buffer(self):
        self.is_output_discarded = True

    def close(self):
        self.out_waiting = 0


def test_a_com_port_that_completes_no_write_gets_a_limited_number_of_bytes(clock):
    com_port = WindowsSerial()
    port = SerialPort("COM3", WindowsChannel(com_port), clock)
    for _ in range(20):
        port.write(b"0123456789abcdef")
    assert com_port.accepted == 16 * b"0123456789abcdef"
    port.write(STOP)
    com_port.out_waiting = 0
    port.read()
    assert com_port.accepted == 16 * b"0123456789abcdef" + b"!"
    for _ in range(17):
        port.write(b"0123456789abcdef")
    clock.advance(MAX_BLOCKED_S + 0.001)
    with pytest.raises(ConnectionLostError, match="takes no more bytes"):
        port.read()
    port.close()
    assert com_port.is_output_discarded


def test_a_loop_port_returns_its_bytes_and_is_limited():
    port = open_port("loop://", 9600)
    port.write(b"x" * 4090)
    port.write(b"0123456789")
    assert port.waiting() == 4
    assert port.read() + port.read() == b"x" * 4090 + b"0123456789"
    port.close()


def serve_remote_port(server, device):
    """Serve RFC 2217 to one client, and echo its bytes."""
    client, _ = server.accept()
    with client:
        connection = type("Connection", (), {"write": staticmethod(client.sendall)})()
        manager = PortManager(device, connection)
        while data := client.recv(1024):
            client.sendall(b"".join(manager.escape(b"".join(manager.filter(data)))))


@pytest.mark.filterwarnings("ignore:set(Daemon|Name):DeprecationWarning")
def test_a_remote_port_by_rfc_2217_echoes_every_byte():
    device = serial.serial_for_url("loop://", timeout=0)
    with socket.create_server(("127.0.0.1", 0)) as server:
        server_thread = threading.Thread(
            target=serve_remote_port, args=(server, device), daemon=True
        )
        server_thread.start()
        port = open_port(f"rfc2217://127.0.0.1:{server.getsockname()[1]}", 9600)
        port.write(bytes(range(256)))
        assert read_all(port, 256) == bytes(range(256))
        port.close()
        server_thread.join()


def test_a_port_type_whose_writes_may_block_is_refused(monkeypatch):
    class BlockingPort:
        def close(self):
            pass

    monkeypatch.setattr(byte_channels.serial, "serial_for_url", lambda *_, **__: BlockingPort())
    with pytest.raises(DriverError, match="a write to cp2110:// may wait"):
        open_port("cp2110://x", 9600)


def test_a_port_in_use_is_refused_with_the_reason(terminal):
    _, name = terminal
    first = open_port(name, 9600)
    with pytest.raises(DriverError, match="another program uses it"):
        open_port(name, 9600)
    first.close()
    open_port(name, 9600).close()


def test_a_disconnected_port_is_lost(terminal):
    master, name = terminal
    port = open_port(name, 9600)
    os.close(master)
    with pytest.raises(ConnectionLostError, match="the port has disappeared"):
        read_and_write(port)
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
def test_a_failed_opening_gives_the_reason_and_advice(monkeypatch, error, match):
    def raise_error(*_args, **_kwargs):
        raise error

    monkeypatch.setattr(byte_channels.serial, "serial_for_url", raise_error)
    with pytest.raises(DriverError, match=match) as raised:
        open_port("/dev/ttyX", 9600)
    assert raised.value.__cause__ is error


def test_a_missing_port_is_refused():
    with pytest.raises(DriverError, match="no such port"):
        open_port("/dev/does-not-exist", 9600)
    with pytest.raises(DriverError, match="no serial port is set"):
        open_port("", 9600)


def test_a_socket_is_closed_after_its_other_end_has_gone():
    with socket.create_server(("127.0.0.1", 0)) as server:
        channel = open_channel(f"socket://127.0.0.1:{server.getsockname()[1]}", 9600)
        peer, _ = server.accept()
        # With this option, closing resets the connection, like the end of a killed process.
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        peer.close()
        connection = channel._serial._socket
        select.select([connection], [], [], 5.0)
        channel.close()
    assert connection.fileno() == -1


def test_a_socket_works_with_a_warning(caplog):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = open_port(f"socket://127.0.0.1:{server.getsockname()[1]}", 9600)
        assert "authenticated" in caplog.text
        peer, _ = server.accept()
        with peer:
            port.write(b"\0\0")
            assert peer.recv(10) == b"\0\0"
            peer.sendall(b"hello")
            assert read_all(port, 5) == b"hello"
            assert port.read() == b""
            assert port.waiting() == 0
        with pytest.raises(ConnectionLostError):
            read_all(port, 1)
        port.close()
