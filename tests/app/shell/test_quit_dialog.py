"""Leaving while a recording is put together, and stops from windows beside the main one."""

import html
import os
import signal
import subprocess
import sys
import threading

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from rotemina.app.motion.recording.errors import RecordingError

PANELS = ("faults",)

LONG_MS = 30_000


def test_a_long_recording_does_not_hold_up_the_window(qtbot, window, monkeypatch):
    operation, said = window.workbench.operation, window.notices.notices
    gate, ended, stop = threading.Event(), [], operation.stop_recording

    def fail():
        raise RecordingError("the disk is full")

    def wait_and_stop():
        gate.wait(30.0)
        ended.append(threading.current_thread() is not threading.main_thread())
        return stop()

    operation.start_recording()
    monkeypatch.setattr(operation, "stop_recording", fail)
    window.close()
    qtbot.waitUntil(lambda: said()[0].text == "the disk is full", timeout=LONG_MS)
    assert window.isVisible()
    monkeypatch.setattr(operation, "stop_recording", wait_and_stop)
    window.close()
    assert window.isVisible()
    assert "closes as soon as" in said()[0].text
    line = window.progress_line
    qtbot.waitUntil(lambda: "one file" in line.text.text(), timeout=LONG_MS)  # the loop runs
    assert line.cancel.isHidden()
    gate.set()
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert ended == [True]
    assert list(operation.recordings.glob("*.arrows"))


def test_stops_reach_from_a_floating_dock_and_from_a_page(
    qtbot, window, press_escape, open_menu, press_behind_menu
):
    session = window.workbench.session
    dock = window.docks["faults"]
    dock.setFloating(True)
    dock.activateWindow()
    window.show_log()
    window.palette_page.show()
    for widget in (dock, window.log_page.words, window.palette_page.field):
        press_escape(widget, Qt.KeyboardModifier.ShiftModifier)
        assert session.snapshot().latched is not None
        window.workbench.release()
        assert session.snapshot().latched is None
    menu = open_menu(window)
    button = window.emergency_button
    press_behind_menu(menu, button)
    assert session.snapshot().latched is not None
    menu.close()
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)  # in alarm: it stays latched
    assert session.snapshot().latched is not None
    window.workbench.release()
    button.refresh(session.snapshot())
    for each in (button, window.stop_button):
        assert "not the machine" in html.unescape(each.toolTip())
    QApplication.processEvents()


PROGRAM = """
import sys
from pathlib import Path
from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import Settings
from rotemina.app.shell.application import show_splash
from rotemina.app.shell.window_run import run
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

splash = show_splash()

class Told(MotionSession):
    def start(self):
        super().start()
        print("started", flush=True)

    def stop(self, *given, **named):
        super().stop(*given, **named)
        print("stopped, splash", "seen" if splash.isVisible() else "gone", flush=True)

session = Told(Simulator(load_robot("rotemina")))
sys.exit(run(session, Settings(Path(sys.argv[1]) / "settings.json"), splash=splash))
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
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
