"""An operator's day in the real program, offscreen; writes what the turns of its loop have cost.

``day.py FOLDER PART`` does one of the :data:`PARTS` of :mod:`day_steps`, and writes ``PART.json``
into the folder. The program does all that it does at a start; the day begins with the first paint.
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
from rotemina.app.settings import Settings
from rotemina.app.shell import window_run
from rotemina.app.shell.application import show_splash
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

LONG_S = 120.0  # that a step may take
SETTLED_S = 0.15  # in which what follows from a step is drawn


class Day(QObject):
    """Does one step after another in the program's own loop, each in a turn of its own."""

    def __init__(self, window, steps, leave):
        super().__init__(window)
        self._window, self._steps, self._leave = window, steps, leave
        self._meter = LoopMeter()
        self._meter.label = "start"
        self._is_reached, self._reached = True, lambda: True
        self._begin_s = self._settled_s = time.monotonic()
        self._timer = QTimer(self, interval=20)
        self._timer.timeout.connect(self._go_on)
        self._timer.start()

    def _go_on(self):
        now_s = time.monotonic()
        try:
            if not self._is_reached:
                self._is_reached, self._settled_s = bool(self._reached()), now_s
                if now_s - self._begin_s > LONG_S:
                    raise TimeoutError(f"no end after {LONG_S:.0f} s")
            elif now_s - self._settled_s >= SETTLED_S:
                self._do_next()
        except Exception:
            self._end(traceback.format_exc())

    def _do_next(self):
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
            messages = [one.line for one in self._window.log.messages()[-5:]]
            failure += f"{self._meter.label}; {bench.session.snapshot().locked}; {messages}"
        self._leave({"turns": [asdict(one) for one in self._meter.turns], "failure": failure})


class FirstPaint(QObject):
    """Calls something after a window was painted for the first time."""

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
    settings = Settings(folder / "config" / "settings.json")
    session = MotionSession(Simulator(robot, {}))
    make_window = window_run.make_window

    def leave(found):
        session.stop("the day is over")
        (folder / f"{part}.json").write_text(json.dumps(found), "utf-8")
        os._exit(0)  # how it ends is tested elsewhere

    def make(session, settings, **_):
        window = make_window(session, settings, folder / "data" / "played", speaks="en")
        operator = Operator(window, folder)
        FirstPaint(window, lambda: Day(window, PARTS[part](operator), leave))
        return window

    window_run.make_window = make
    window_run.run(session, settings, splash=splash)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
