"""``rotemina board`` as its users meet it: a process of its own, talked to over its ports."""

import os
import re
import select
import signal
import socket
import subprocess
import sys
import time

import numpy as np
import pytest

from rotemina.app.cli.board_ports import PseudoTerminal, Socket
from rotemina.app.cli.main import main
from rotemina.drivers.errors import ConnectionLostError, DriverTimeoutError
from rotemina.drivers.mc68hc11.board_messages import Done, Identity
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.mc68hc11.framing import STOP_BYTES, Decoder, Frame, encoded
from rotemina.drivers.mc68hc11.host_messages import Identify, MoveTo
from rotemina.drivers.samples import Samples
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are of POSIX")
ANSWER_S = 20.0  # a machine under load may take its time; nothing waits so long that works


def wire(number, message, board=1):
    return encoded(Frame(board, number, message.TYPE, message.packed()))


def heard(handle, count, decoder):
    """Return so many frames that a board says."""
    frames = []
    while len(frames) < count and select.select([handle], [], [], ANSWER_S)[0]:
        frames += decoder.feed(os.read(handle, 4096))
    return frames


def lines_until(stream, words):
    """Return the lines up to one with these words."""
    found = []
    for line in stream:
        found.append(line)
        if words in line:
            return found
    raise AssertionError(f"{words!r} is not in {found}")


