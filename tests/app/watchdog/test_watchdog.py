"""The watchdog process: its reports, and its stop if the program dies."""

import json
import os
import pty
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.watchdog import HeartbeatSender, process
from rotemina.app.watchdog.heartbeat_sender import _make_command
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot


def make_beat(**ages):
    return json.dumps({"ages": ages, "moves": True, "ports": []})


@pytest.fixture
def log(tmp_path):
    return tmp_path / "watchdog.log"


@pytest.fixture
def watchdog(log):
    return process.Watchdog(log, has_screen=False)


def test_punctual_beats_log_nothing(watchdog, log):
    assert watchdog.receive_beat(make_beat(window=0.2, worker=0.01))
    watchdog.check(0.3)
    assert not log.exists()


@pytest.mark.parametrize(
    ("line", "silence_s", "message"),
    [
        (
            make_beat(window=1.2, worker=0.0),
            0.0,
            "The window of RoTeMiNa does not answer while the",
        ),
        (
            make_beat(window=0.0, worker=1.2),
            0.0,
            "The thread that controls the machine of RoTeMiNa",
        ),
        (make_beat(window=0.0, worker=0.0), 1.2, "RoTeMiNa has hung"),
    ],
)
def test_silence_is_reported_once_until_it_ends(watchdog, log, capsys, line, silence_s, message):
    for _ in range(3):
        watchdog.receive_beat(line)
        watchdog.check(silence_s)
    assert log.read_text(encoding="utf-8").count(message) == 1
    assert message in capsys.readouterr().err
    watchdog.receive_beat(make_beat(window=0.0))
    watchdog.check(0.0)
    watchdog.receive_beat(line)
    watchdog.check(silence_s)
    assert log.read_text(encoding="utf-8").count(message) == 2


def test_a_hanging_simulator_is_only_logged(log, monkeypatch):
    windows = []
    monkeypatch.setattr(process.subprocess, "Popen", lambda *args, **_: windows.append(args))
    watchdog = process.Watchdog(log, has_screen=True)
    late_beat = {"ages": {"window": 1.2}, "moves": False, "ports": []}
    watchdog.receive_beat(json.dumps({**late_beat, "simulated": True}))
    watchdog.check(0.0)
    assert log.read_text(encoding="utf-8").endswith("of RoTeMiNa does not answer.\n")
    assert windows == []
    watchdog.receive_beat(make_beat(window=0.0))
    watchdog.check(0.0)
    watchdog.receive_beat(json.dumps(late_beat))
    watchdog.check(0.0)
    assert log.read_text(encoding="utf-8").endswith("Look at the machine.\n")
    assert len(windows) == 1


def test_a_line_that_is_cut_off_changes_nothing(watchdog, log):
    watchdog.receive_beat(make_beat(window=0.0))
    assert watchdog.receive_beat('{"ages": {"win')
    watchdog.check(0.0)
    assert not log.exists()


def test_the_stop_is_sent_to_all_existing_ports(watchdog, log, tmp_path):
    board, host = pty.openpty()
    os.set_blocking(board, False)
    watchdog.receive_beat(json.dumps({"ports": [os.ttyname(host), str(tmp_path / "gone")]}))
    watchdog.report_sudden_end()
    assert os.read(board, 10) == b"\0\0"
    log_text = log.read_text(encoding="utf-8")
    assert f"{os.ttyname(host)}: the stop was sent" in log_text
    assert f"{tmp_path / 'gone'}: the stop could not be sent (No such file" in log_text
    os.close(board)
    os.close(host)


def test_the_process_needs_only_the_standard_library():
    script = f"import runpy; runpy.run_path({process.__file__!r})"
    subprocess.run([sys.executable, "-I", "-S", "-c", script], check=True, timeout=60)


def test_a_farewell_ends_the_watchdog_without_an_alarm(log):
    session = MotionSession(Simulator(load_robot("rotemina")))
    sender = HeartbeatSender(session, log, screen=False)
    sender.start()
    assert sender.process_id is not None
    sender.close()
    assert sender.process_id is None
    assert not log.exists()  # a farewell raises no alarm


def test_a_starting_window_is_watched_only_while_the_machine_moves(log, monkeypatch):
    session, sent = MotionSession(Simulator(load_robot("rotemina"))), []
    sender = HeartbeatSender(session, log, screen=False)
    monkeypatch.setattr(sender, "_send", sent.append)
    session.screen_heartbeat.beat()
    sender.starting = True
    sender.send_beat()
    state_at_rest = session.snapshot()
    monkeypatch.setattr(
        session, "snapshot", lambda: replace(state_at_rest, activity=DeviceState.MOVING)
    )
    sender.send_beat()
    sender.starting = False
    monkeypatch.setattr(session, "snapshot", lambda: state_at_rest)
    sender.send_beat()
    assert ["window" in message["ages"] for message in sent] == [False, True, True]


def test_a_bundle_starts_its_watchdog_too(log, monkeypatch):
    """Run the start-up file in place of the bundle's executable."""
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    python, *arguments = _make_command()
    start_file = Path(__file__).parents[3] / ".ci" / "bundle" / "start.py"
    result = subprocess.run(
        [python, str(start_file), *arguments, str(log)],
        input=make_beat(),
        text=True,
        check=False,
        timeout=60,
    )
    assert result.returncode == 1  # the input ended without a farewell
    assert "has ended without" in log.read_text(encoding="utf-8")


PROGRAM = """
import sys, time
from pathlib import Path
from rotemina.app.motion.session import MotionSession
from rotemina.app.watchdog import HeartbeatSender
from rotemina.app.watchdog.heartbeat_sender import _make_command
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot
session = MotionSession(Simulator(load_robot("rotemina")))
sender = HeartbeatSender(session, Path(sys.argv[1]), screen=False)
sender.start()
print(sender.process_id, flush=True)
time.sleep(600)
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").exists(), reason="memory is read from /proc")
def test_a_small_process_reports_a_killed_program(log):
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(log)], stdout=subprocess.PIPE, text=True
    ) as program:
        process_id = int(program.stdout.readline())
        time.sleep(1.0)  # beats come four times a second
        status = Path(f"/proc/{process_id}/status").read_text(encoding="utf-8")
        program.kill()
    peak_kb = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM"))
    print(f"watchdog: {peak_kb / 1024:.1f} MB")
    assert peak_kb <= 40 * 1024
    end_s = time.monotonic() + 20.0
    while not (log.exists() and "has ended without" in log.read_text(encoding="utf-8")):
        assert time.monotonic() < end_s, "nothing was logged within 20 s"
        time.sleep(0.05)
