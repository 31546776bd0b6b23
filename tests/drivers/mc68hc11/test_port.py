"""The real port, over a pseudo-terminal and a socket, and what it says when it cannot be opened."""

import os
import pty
import socket
import time
import tty

import pytest
import serial

from rotemina.drivers.errors import ConnectionLostError, DriverError
from rotemina.drivers.mc68hc11 import port as port_module
from rotemina.drivers.mc68hc11.port import open_port


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

    monkeypatch.setattr(port_module.serial, "serial_for_url", refuse)
    with pytest.raises(DriverError, match=match) as raised:
        open_port("/dev/ttyX", 9600)
    assert raised.value.__cause__ is error


def test_a_port_that_is_not_there():
    with pytest.raises(DriverError, match="no such port"):
        open_port("/dev/does-not-exist", 9600)
    with pytest.raises(DriverError, match="no serial port is set"):
        open_port("", 9600)


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
