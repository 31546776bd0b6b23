"""``rotemina board`` as users run it: a separate process that is reached over its ports."""

import os
import re
import select
import signal
import socket
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.app.cli.machine import board
from rotemina.app.cli.machine.board_ports import LoopbackSocket, PseudoTerminal
from rotemina.drivers.contract import ConnectionLostError, DeviceSamples, DriverTimeoutError
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.mc68hc11.protocol import (
    STOP_BYTES,
    BoardIdentity,
    FrameDecoder,
    FrameDone,
    IdentifyBoard,
    MoveTo,
    SerialFrame,
    encode_frame,
)
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.skipif(os.name != "posix", reason="needs POSIX pseudo-terminals")
TIMEOUT_S = 20.0  # generous, for a loaded machine


def make_wire_frame(number, message, board=1):
    return encode_frame(SerialFrame(board, number, message.TYPE, message.pack()))


def read_frames(handle, count, decoder):
    """Return the next ``count`` frames from a board."""
    frames = []
    while len(frames) < count and select.select([handle], [], [], TIMEOUT_S)[0]:
        frames += decoder.feed(os.read(handle, 4096))
    return frames


def read_lines_until(stream, text):
    """Return the lines up to the first one with ``text``."""
    lines = []
    for line in stream:
        lines.append(line)
        if text in line:
            return lines
    raise AssertionError(f"{text!r} is not in {lines}")


