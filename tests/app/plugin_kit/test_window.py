"""The real window opens and stays, whatever the panels of others do, and names each of them."""

import json
import os
import subprocess
import sys
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
from rotemina.app.shell.window_run import make_application, run
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim import plugin_import, plugin_points
from rotemina.sim.robot.file import load_robot

plugin_points.import_fault = partial(plugin_import.import_fault, limit_s=25.0)
told, tries = [], 0


def look():
    global tries
    (window,) = [one for one in QApplication.topLevelWidgets() if isinstance(one, MainWindow)]
    named = {name for name in ("paints", "ticks") if name in window.panels}
    tries += 1
    if named and tries < 400:
        "paints" in window.panels and window.bring_up("paints")  # its tab is behind the controls
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


def test_the_window_opens_and_names_what_it_leaves_out(tmp_path):
    site = tmp_path / "site"
    about = site / "others-1.0.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: others\nVersion: 1.0\n")
    for name, text in PANELS.items():
        (site / f"others_{name}.py").write_text(dedent(text))
    points = "\n".join(f"{name} = others_{name}:Any" for name in PANELS)
    (about / "entry_points.txt").write_text(f"[rotemina.panels]\n{points}\n")
    script = tmp_path / "window.py"
    script.write_text(WINDOW)
    folders = {f"XDG_{what}_HOME": str(tmp_path / what) for what in ("CACHE", "DATA", "CONFIG")}
    environment = {
        **os.environ,
        **folders,
        "PYTHONPATH": str(site),
        "QT_QPA_PLATFORM": "offscreen",
    }
    done = subprocess.run(
        [sys.executable, script],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
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
        "paints": "is left out after failing to paint itself: ValueError: no colour",
        "ticks": "is left out after failing 3 times: ZeroDivisionError",
    }.items():
        assert name not in answer["panels"]
        (line,) = [line for line in answer["told"] if f"Panel '{name}' is left out" in line]
        assert reason in line, said
