"""An operator's day in the real program, offscreen; measures the turns of the event loop.

``day.py FOLDER PART`` runs one of the :data:`PARTS` of :mod:`day_steps`, and writes ``PART.json``
into the folder. The program starts completely as usual; the day begins with the first paint.
"""

import gc
import json
import logging
import os
import sys
import time
import traceback
from dataclasses import asdict
from pathlib import Path

os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ["LANGUAGE"] = "en"

from day_steps import PARTS, Operator, prepare
from loop_meter import LoopMeter
from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtGui import QDesktopServices

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import UserSettings
from rotemina.app.shell.startup import window_run
from rotemina.app.shell.startup.application import show_splash
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

# A step fails after this time.
MAX_STEP_S = 120.0
# Time for drawing the consequences of a step.
SETTLING_S = 0.15


class DayRun(QObject):
    """Runs one step after another in the event loop of the program, each in a separate turn."""

    def __init__(self, window, steps, finish):
        super().__init__(window)
        self._window, self._steps, self._finish = window, steps, finish
        self._meter = LoopMeter()
        self._meter.label = "start"
        self._is_reached, self._reached = True, lambda: True
        self._begin_s = self._settled_s = time.monotonic()
        self._timer = QTimer(self, interval=20)
        self._timer.timeout.connect(self._check_step)
        self._timer.start()

    def _check_step(self):
        now_s = time.monotonic()
        try:
            if not self._is_reached:
                self._is_reached, self._settled_s = bool(self._reached()), now_s
                if now_s - self._begin_s > MAX_STEP_S:
                    raise TimeoutError(f"not finished after {MAX_STEP_S:.0f} s")
            elif now_s - self._settled_s >= SETTLING_S:
                self._start_next_step()
        except Exception:
            self._end(traceback.format_exc())

    def _start_next_step(self):
        step = next(self._steps, None)
        if step is None:
            self._end("")
            return
        self._meter.label, act, self._reached = step
        self._is_reached, self._begin_s = False, time.monotonic()
        act()

    def _end(self, failure):
        self._timer.stop()
        self._meter.close()
        if failure:
            bench = self._window.workbench
            messages = [message.line for message in self._window.log.messages()[-5:]]
            failure += f"{self._meter.label}; {bench.session.snapshot().lock_reason}; {messages}"
        self._finish({"turns": [asdict(turn) for turn in self._meter.turns], "failure": failure})


class FirstPaint(QObject):
    """Calls a function after the first paint of a window."""

    def __init__(self, window, call):
        super().__init__(window)
        self._call = call
        window.installEventFilter(self)

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        if event.type() == QEvent.Type.Paint and self._call is not None:
            call, self._call = self._call, None
            QTimer.singleShot(0, call)
        return False


def main(folder, part):
    logging.basicConfig(level=logging.ERROR)
    robot = load_robot("rotemina")
    prepare(folder, robot, part)
    gc.disable()
    QDesktopServices.openUrl = staticmethod(lambda _: True)
    splash = show_splash()
    settings = UserSettings(folder / "config" / "settings.json")
    session = MotionSession(Simulator(robot, {}))
    make_window = window_run.make_window

    def finish(result):
        session.stop("the day is over")
        (folder / f"{part}.json").write_text(json.dumps(result), "utf-8")
        # The end of the program is tested elsewhere.
        os._exit(0)

    def make_observed_window(session, settings, **_):
        window = make_window(session, settings, folder / "data" / "played", ui_language="en")
        operator = Operator(window, folder)
        FirstPaint(window, lambda: DayRun(window, PARTS[part](operator), finish))
        return window

    window_run.make_window = make_observed_window
    window_run.run(session, settings, splash=splash)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
