"""Pictures of the window and of every panel, drawn without a display."""

import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rotemina.app.shell.main_window import MainWindow

os.environ["QT_QPA_PLATFORM"] = "offscreen"

_TURNS = 20  # of the event loop, in which what waits for its turn is drawn
SIZES = ((1280, 800), (1920, 1080))


def main(folder: Path) -> int:
    """Write the pictures into ``folder`` and say how many; return the exit status."""
    from PySide6.QtWidgets import QApplication

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import Settings
    from rotemina.app.shell.layouts import OPERATE
    from rotemina.app.shell.offscreen_run import tell_the_story
    from rotemina.app.shell.qt_messages import log_qt_messages
    from rotemina.app.shell.window_run import make_window
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.robot.file import load_robot
    from rotemina.sim.trajectory.worn_machine_demo import worn_effects

    log_qt_messages()
    folder.mkdir(parents=True, exist_ok=True)
    robot = load_robot("rotemina")
    count = 0
    with tempfile.TemporaryDirectory() as kept:
        settings = Settings(Path(kept) / "settings.json")
        settings.set("window.language", "en")
        window = make_window(MotionSession(Simulator(robot)), settings, Path(kept) / "played")
        window.show()
        window.workbench.start()
        window.panels.make_all()
        tell_the_story(window, worn_effects(robot))
        finish_work(window)
        window.panels["gap"].result.tabs.setCurrentIndex(2)  # how far the gap shrinks
        window.workbench.emergency_stop()
        window.workbench.refreshed.emit(window.workbench.session.snapshot())
        window.workbench.release()
        window.workbench.teach_floor()
        window.workbench.refreshed.emit(window.workbench.session.snapshot())
        for theme, front in (("dark", "comparison"), ("light", "trajectory")):
            window.use_theme(theme)
            for width, height in SIZES:
                window.resize(width, height)
                window.arrangement.arrange(OPERATE)  # as at a first start
                for name in ("plots", front):
                    window.bring_up(name)
                for _ in range(_TURNS):
                    QApplication.processEvents()
                window.grab().save(str(folder / f"window-{width}x{height}-{theme}.png"))
                count += 1
        window.use_theme("dark")
        for width, height in SIZES:  # last: docks keep the widths that they are given here
            window.resize(width, height)
            for name, panel in window.panels.items():
                bring_up(window, name)
                panel.grab().save(str(folder / f"{name}-{width}x{height}-dark.png"))
                count += 1
        window.workbench.close()
        window.hide()
        count += in_german(folder, Path(kept))
    print(f"{count} pictures in {folder}")
    return 0


def finish_work(window: "MainWindow") -> None:
    """Let the panels that compute do so, on what was played or on the simulated machine."""
    import numpy as np
    from PySide6.QtWidgets import QApplication

    from rotemina.sim.calibration.plan import calibration_motion
    from rotemina.sim.robot.model import AxisEffect
    from rotemina.sim.simulation.simulation import simulate

    plate, compensation = window.panels["plate"], window.panels["compensation"]
    calibration, robot = window.panels["calibration"], window.workbench.robot
    motion = calibration_motion(robot, "x")
    rng = np.random.default_rng(0)
    encoder = AxisEffect(axis="x", id="sensor_gain", parameters={"error": 2e-4})
    calibration.fit_record("x.csv", simulate(robot, [encoder], motion, rng))
    plate.solve()
    axis = compensation.controls.axis
    axis.setCurrentIndex(axis.findData("zn"))  # the one with hysteresis
    compensation.learn_simulated()
    while (
        window.workbench.busy
        or compensation.job.running
        or plate.solved is None
        or calibration.calibration is None
    ):
        QApplication.processEvents()


def in_german(folder: Path, kept: Path) -> int:
    """Write a picture of each layout in German, after a short trajectory; return how many."""
    from PySide6.QtWidgets import QApplication

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import Settings
    from rotemina.app.shell.layouts import BUILT_IN
    from rotemina.app.shell.offscreen_run import play
    from rotemina.app.shell.window_run import make_window
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.robot.file import load_robot
    from rotemina.sim.trajectory.first_trajectory import example_for

    robot = load_robot("rotemina")
    settings = Settings(kept / "german.json")
    settings.set("window.language", "de")
    window = make_window(MotionSession(Simulator(robot)), settings, kept / "played")
    window.show()
    window.workbench.start()
    window.panels.make_all()
    play(window, example_for(robot))
    while window.workbench.busy:
        QApplication.processEvents()
    width, height = SIZES[0]
    for layout in BUILT_IN:
        window.arrangement.arrange(layout)
        window.resize(width, height)
        for _ in range(_TURNS):
            QApplication.processEvents()
        word = layout.word.lower().replace(" ", "-")
        name = f"window-de-{word}-{width}x{height}-dark.png"
        window.grab().save(str(folder / name))
    window.workbench.close()
    window.hide()
    return len(BUILT_IN)


def bring_up(window: "MainWindow", name: str) -> None:
    """Put a panel before the others of its place; the microscope with its first picture."""
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QApplication

    panel = window.panels[name]
    for other, dock in window.docks.items():  # which it would share a small screen with
        dock.setVisible(other == name)
    window.bring_up(name)
    if name in window.docks:
        window.resizeDocks([window.docks[name]], [window.height()], Qt.Orientation.Vertical)
    for _ in range(_TURNS):  # what waited until it is seen is drawn by then
        QApplication.processEvents()
    while name == "microscope" and panel.view.frame is None:
        QApplication.processEvents()


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/screenshots")))