def test_a_host_talks_to_boards_and_stops_them_and_all_ends_cleanly(tmp_path):
    links = [tmp_path / "board1", tmp_path / "board2"]
    links[1].symlink_to("/dev/pts/999999")  # of a process that died
    asked = [a for link in links for a in ("--port", str(link))]
    with subprocess.Popen(
        [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known", *asked],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            listening = lines_until(process.stdout, "board 2")
            assert re.match(r"listening on .*board1 \(/dev/\S+\): board 1$", listening[0])
            handle = os.open(links[0], os.O_RDWR | os.O_NOCTTY)
            decoder = Decoder()
            os.write(handle, wire(1, Identify(1)))
            (frame,) = heard(handle, 1, decoder)
            assert Identity.unpacked(frame.payload).name == b"RoTeMiNa 1"
            os.write(handle, wire(2, MoveTo(0, 275_100, 1000)))
            (frame,) = heard(handle, 1, decoder)
            assert Done.unpacked(frame.payload) == Done(2)
            os.write(handle, STOP_BYTES)
            lines_until(process.stdout, "axes at rest")
            process.stdin.write("lose x 40\nnonsense\n")
            process.stdin.flush()
            lines_until(process.stdout, "injected: lose x 40")
            os.close(handle)
            process.send_signal(signal.SIGTERM)
            assert process.wait(ANSWER_S) == 0
            assert "fault 'nonsense': unknown command" in process.stderr.read()
        finally:
            process.kill()
    assert not any(link.is_symlink() for link in links)


@pytest.mark.slow  # in real time
def test_on_a_shared_bus_telemetry_and_captures_reach_a_host_at_true_baud(tmp_path):
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
            lines_until(process.stdout, "monotonic clock")
            intervals, parts = _captured(str(name))
        finally:
            process.kill()
    assert sum(len(part.measured) for part in parts) + parts[-1].lost == 200
    assert parts[-1].lost < 200
    time_s = np.concatenate([part.device_time_s for part in parts])
    assert np.diff(time_s).min() == pytest.approx(0.001, abs=1e-6)
    # A starved machine misses samples; those that follow each other tell how often they are taken.
    assert intervals.min() == pytest.approx(0.01, abs=1e-3)


def _captured(port, tries=5):
    """Capture 200 samples in real time: return intervals of telemetry after it, and the parts.

    Once more where the machine let the boards, or the host, wait until the connection was lost.
    """
    driver = MC68HC11(load_robot("rotemina"), {"port": port})
    parts, samples, until_s = [], [], time.monotonic() + ANSWER_S
    try:
        driver.open()
        driver.capture(["zn"], driver.capture_rates.one_hz, 200)
        while not (parts and parts[-1].complete) or len(Samples.joined(samples, 6)) < 50:
            assert time.monotonic() < until_s, f"{len(parts)} parts of a capture came"
            read, part = driver.read(), driver.captured()
            parts += [part] if part is not None else []
            samples += [read] if parts and parts[-1].complete else []
            time.sleep(driver.service_period_s)
    except (ConnectionLostError, DriverTimeoutError):
        if tries == 1:
            raise
        driver.close()
        return _captured(port, tries - 1)
    finally:
        driver.close()
    return np.diff(Samples.joined(samples, 6).device_time_s), parts


def test_on_a_socket_until_standard_input_closes():
    asked = "--robot picma --tcp 127.0.0.1:0 --unpaced --until-stdin-closes"
    with subprocess.Popen(
        [sys.executable, "-m", "rotemina.app.cli.main", "board", *asked.split()],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            line = lines_until(process.stdout, "listening")[0]
            port = int(re.search(r"socket://127\.0\.0\.1:(\d+)", line)[1])
            with socket.create_connection(("127.0.0.1", port), timeout=ANSWER_S) as host:
                host.sendall(wire(1, Identify(1)))
                (frame,) = heard(host.fileno(), 1, Decoder())
                assert Identity.unpacked(frame.payload).axes == 1
            process.stdin.close()
            assert process.wait(ANSWER_S) == 0
            assert "host connected" in process.stdout.read()
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--robot", "emps"], "axis q is moved by a force"),
        (["--tcp", "0.0.0.0:5000"], "'0.0.0.0' is not a loopback address"),
        (["--tcp", "127.0.0.1:x"], "the port must be a number"),
        (["--tcp", "5000"], "'no host' is not"),
        (["--baud", "19200"], "must be one of 125000, 9600"),
        (["--seed", "-1"], "--seed -1: must be 0 or more"),
        (["--mishaps", "-1"], "--mishaps -1: must be from 0"),
        (["--bus", "--robot", "fsm"], "need only one board"),
        (["--bus", "--port", "a", "--port", "b"], "name only one port"),
        (["--port", "a", "--port", "b", "--port", "c"], "3 ports: two boards have at most 2"),
        (["--port", "a", "--port", "b", "--robot", "fsm"], "need only one board"),
        (["--port", "nowhere/at/all"], "--port nowhere/at/all: cannot create a link there"),
    ],
)
def test_what_cannot_be_served_is_refused_in_one_line(
    arguments, words, capsys, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    assert main(["board", *arguments]) == 2
    said = capsys.readouterr()
    assert words in said.err
    assert said.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("kind", ["file", "folder", "live link", "dead link elsewhere"])
def test_nothing_is_overwritten_by_the_name_of_a_port(tmp_path, capsys, kind):
    name = tmp_path / "board"
    if kind == "file":
        name.write_text("mine")
    elif kind == "folder":
        name.mkdir()
    else:
        name.symlink_to("/dev/null" if kind == "live link" else tmp_path / "gone")
    assert main(["board", "--bus", "--port", str(name)]) == 2
    assert "already exists" in capsys.readouterr().err
    assert name.exists() or name.is_symlink()


def test_a_link_that_somebody_changed_is_left_alone(tmp_path):
    link = tmp_path / "board"
    port = PseudoTerminal(link)
    link.unlink()
    link.write_text("mine")
    port.close()
    assert link.read_text() == "mine"


def test_what_a_host_does_not_read_is_kept_in_order_and_bounded():
    port = PseudoTerminal()
    handle = os.open(port.name, os.O_RDWR | os.O_NOCTTY)
    sent = bytes(range(1, 251)) * 100
    for begin in range(0, len(sent), 1000):
        port.send(sent[begin : begin + 1000])
    got = b""
    while len(got) < len(sent):
        port.send(b"")
        got += os.read(handle, 4096)
    assert got == sent
    os.close(handle)
    port.close()


def test_one_host_at_a_time():
    said = []
    port = Socket("localhost:0", said.append)
    address = port.name.removeprefix("socket://").split(":")
    with (
        socket.create_connection((address[0], int(address[1])), timeout=ANSWER_S) as first,
        socket.create_connection((address[0], int(address[1])), timeout=ANSWER_S) as second,
    ):
        first.sendall(b"abc")
        got = b""
        while len(got) < 3:
            select.select(port.handles(), [], [], ANSWER_S)
            got += port.receive()
        while not any("turned away" in line for line in said):
            port.receive()
        assert second.recv(1) == b""
    port.close()
    assert got == b"abc"
