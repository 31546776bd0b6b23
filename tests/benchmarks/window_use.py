"""Automatic use of a window: a simulator with a fast clock, playback, random harmless actions."""

import os
import random
import re
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
# The actions are identified by their English texts.
os.environ["LANGUAGE"] = "en"

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QTimer
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QApplication, QDialog, QMenu, QMessageBox

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import UserSettings
from rotemina.app.shell.startup.application import make_application
from rotemina.app.shell.startup.memory_allocator import configure_allocator
from rotemina.app.shell.startup.window_run import THREAD_SWITCH_S, make_window
from rotemina.app.shell.window import OPERATE
from rotemina.app.shell.window.palette_entries import PaletteEntry
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.simulator import Simulator
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

TIMES_AS_FAST = 4.0
# Actions that end the program, take minutes, leave the window, or prevent playback.
_EXCLUDED_ACTIONS = re.compile(
    "Quit|Language|Home|Disconnect|Reconnect|Connect$|Stop and lock|Teach floor|virtual board|"
    "Solve|Compensation: (Simulator|Last record|Records|Sweep|Try it|Tune|Put on)|calibration: Run|"
    "Gap diagnosis: |Identification: Excite|browser|Penetration: (Arm|Start)|Recorder: |Mode |"
    "Microscope: (Close|Open)|Trajectory: (Play|Step|◂)|Motion: Play|Control: .* [−+]$|Go to|Back"
)
# These actions take a second each, because the whole window gets a new style.
_SLOW_ACTIONS = re.compile("theme|contrast|text")
_TIMEOUT_S = 60.0


class WindowUse:
    """Automatic use of the main window with all panels, offscreen."""

    def __init__(
        self,
        robot: str = "rotemina",
        size: tuple[int, int] = (1280, 800),
        times_as_fast: float = TIMES_AS_FAST,
    ) -> None:
        # As at the start of the program.
        configure_allocator()
        sys.setswitchinterval(THREAD_SWITCH_S)
        self.application = make_application()
        self.folder = Path(tempfile.mkdtemp(prefix="rotemina-use-"))
        simulator = Simulator(
            load_robot(robot),
            {"settle_s": 0.02},
            clock=lambda: times_as_fast * time.monotonic(),
        )
        self.session = MotionSession(simulator, stale_after_s=20.0 * times_as_fast)
        settings = UserSettings(self.folder / "settings.json")
        self.window = make_window(self.session, settings, self.folder / "played")
        self.bench = self.window.workbench
        self.window.resize(*size)
        self.window.show()
        self.window.arrangement.arrange(OPERATE)
        self.bench.start()
        # No browser may open.
        QDesktopServices.openUrl = staticmethod(lambda _url: True)
        self._closer = QTimer(interval=1)
        self._closer.timeout.connect(self._close_modal)
        self._random = random.Random(1)  # noqa: S311 (no secret)
        self._playback_count = 0
        self.bench.run_changed.connect(lambda _: self._count())
        self.wait_until(lambda: not self.window.panels.pending_names and self.ready)

    @property
    def ready(self) -> bool:
        """Whether the machine can move now."""
        state = self.session.snapshot()
        return state.lock_reason is None and state.activity is DeviceState.IDLE

    def _count(self) -> None:
        self._playback_count += 1

    def settle(self, seconds: float = 0.0) -> None:
        """Process the events of the window."""
        end = time.monotonic() + seconds
        while True:
            self.application.processEvents()
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
            if time.monotonic() >= end:
                return
            time.sleep(0.001)

    def wait_until(self, condition: Callable[[], bool]) -> None:
        """Wait until a condition is true.

        Raises
        ------
        TimeoutError
            If the condition stays false for too long.
        """
        end = time.monotonic() + _TIMEOUT_S
        while not condition():
            if time.monotonic() > end:
                messages = [message.line for message in self.window.log.messages()[-3:]]
                raise TimeoutError(
                    f"the condition stays false: {self.session.snapshot().lock_reason}, {messages}"
                )
            self.settle(0.002)

    def plan(self, seconds: float = 0.2, rate_hz: float = 500.0) -> None:
        """Load a short trajectory that moves all piezos back and forth."""
        time_s = np.arange(round(seconds * rate_hz) + 1) / rate_hz
        swing = np.sin(np.pi * time_s / time_s[-1]) ** 2
        signals, units = {}, {}
        for name in ("thx", "thy", "zn"):
            axis = self.session.robot.axes[name]
            signals[name, Tap.CMD] = sum(axis.range) / 2 + 0.05 * axis.span * swing
            units[name] = axis.unit
        previous_plan = self.bench.plan
        self.bench.plan_trajectory("use", Record.from_signals(time_s, signals, units))
        self.wait_until(lambda: self.bench.plan is not previous_plan)

    def play(self) -> None:
        """Play a trajectory, and wait until it is compared and written.

        A new trajectory is loaded first: random actions may have left only a piece of the loaded
        one, too short for a comparison.
        """
        self.plan()
        previous_count = self._playback_count
        while not self.bench.run_request(self._begin):
            # An earlier action still moves the machine.
            self.settle(0.05)
        self.wait_until(lambda: self._playback_count > previous_count and not self.bench.busy)

    def _begin(self) -> None:
        self.wait_until(lambda: self.ready)
        self.bench.playback.play(self.bench.plan.dry_run.require())

    def entries(self) -> list[PaletteEntry]:
        """Return the permitted entries of the command palette."""
        return [
            entry
            for entry in self.window._make_palette_entries()
            if entry.objection is None and not _EXCLUDED_ACTIONS.search(entry.text)
        ]

    def run_random_entries(self, count: int) -> list[str]:
        """Run random entries; return their texts."""
        entries = self.entries()
        weights = [0.1 if _SLOW_ACTIONS.search(entry.text) else 1.0 for entry in entries]
        texts = []
        for entry in self._random.choices(entries, weights, k=count):
            self.run_entry(entry)
            texts.append(entry.text)
        return texts

    def run_entry(self, entry: PaletteEntry) -> None:
        """Run one entry, and close the dialogs and menus that it opened."""
        self._closer.start()
        entry.run()
        self._closer.stop()
        self.settle()
        for widget in QApplication.topLevelWidgets():
            if isinstance(widget, QDialog | QMenu) and widget.isVisible():
                widget.close()
        self.settle()

    def _close_modal(self) -> None:
        dialog = QApplication.activeModalWidget()
        if isinstance(dialog, QMessageBox | QDialog):
            dialog.reject()
        menu = QApplication.activePopupWidget()
        if menu is not None:
            menu.close()

    def close(self) -> None:
        """Close the workbench and hide the window."""
        self.bench.close()
        self.window.hide()
