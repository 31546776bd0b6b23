"""The real window opens and stays, whatever the panels of others do, and names each of them."""

import json
import os
import subprocess
import sys
import time
from textwrap import dedent

import pytest

pytestmark = pytest.mark.slow

PANELS = {
    "hangs": "import threading; threading.Event().wait()",
    "dies": "import os; os.abort()",
    "raises": "raise RuntimeError('no licence')",
    "paints": """
        from PySide6.QtGui import QPainter
        from rotemina.app.panel import Area, Panel

        class Any(Panel):
            title = "Paints badly"
            area = Area.LEFT

            def paintEvent(self, event):
                self.painter = QPainter(self)
                raise ValueError("no colour")
    """,
    "ticks": """
        from PySide6.QtCore import QTimer
        from rotemina.app.panel import Panel

        class Any(Panel):
            title = "Ticks badly"

            def __init__(self, workbench):
                super().__init__(workbench)
                self.timer = QTimer(self, interval=20)
                self.timer.timeout.connect(lambda: 1 / 0)
                self.timer.start()
    """,
    "leaves": """
        import sys
        from PySide6.QtCore import QTimer
        from rotemina.app.panel import Panel

        class Any(Panel):
            title = "Leaves"

            def __init__(self, workbench):
                super().__init__(workbench)
                self.timer = QTimer(self, interval=20)
                self.timer.timeout.connect(lambda: sys.exit(3))
                self.timer.start()
    """,
    "paints_an_end": """
        from rotemina.app.panel import Area, Panel

        class Any(Panel):
            title = "Paints an end"
            area = Area.LEFT

            def paintEvent(self, event):
                quit()
    """,
    "interrupts": """
        from rotemina.app.panel import Panel

        class Any(Panel):
            title = "Interrupts"

            def __init__(self, workbench):
                raise KeyboardInterrupt
    """,
    "threads": """
        import threading
        from rotemina.app.panel import Panel

        class Any(Panel):
            title = "Threads"

            def __init__(self, workbench):
                super().__init__(workbench)
                for _ in range(3):
                    threading.Thread(target=self.work).start()

            def work(self):
                raise OSError("no such device")
    """,
    "good": """
        from rotemina.app.panel import Panel

        class Any(Panel):
            title = "Good"
    """,
}
WINDOW = """
import json, sys
from functools import partial
from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import Settings
from rotemina.app.shell.main_window import MainWindow
from rotemina.app.shell.application import make_application
from rotemina.app.shell.window_run import run
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim import plugin_import, plugin_points
from rotemina.sim.robot.file import load_robot

plugin_points.import_fault = partial(plugin_import.import_fault, limit_s=25.0)
told, tries = [], 0


def look():
    global tries
    (window,) = [one for one in QApplication.topLevelWidgets() if isinstance(one, MainWindow)]
    bad = ("paints", "ticks", "leaves", "paints_an_end", "interrupts", "threads")
    named = [name for name in bad if name in window.panels]
    said = "".join(told)
    silent = [name for name in bad if f"Panel '{name}' is left out" not in said]
    tries += 1
    if (named or silent) and tries < 400:
        if named:
            window.bring_up(named[tries % len(named)])  # tabs are behind the controls
        QTimer.singleShot(50, look)
        return
    answer = {"panels": list(window.panels), "told": told, "visible": window.isVisible()}
    Path("answer.json").write_text(json.dumps(answer))
    window.close()


make_application()
notify = MainWindow.__init__.__globals__["Workbench"].notify
MainWindow.__init__.__globals__["Workbench"].notify = lambda self, level, text, **about: (
    told.append(text), notify(self, level, text, **about)
)
QTimer.singleShot(500, look)
sys.exit(run(MotionSession(Simulator(load_robot("rotemina"))), Settings(Path("settings.json"))))
"""


