"""The process beside the program: what it tells, and what it does when the program dies."""

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
from rotemina.app.watchdog import process
from rotemina.app.watchdog.heartbeat_sender import Watched, _command
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot


def beat(**ages):
    return json.dumps({"ages": ages, "moves": True, "ports": []})


@pytest.fixture
def log(tmp_path):
    return tmp_path / "watchdog.log"


@pytest.fixture
def watchdog(log):
    return process.Watchdog(log, shown=False)


def test_all_well_says_nothing(watchdog, log):
    assert watchdog.take(beat(window=0.2, worker=0.01))
    watchdog.look(0.3)
    assert not log.exists()


@pytest.mark.parametrize(
    ("line", "silence_s", "said"),
    [
        (beat(window=1.2, worker=0.0), 0.0, "The window of RoTeMiNa does not answer while the"),
        (beat(window=0.0, worker=1.2), 0.0, "The thread that steers the machine of RoTeMiNa"),
        (beat(window=0.0, worker=0.0), 1.2, "RoTeMiNa has hung"),
    ],
)
def test_silence_is_told_once_until_it_ends(watchdog, log, capsys, line, silence_s, said):
    for _ in range(3):
        watchdog.take(line)
        watchdog.look(silence_s)
    assert log.read_text(encoding="utf-8").count(said) == 1
    assert said in capsys.readouterr().err
    watchdog.take(beat(window=0.0))
    watchdog.look(0.0)
    watchdog.take(line)
    watchdog.look(silence_s)
    assert log.read_text(encoding="utf-8").count(said) == 2


def test_a_simulator_that_hangs_needs_no_look_at_a_machine_and_no_window(log, monkeypatch):
    windows = []
    monkeypatch.setattr(process.subprocess, "Popen", lambda *words, **_: windows.append(words))
    watchdog = process.Watchdog(log, shown=True)
    slow = {"ages": {"window": 1.2}, "moves": False, "ports": []}
    watchdog.take(json.dumps({**slow, "simulated": True}))
    watchdog.look(0.0)
    assert log.read_text(encoding="utf-8").endswith("of RoTeMiNa does not answer.\n")
    assert windows == []
    watchdog.take(beat(window=0.0))
    watchdog.look(0.0)
    watchdog.take(json.dumps(slow))
    watchdog.look(0.0)
    assert log.read_text(encoding="utf-8").endswith("Look at the machine.\n")
    assert len(windows) == 1


def test_a_line_that_is_cut_off_changes_nothing(watchdog, log):
    watchdog.take(beat(window=0.0))
    assert watchdog.take('{"ages": {"win')
    watchdog.look(0.0)
    assert not log.exists()


def test_the_stop_goes_to_the_ports_that_are_there(watchdog, log, tmp_path):
    board, host = pty.openpty()
    os.set_blocking(board, False)
    watchdog.take(json.dumps({"ports": [os.ttyname(host), str(tmp_path / "gone")]}))
    watchdog.died()
    assert os.read(board, 10) == b"\0\0"
    told = log.read_text(encoding="utf-8")
    assert f"{os.ttyname(host)}: the stop was sent" in told
    assert f"{tmp_path / 'gone'}: the stop could not be sent (No such file" in told
    os.close(board)
    os.close(host)


def test_the_process_needs_the_standard_library_alone():
    script = f"import runpy; runpy.run_path({process.__file__!r})"
    subprocess.run([sys.executable, "-I", "-S", "-c", script], check=True, timeout=60)


def test_the_session_tells_who_is_alive_and_a_farewell_ends_it(log):
    session = MotionSession(Simulator(load_robot("rotemina")))
    watched = Watched(session, log, screen=False)
    watched.start()
    assert watched.number is not None
    watched.close()
    assert watched.number is None
    assert not log.exists()  # a farewell is no alarm


def test_a_window_that_is_still_made_may_take_its_time_until_something_moves(log, monkeypatch):
    session, said = MotionSession(Simulator(load_robot("rotemina"))), []
    watched = Watched(session, log, screen=False)
    monkeypatch.setattr(watched, "_say", said.append)
    session.screen.beat()
    watched.starting = True
    watched.beat()
    resting = session.snapshot()
    monkeypatch.setattr(session, "snapshot", lambda: replace(resting, activity=DeviceState.MOVING))
    watched.beat()
    watched.starting = False
    monkeypatch.setattr(session, "snapshot", lambda: resting)
    watched.beat()
    assert ["window" in one["ages"] for one in said] == [False, True, True]


def test_a_bundle_starts_its_watchdog_too(log, monkeypatch):
    """A bundle's executable does what its start-up file does here."""
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    python, *words = _command()
    start = Path(__file__).parents[3] / ".ci" / "bundle" / "start.py"
    told = subprocess.run(
        [python, str(start), *words, str(log)], input=beat(), text=True, check=False, timeout=60
    )
    assert told.returncode == 1  # the input ended without a farewell
    assert "has ended without" in log.read_text(encoding="utf-8")


PROGRAM = """
import sys, time
from pathlib import Path
from rotemina.app.motion.session import MotionSession
from rotemina.app.watchdog.heartbeat_sender import Watched, _command
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot
watched = Watched(MotionSession(Simulator(load_robot("rotemina"))), Path(sys.argv[1]), screen=False)
watched.start()
print(watched.number, flush=True)
time.sleep(600)
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").exists(), reason="memory is read from /proc")
def test_a_program_that_is_killed_is_told_of_by_a_process_that_is_small(log):
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(log)], stdout=subprocess.PIPE, text=True
    ) as program:
        number = int(program.stdout.readline())
        time.sleep(1.0)  # beats come four times a second
        status = Path(f"/proc/{number}/status").read_text(encoding="utf-8")
        program.kill()
    peak_kb = next(int(one.split()[1]) for one in status.splitlines() if one.startswith("VmHWM"))
    print(f"watchdog: {peak_kb / 1024:.1f} MB")
    assert peak_kb <= 40 * 1024
    end_s = time.monotonic() + 20.0
    while not (log.exists() and "has ended without" in log.read_text(encoding="utf-8")):
        assert time.monotonic() < end_s, "nothing was told within 20 s"
        time.sleep(0.05)
