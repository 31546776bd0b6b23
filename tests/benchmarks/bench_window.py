"""The window: time until all visible parts are painted.

Limit: painted and the machine ready within 2 s in a warm start.
"""

import os
import subprocess
import sys
import time
from statistics import median

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
QUICK = {"STARTS": 2}

# The start command, in a form that accepts the offscreen platform as a display.
START = """
import os, time
from rotemina.app.cli.main import main
from rotemina.app.motion.state import SessionPhase
from rotemina.app.shell.startup import window_start as start

def no_fault():  # Qt is loaded next
    from PySide6.QtCore import QEvent, QObject, QTimer
    from PySide6.QtWidgets import QApplication
    from rotemina.app.shell.startup import application

    class Watcher(QObject):
        painted = field = None

        def eventFilter(self, watched, event):
            if event.type() == QEvent.Type.Paint and self.painted is None:
                self.painted = time.time()
            return False

    # The timer is slow, because its own cost is part of the measured start.
    watcher, timer, show_splash = Watcher(), QTimer(interval=10), application.show_splash
    windows = []

    # A panel is made when its dock becomes visible.
    def watch():
        if not windows:
            windows.extend(w for w in QApplication.topLevelWidgets() if hasattr(w, "panels"))
            return
        made = windows[0].panels.made
        if watcher.field is None and "control" in made and "trajectory" in made:
            watcher.field = made["control"].rows["x"].target
            watcher.field.installEventFilter(watcher)
            watcher.field.update()
        state = windows[0].workbench.session.snapshot() if watcher.painted else None
        if state is not None and state.phase is SessionPhase.READY:
            print(watcher.painted, time.time(), time.process_time(), flush=True)
            os._exit(0)

    def show_and_watch():
        splash = show_splash()
        timer.timeout.connect(watch)
        timer.start()
        return splash

    application.show_splash = show_and_watch

start.find_display_fault = no_fault
main([])
"""

STARTS = 6


def test_time_to_first_paint(tmp_path):
    folders = {f"XDG_{kind}_HOME": str(tmp_path) for kind in ("DATA", "CONFIG", "CACHE")}
    environment = {**os.environ, **folders}
    # A warm start has compiled modules, like an installed program from its second start on.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    runs = []
    for _ in range(STARTS):
        begin = time.time()
        process = subprocess.run(
            [sys.executable, "-c", START],
            check=True,
            capture_output=True,
            env=environment,
            timeout=60,
        )
        painted, ready, busy_s = map(float, process.stdout.split())
        runs.append((painted - begin, ready - begin, busy_s))
    warm = runs[1:]
    print(f"start of the command, {len(warm)} warm runs, s (limit 2): median (smallest to largest)")
    for name, seconds in zip(
        ("first paint", "ready machine", "ready machine, processor"),
        zip(*warm, strict=True),
        strict=True,
    ):
        print(f"{name}: {median(seconds):.2f} ({min(seconds):.2f} to {max(seconds):.2f})")