@pytest.fixture
def place(tmp_path):
    """Return a function that installs panels and runs a script with the window beside them."""

    def run(panels, script):
        site = tmp_path / "site"
        about = site / "others-1.0.dist-info"
        about.mkdir(parents=True)
        (about / "METADATA").write_text("Metadata-Version: 2.1\nName: others\nVersion: 1.0\n")
        for name, text in panels.items():
            (site / f"others_{name}.py").write_text(dedent(text))
        points = "\n".join(f"{name} = others_{name}:Any" for name in panels)
        (about / "entry_points.txt").write_text(f"[rotemina.panels]\n{points}\n")
        (tmp_path / "window.py").write_text(script)
        folders = {f"XDG_{what}_HOME": str(tmp_path / what) for what in ("CACHE", "DATA", "CONFIG")}
        paths = filter(None, [str(site), os.environ.get("PYTHONPATH")])
        environment = {
            **os.environ,
            **folders,
            "PYTHONPATH": os.pathsep.join(paths),
            "QT_QPA_PLATFORM": "offscreen",
        }
        return subprocess.run(
            [sys.executable, "window.py"],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            timeout=300,
        )

    return run


def test_the_window_opens_and_names_what_it_leaves_out(place, tmp_path):
    done = place(PANELS, WINDOW)
    assert done.returncode == 0, done.stderr
    answer = json.loads((tmp_path / "answer.json").read_text())
    assert answer["visible"]
    assert "good" in answer["panels"], answer["told"]
    assert "control" in answer["panels"]
    said = "\n".join(answer["told"])
    for name, reason in {
        "hangs": "its import did not end within 25 s",
        "dies": "its import ends the whole process",
        "raises": "RuntimeError: no licence",
        "paints": "is left out: it cannot be drawn: ValueError: no colour",
        "ticks": "is left out after 3 faults: ZeroDivisionError",
        "leaves": "is left out after 3 faults: ExitRefusedError: it called exit(3)",
        "paints_an_end": "it cannot be drawn: ExitRefusedError: it called exit(None)",
        "interrupts": "KeyboardInterrupt",
        "threads": "is left out after 3 faults: OSError: no such device",
    }.items():
        assert name not in answer["panels"]
        (line,) = [line for line in answer["told"] if f"Panel '{name}' is left out" in line]
        assert reason in line, said


MOVING = """
import sys
from pathlib import Path

from rotemina.app.motion.session import MotionSession
from rotemina.app.settings import Settings
from rotemina.app.shell.window_run import run
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot


class Told(Simulator):
    def _stop(self):
        with Path("stops").open("a") as file:
            file.write("stop ")
        super()._stop()


sys.exit(run(MotionSession(Told(load_robot("rotemina"))), Settings(Path("settings.json"))))
"""
LEAVING = """
    import os, sys
    from PySide6.QtCore import QTimer
    from rotemina.app.panel import Panel

    class Any(Panel):
        title = "Leaves without a word"

        def __init__(self, workbench):
            super().__init__(workbench)
            workbench.refreshed.connect(self.look)
            self.begun = False

        def look(self, state):
            if state.locked is None and not self.begun:
                self.begun = True
                open("stops", "w").close()
                self.workbench.session.jog("x", 5e-3)
                QTimer.singleShot(1500, self.leave)

        def leave(self):
            {end}
"""


@pytest.mark.parametrize(
    ("end", "stopped"),
    [("raise SystemExit(3)", "stop"), ("os._exit(3)", ""), ("os.abort()", "")],
)
def test_what_ends_the_process_all_the_same_stops_the_machine(place, tmp_path, end, stopped):
    """The exit path says the stop where Python still runs; else the watchdog beside it does."""
    done = place({"leaving": LEAVING.replace("{end}", end)}, MOVING)
    assert done.returncode != 0
    assert (tmp_path / "stops").read_text().startswith(stopped)
    log = tmp_path / "DATA" / "rotemina" / "watchdog.log"
    end_s = time.monotonic() + 20.0
    while not (log.exists() and "has ended without letting go" in log.read_text()):
        assert time.monotonic() < end_s, "the watchdog told nothing within 20 s"
        time.sleep(0.05)
