"""A window in use without hands: a simulator with a quick clock, plays, whatever is harmless."""

import os
import random
import re
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ["LANGUAGE"] = "en"  # what may be done is known by its English words

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QTimer
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QApplication, QDialog, QMenu, QMessageBox

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import Settings
from rotemina.app.shell.application import make_application
from rotemina.app.shell.layouts import OPERATE
from rotemina.app.shell.memory_allocator import trim_heap
from rotemina.app.shell.palette_entries import Entry
from rotemina.app.shell.window_run import SWITCH_S, make_window
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

TIMES_AS_FAST = 4.0
# What ends the use, takes minutes, leaves the window, or keeps the machine from playing.
_NOT_DONE = re.compile(
    "Quit|Language|Home|Disconnect|Reconnect|Connect$|Stop and lock|Teach floor|virtual board|"
    "Solve|Compensation: (Simulator|Last record|Records|Sweep|Try it|Tune|Put on)|calibration: Run|"
    "Gap diagnosis: |Identification: Excite|browser|Penetration: (Arm|Start)|Recorder: |Mode |"
    "Microscope: (Close|Open)|Trajectory: (Play|Step|◂)|Motion: Play|Control: .* [−+]$|Go to|Back"
)
_SELDOM = re.compile("theme|contrast|text")  # a second each: all of the window is styled anew
_LONG_S = 60.0


class UsedWindow:
    """The operator's window with all panels, offscreen, and somebody who is never tired."""

    def __init__(
        self,
        robot: str = "rotemina",
        size: tuple[int, int] = (1280, 800),
        times_as_fast: float = TIMES_AS_FAST,
    ) -> None:
        trim_heap()  # as the program does
        sys.setswitchinterval(SWITCH_S)
        self.application = make_application()
        self.folder = Path(tempfile.mkdtemp(prefix="rotemina-use-"))
        simulator = Simulator(
            load_robot(robot),
            {"settle_s": 0.02},
            clock=lambda: times_as_fast * time.monotonic(),
        )
        self.session = MotionSession(simulator, stale_after_s=20.0 * times_as_fast)
        settings = Settings(self.folder / "settings.json")
        self.window = make_window(self.session, settings, self.folder / "played")
        self.bench = self.window.workbench
        self.window.resize(*size)
        self.window.show()
        self.window.arrangement.arrange(OPERATE)
        self.bench.start()
        QDesktopServices.openUrl = staticmethod(lambda _url: True)  # nothing leaves the window
        self._closer = QTimer(interval=1)
        self._closer.timeout.connect(self._close_modal)
        self._chance = random.Random(1)  # noqa: S311 (no secret)
        self._played = 0
        self.bench.run_changed.connect(lambda _: self._count())
        self.until(lambda: not self.window.panels.waiting and self.ready)

    @property
    def ready(self) -> bool:
        """Whether the machine could move now."""
        state = self.session.snapshot()
        return state.locked is None and state.activity is DeviceState.IDLE

    def _count(self) -> None:
        self._played += 1

    def settle(self, seconds: float = 0.0) -> None:
        """Let the window do what it has to do."""
        end = time.monotonic() + seconds
        while True:
            self.application.processEvents()
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
            if time.monotonic() >= end:
                return
            time.sleep(0.001)

    def until(self, reached: Callable[[], bool]) -> None:
        """Wait for something that must come.

        Raises
        ------
        TimeoutError
            If it does not.
        """
        end = time.monotonic() + _LONG_S
        while not reached():
            if time.monotonic() > end:
                said = [one.line for one in self.window.log.messages()[-3:]]
                raise TimeoutError(f"it did not come: {self.session.snapshot().locked}, {said}")
            self.settle(0.002)

    def plan(self, seconds: float = 0.2, rate_hz: float = 500.0) -> None:
        """Take a short trajectory of all piezos in hand, there and back."""
        time_s = np.arange(round(seconds * rate_hz) + 1) / rate_hz
        swing = np.sin(np.pi * time_s / time_s[-1]) ** 2
        signals, units = {}, {}
        for name in ("thx", "thy", "zn"):
            own = self.session.robot.axes[name]
            signals[name, Tap.CMD] = sum(own.range) / 2 + 0.05 * own.span * swing
            units[name] = own.unit
        before = self.bench.plan
        self.bench.plan_trajectory("use", Record.from_signals(time_s, signals, units))
        self.until(lambda: self.bench.plan is not before)

    def play(self) -> None:
        """Play a trajectory, and wait until it is compared and written.

        What is in hand may be a piece too short to be compared: chance also sets where it begins.
        """
        self.plan()
        before = self._played
        while not self.bench.ask(self._begin):
            self.settle(0.05)  # what was done before still moves it
        self.until(lambda: self._played > before and not self.bench.busy)

    def _begin(self) -> None:
        self.until(lambda: self.ready)
        self.bench.playback.play(self.bench.plan.dry_run.require())

    def entries(self) -> list[Entry]:
        """Return what may be done now, as the command palette offers it."""
        return [
            one
            for one in self.window._entries()
            if one.why_not is None and not _NOT_DONE.search(one.text)
        ]

    def act(self, count: int) -> list[str]:
        """Do some things by chance; return what."""
        entries = self.entries()
        weights = [0.1 if _SELDOM.search(one.text) else 1.0 for one in entries]
        done = []
        for one in self._chance.choices(entries, weights, k=count):
            self.do(one)
            done.append(one.text)
        return done

    def do(self, entry: Entry) -> None:
        """Do one thing, and close whatever it opened."""
        self._closer.start()
        entry.run()
        self._closer.stop()
        self.settle()
        for widget in QApplication.topLevelWidgets():
            if isinstance(widget, QDialog | QMenu) and widget.isVisible():
                widget.close()
        self.settle()

    def notify(self, text: str) -> None:
        """Tell the operator something."""
        from rotemina.app.shell.workbench import Level

        self.bench.notify(Level.INFO, text)

    def _close_modal(self) -> None:
        dialog = QApplication.activeModalWidget()
        if isinstance(dialog, QMessageBox | QDialog):
            dialog.reject()
        menu = QApplication.activePopupWidget()
        if menu is not None:
            menu.close()

    def close(self) -> None:
        """End all."""
        self.bench.close()
        self.window.hide()
