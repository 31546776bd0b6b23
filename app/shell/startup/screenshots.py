"""Pictures of the window and of every panel, drawn without a display."""

import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rotemina.app.shell.window import MainWindow

os.environ["QT_QPA_PLATFORM"] = "offscreen"

# Event-loop turns after which all delayed drawing is done.
_EVENT_LOOP_TURNS = 20
WINDOW_SIZES = ((1280, 800), (1920, 1080))


def main(folder: Path) -> int:
    """Write the pictures into ``folder``, print their number, and return the exit status."""
    from PySide6.QtWidgets import QApplication

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import UserSettings
    from rotemina.app.shell.startup.offscreen_run import run_demonstration
    from rotemina.app.shell.startup.qt_setup import log_qt_messages
    from rotemina.app.shell.startup.window_run import make_window
    from rotemina.app.shell.window import OPERATE
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.robot_files import load_robot
    from rotemina.sim.trajectory import load_worn_effects

    log_qt_messages()
    folder.mkdir(parents=True, exist_ok=True)
    robot = load_robot("rotemina")
    count = 0
    with tempfile.TemporaryDirectory() as temporary_folder:
        settings = UserSettings(Path(temporary_folder) / "settings.json")
        settings.set("window.language", "en")
        window = make_window(
            MotionSession(Simulator(robot)), settings, Path(temporary_folder) / "played"
        )
        window.show()
        window.workbench.start()
        window.panels.make_all()
        run_demonstration(window, load_worn_effects(robot))
        run_computations(window)
        # The tab that shows how much the gap shrinks.
        window.panels["gap"].result.tabs.setCurrentIndex(2)
        window.workbench.emergency_stop()
        window.workbench.refreshed.emit(window.workbench.session.snapshot())
        window.workbench.release()
        window.workbench.teach_floor()
        window.workbench.refreshed.emit(window.workbench.session.snapshot())
        for theme, front_panel in (("dark", "comparison"), ("light", "trajectory")):
            window.use_theme(theme)
            for width, height in WINDOW_SIZES:
                window.resize(width, height)
                # The layout of a first start.
                window.arrangement.arrange(OPERATE)
                for name in ("plots", front_panel):
                    window.bring_up(name)
                for _ in range(_EVENT_LOOP_TURNS):
                    QApplication.processEvents()
                window.grab().save(str(folder / f"window-{width}x{height}-{theme}.png"))
                count += 1
        window.use_theme("dark")
        # Done last, because docks keep the widths that they get here.
        for width, height in WINDOW_SIZES:
            window.resize(width, height)
            for name, panel in window.panels.items():
                show_panel(window, name)
                panel.grab().save(str(folder / f"{name}-{width}x{height}-dark.png"))
                count += 1
        window.workbench.close()
        window.hide()
        count += write_german_pictures(folder, Path(temporary_folder))
    print(f"{count} pictures in {folder}")
    return 0


def run_computations(window: "MainWindow") -> None:
    """Run the panels that compute, on what was played or on the simulated machine."""
    import numpy as np
    from PySide6.QtWidgets import QApplication

    from rotemina.sim.calibration import make_calibration_motion
    from rotemina.sim.robot import AxisEffect
    from rotemina.sim.simulation import simulate

    plate, compensation = window.panels["plate"], window.panels["compensation"]
    calibration, robot = window.panels["calibration"], window.workbench.robot
    motion = make_calibration_motion(robot, "x")
    rng = np.random.default_rng(0)
    encoder = AxisEffect(axis="x", id="sensor_gain", parameters={"error": 2e-4})
    calibration.fit_record("x.csv", simulate(robot, [encoder], motion, rng))
    plate.solve()
    axis = compensation.controls.axis
    # This axis has hysteresis.
    axis.setCurrentIndex(axis.findData("zn"))
    compensation.train_in_simulation()
    while (
        window.workbench.busy
        or compensation.job.running
        or plate.solved is None
        or calibration.calibration is None
    ):
        QApplication.processEvents()


def write_german_pictures(folder: Path, temporary_folder: Path) -> int:
    """Write a picture of each layout in German after a short trajectory; return their number."""
    from PySide6.QtWidgets import QApplication

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import UserSettings
    from rotemina.app.shell.startup.offscreen_run import play_and_compare
    from rotemina.app.shell.startup.window_run import make_window
    from rotemina.app.shell.window import BUILT_IN
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.robot_files import load_robot
    from rotemina.sim.trajectory import make_example

    robot = load_robot("rotemina")
    settings = UserSettings(temporary_folder / "german.json")
    settings.set("window.language", "de")
    window = make_window(MotionSession(Simulator(robot)), settings, temporary_folder / "played")
    window.show()
    window.workbench.start()
    window.panels.make_all()
    play_and_compare(window, make_example(robot))
    while window.workbench.busy:
        QApplication.processEvents()
    width, height = WINDOW_SIZES[0]
    for layout in BUILT_IN:
        window.arrangement.arrange(layout)
        window.resize(width, height)
        for _ in range(_EVENT_LOOP_TURNS):
            QApplication.processEvents()
        layout_name = layout.plain_title.lower().replace(" ", "-")
        name = f"window-de-{layout_name}-{width}x{height}-dark.png"
        window.grab().save(str(folder / name))
    window.workbench.close()
    window.hide()
    return len(BUILT_IN)


def show_panel(window: "MainWindow", name: str) -> None:
    """Show a panel alone in its area; wait for the first picture of the microscope."""
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QApplication

    panel = window.panels[name]
    # Other docks would share the small screen with it.
    for dock_name, dock in window.docks.items():
        dock.setVisible(dock_name == name)
    window.bring_up(name)
    if name in window.docks:
        window.resizeDocks([window.docks[name]], [window.height()], Qt.Orientation.Vertical)
    # Do all drawing that is delayed until the panel is visible.
    for _ in range(_EVENT_LOOP_TURNS):
        QApplication.processEvents()
    while name == "microscope" and panel.view.frame is None:
        QApplication.processEvents()


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/screenshots")))
