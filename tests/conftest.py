"""What every test may use: an offscreen Qt and the folder of shared material."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

# The same examples on every machine, however slow it is at the moment.
settings.register_profile("repeatable", derandomize=True, deadline=None, print_blob=True)
settings.load_profile("repeatable")

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

BESIDE_REPOSITORY = Path(__file__).parents[2] / "shared"


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """Folder of shared material: ``ROTEMINA_SHARED``, else ``../shared``."""
    folder = Path(os.environ.get("ROTEMINA_SHARED", BESIDE_REPOSITORY))
    if folder.is_dir():
        return folder
    absent = f"no shared material in {folder} (set ROTEMINA_SHARED)"
    if os.environ.get("CI") == "true":
        pytest.fail(absent)
    pytest.skip(absent)


@pytest.fixture
def settings(tmp_path):
    """Preferences of nobody, kept in the test's own folder."""
    from rotemina.app.settings import Settings

    return Settings(tmp_path / "preferences" / "settings.json")


@pytest.fixture
def make_robot_window(qtbot, settings, tmp_path):
    """Make windows on the simulator of any robot; all are closed, and no thread stays."""
    import gc
    import threading

    from PySide6.QtCore import QCoreApplication, QEvent

    from rotemina.app.motion.session import MotionSession
    from rotemina.app.shell.window_run import make_window
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.robot.file import load_robot

    windows = []
    gc.disable()  # as the program does: the session's thread must not free what is Qt's

    def make(robot="rotemina"):
        session = MotionSession(Simulator(load_robot(robot), {"settle_s": 0.02}))
        window = make_window(session, settings, tmp_path / "played")
        windows.append(window)
        window.show()
        window.workbench.start()
        qtbot.waitUntil(lambda: session.snapshot().locked is None, timeout=20_000)
        return window

    yield make
    for window in windows:
        window.workbench.close()
        window.hide()
        window.deleteLater()
    windows.clear()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    gc.enable()
    assert not [thread for thread in threading.enumerate() if thread.name == "motion session"]


@pytest.fixture
def window(make_robot_window):
    """The operator's window on the simulated RoTeMiNa, connected and idle."""
    return make_robot_window()