def test_host_talks_to_boards_stops_them_and_all_ends_cleanly(tmp_path):
    links = [tmp_path / "board1", tmp_path / "board2"]
    links[1].symlink_to("/dev/pts/999999")  # left by a process that died
    arguments = [word for link in links for word in ("--port", str(link))]
    with subprocess.Popen(
        [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known", *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            lines = read_lines_until(process.stdout, "board 2")
            assert re.match(r"listening on .*board1 \(/dev/\S+\): board 1$", lines[0])
            handle = os.open(links[0], os.O_RDWR | os.O_NOCTTY)
            decoder = FrameDecoder()
            os.write(handle, make_wire_frame(1, IdentifyBoard(1)))
            (frame,) = read_frames(handle, 1, decoder)
            assert BoardIdentity.unpack(frame.payload).name == b"RoTeMiNa 1"
            os.write(handle, make_wire_frame(2, MoveTo(0, 275_100, 1000)))
            (frame,) = read_frames(handle, 1, decoder)
            assert FrameDone.unpack(frame.payload) == FrameDone(2)
            os.write(handle, STOP_BYTES)
            read_lines_until(process.stdout, "axes at rest")
            process.stdin.write("lose x 40\nnonsense\n")
            process.stdin.flush()
            read_lines_until(process.stdout, "injected: lose x 40")
            os.close(handle)
            process.send_signal(signal.SIGTERM)
            assert process.wait(TIMEOUT_S) == 0
            assert "fault 'nonsense': unknown command" in process.stderr.read()
        finally:
            process.kill()
    assert not any(link.is_symlink() for link in links)


@pytest.mark.slow  # in real time
def test_telemetry_and_captures_reach_the_host_over_a_shared_bus(tmp_path):
    name = tmp_path / "bus"
    with subprocess.Popen(
        [
            *(sys.executable, "-m", "rotemina.app.cli.main", "board"),
            *("--bus", "--position-known", "--port", str(name)),
        ],
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            read_lines_until(process.stdout, "monotonic clock")
            intervals, parts = _capture_samples(str(name))
        finally:
            process.kill()
    assert sum(len(part.measured) for part in parts) + parts[-1].lost == 200
    assert parts[-1].lost < 200
    time_s = np.concatenate([part.device_time_s for part in parts])
    assert np.diff(time_s).min() == pytest.approx(0.001, abs=1e-6)
    # A loaded machine misses samples. Consecutive ones still show the sampling interval.
    assert intervals.min() == pytest.approx(0.01, abs=1e-3)


def _capture_samples(port, attempts=5):
    """Capture 200 samples in real time; return the parts and the telemetry intervals after them.

    Repeat if the connection was lost because a loaded machine delayed the boards or the host.
    """
    driver = MC68HC11Driver(load_robot("rotemina"), {"port": port})
    parts, samples, until_s = [], [], time.monotonic() + TIMEOUT_S
    try:
        driver.open()
        driver.capture(["zn"], driver.capture_rates.single_axis_hz, 200)
        while not (parts and parts[-1].complete) or len(DeviceSamples.join(samples, 6)) < 50:
            assert time.monotonic() < until_s, f"{len(parts)} parts of a capture came"
            reading, part = driver.read(), driver.read_capture()
            parts += [part] if part is not None else []
            samples += [reading] if parts and parts[-1].complete else []
            time.sleep(driver.service_period_s)
    except (ConnectionLostError, DriverTimeoutError):
        if attempts == 1:
            raise
        driver.close()
        return _capture_samples(port, attempts - 1)
    finally:
        driver.close()
    return np.diff(DeviceSamples.join(samples, 6).device_time_s), parts


def wait_until(condition):
    end_s = time.monotonic() + TIMEOUT_S
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(0.001)


@pytest.mark.parametrize("system", ["posix", "nt"])
def test_standard_input_is_read_on_every_system(monkeypatch, system):
    """On Windows, select() accepts only sockets."""
    read_end, write_end = os.pipe()
    monkeypatch.setattr(board, "_STDIN_HANDLE", read_end)
    monkeypatch.setattr(board, "os", SimpleNamespace(name=system, read=os.read))
    listener = board._ListenerThread([])
    listener.start()
    try:
        assert listener.is_stdin_open
        os.write(write_end, b"lose x 40\n")
        wait_until(lambda: listener.commands)
        assert listener.commands.popleft() == b"lose x 40\n"
        assert listener.is_stdin_open
        os.close(write_end)
        wait_until(lambda: not listener.is_stdin_open)
    finally:
        listener.end()
        os.close(read_end)


@pytest.mark.parametrize("system", ["posix", "nt"])
def test_a_failed_read_counts_as_the_end_of_standard_input(monkeypatch, system):
    def fail(*_):
        raise OSError("the terminal is gone")

    read_end, write_end = os.pipe()
    os.write(write_end, b"x")
    monkeypatch.setattr(board, "_STDIN_HANDLE", read_end)
    monkeypatch.setattr(board, "os", SimpleNamespace(name=system, read=fail))
    listener = board._ListenerThread([])
    listener.start()
    wait_until(lambda: not (listener.is_stdin_open and listener.is_alive()))
    assert listener.is_alive()
    assert not listener.is_stdin_open
    listener.end()
    os.close(read_end)
    os.close(write_end)


def test_board_serves_a_socket_until_standard_input_closes():
    arguments = "--robot picma --tcp 127.0.0.1:0 --unpaced --until-stdin-closes"
    with subprocess.Popen(
        [sys.executable, "-m", "rotemina.app.cli.main", "board", *arguments.split()],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            line = read_lines_until(process.stdout, "listening")[0]
            port = int(re.search(r"socket://127\.0\.0\.1:(\d+)", line)[1])
            with socket.create_connection(("127.0.0.1", port), timeout=TIMEOUT_S) as host:
                host.sendall(make_wire_frame(1, IdentifyBoard(1)))
                (frame,) = read_frames(host.fileno(), 1, FrameDecoder())
                assert BoardIdentity.unpack(frame.payload).axes == 1
            process.stdin.close()
            assert process.wait(TIMEOUT_S) == 0
            assert "host connected" in process.stdout.read()
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--robot emps", "axis q is moved by a force"),
        ("--tcp 0.0.0.0:5000", "'0.0.0.0' is not a loopback address"),
        ("--tcp 127.0.0.1:x", "the port must be a number"),
        ("--tcp 5000", "'no host' is not"),
        ("--baud 19200", "must be one of 125000, 9600"),
        ("--seed -1", "--seed -1: must be 0 or more"),
        ("--mishaps -1", "--mishaps -1: must be from 0"),
        ("--bus --robot fsm", "need only one board"),
        ("--bus --port a --port b", "name only one port"),
        ("--port a --port b --port c", "3 ports: two boards have at most 2"),
        ("--port a --port b --robot fsm", "need only one board"),
        ("--port nowhere/at/all", "--port nowhere/at/all: cannot create a link there"),
    ],
)
def test_bad_request_is_refused(arguments, message, get_refusal):
    assert message in get_refusal(f"board {arguments}")


@pytest.mark.parametrize("kind", ["file", "folder", "live link", "dead link elsewhere"])
def test_port_name_overwrites_nothing(tmp_path, get_refusal, kind):
    path = tmp_path / "board"
    if kind == "file":
        path.write_text("mine")
    elif kind == "folder":
        path.mkdir()
    else:
        path.symlink_to("/dev/null" if kind == "live link" else tmp_path / "gone")
    assert "already exists" in get_refusal(f"board --bus --port {path}")
    assert path.exists() or path.is_symlink()


def test_changed_link_is_left_alone(tmp_path):
    link = tmp_path / "board"
    port = PseudoTerminal(link)
    link.unlink()
    link.write_text("mine")
    port.close()
    assert link.read_text() == "mine"


def test_unread_bytes_are_kept_in_order_and_bounded():
    port = PseudoTerminal()
    handle = os.open(port.name, os.O_RDWR | os.O_NOCTTY)
    sent = bytes(range(1, 251)) * 100
    for start in range(0, len(sent), 1000):
        port.send(sent[start : start + 1000])
    received = b""
    while len(received) < len(sent):
        port.send(b"")
        received += os.read(handle, 4096)
    assert received == sent
    os.close(handle)
    port.close()


def test_only_one_host_connects_at_a_time():
    messages = []
    port = LoopbackSocket("localhost:0", messages.append)
    address = port.name.removeprefix("socket://").split(":")
    with (
        socket.create_connection((address[0], int(address[1])), timeout=TIMEOUT_S) as first,
        socket.create_connection((address[0], int(address[1])), timeout=TIMEOUT_S) as second,
    ):
        first.sendall(b"abc")
        received = b""
        while len(received) < 3:
            select.select(port.get_handles(), [], [], TIMEOUT_S)
            received += port.receive()
        while not any("turned away" in line for line in messages):
            port.receive()
        assert second.recv(1) == b""
    port.close()
    assert received == b"abc"
