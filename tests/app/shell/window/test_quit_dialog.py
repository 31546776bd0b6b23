"""Closing while a recording is being finished, and stops from other windows than the main one."""

import html
import os
import signal
import subprocess
import sys
import threading

import pytest
from PySide6.QtCore import Qt

from rotemina.app.errors import RecordingError

PANELS = ("faults",)

LONG_MS = 30_000


def test_finishing_a_long_recording_does_not_block_the_window(qtbot, window, monkeypatch):
    operation, notices = window.workbench.operation, window.notices.notices
    gate, on_worker_thread, original_stop = threading.Event(), [], operation.stop_recording

    def fail():
        raise RecordingError("the disk is full")

    def wait_and_stop():
        gate.wait(30.0)
        on_worker_thread.append(threading.current_thread() is not threading.main_thread())
        return original_stop()

    operation.start_recording()
    monkeypatch.setattr(operation, "stop_recording", fail)
    window.close()
    qtbot.waitUntil(lambda: notices()[0].text == "the disk is full", timeout=LONG_MS)
    assert window.isVisible()
    monkeypatch.setattr(operation, "stop_recording", wait_and_stop)
    window.close()
    assert window.isVisible()
    assert "closes as soon as" in notices()[0].text
    line = window.progress_line
    qtbot.waitUntil(lambda: "one file" in line.text.text(), timeout=LONG_MS)  # the event loop runs
    assert line.cancel.isHidden()
    gate.set()
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert on_worker_thread == [True]
    assert list(operation.recordings.glob("*.arrows"))


def test_stops_work_from_a_floating_dock_and_a_page(window, press_escape):
    session = window.workbench.session
    dock = window.docks["faults"]
    dock.setFloating(True)
    dock.activateWindow()
    window.show_log()
    window.palette_page.show()
    for widget in (dock, window.log_page.words, window.palette_page.field):
        press_escape(widget, Qt.KeyboardModifier.ShiftModifier)
        assert session.snapshot().latch_reason is not None
        window.workbench.release()
        assert session.snapshot().latch_reason is None
    window.emergency_button.refresh(session.snapshot())
    for button in (window.emergency_button, window.stop_button):
        assert "not the machine" in html.unescape(button.toolTip())


PROGRAM = """
import sys
from pathlib import Path
from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import UserSettings
from rotemina.app.shell.startup.application import show_splash
from rotemina.app.shell.startup.window_run import run
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

splash = show_splash()

class ReportingSession(MotionSession):
    def start(self):
        super().start()
        print("started", flush=True)

    def stop(self, *args, **kwargs):
        super().stop(*args, **kwargs)
        print("stopped, splash", "seen" if splash.isVisible() else "gone", flush=True)

session = ReportingSession(Simulator(load_robot("rotemina")))
if len(sys.argv) > 2:
    # A panel that handles events in its constructor receives the signal.
    import signal
    from PySide6.QtCore import QCoreApplication
    from rotemina.app.shell.startup import window_run
    make_window = window_run.make_window

    def make(*args, **kwargs):
        window = make_window(*args, **kwargs)
        signal.raise_signal(signal.SIGTERM)
        QCoreApplication.processEvents()
        print("made", flush=True)
        return window

    window_run.make_window = make
sys.exit(run(session, UserSettings(Path(sys.argv[1]) / "settings.json"), splash=splash))
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SIGINT", "SIGHUP"])
def test_a_signal_stops_the_machine_before_the_program_ends(tmp_path, name):
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(tmp_path)],
        env={**os.environ, "XDG_DATA_HOME": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"},
        stdout=subprocess.PIPE,
        text=True,
    ) as program:
        assert program.stdout.readline() == "started\n"
        program.send_signal(signal.Signals[name])
        assert program.stdout.readline() == "stopped, splash gone\n"
        program.stdout.read()
    assert program.returncode == 128 + signal.Signals[name]


@pytest.mark.slow
def test_a_signal_while_the_window_is_made_ends_the_program(tmp_path):
    program = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path), "early"],
        env={**os.environ, "XDG_DATA_HOME": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        timeout=60.0,
    )
    assert "Error" not in program.stderr
    assert program.stdout.splitlines()[:2] == ["made", "stopped, splash seen"]
    assert program.returncode == 128 + signal.SIGTERM
