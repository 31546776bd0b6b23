"""The microscope on the screen: how late a picture is painted, and how many a second can be.

Limits: from the host's stamp of a picture to the end of its painting at most two frames at the
99th percentile; pictures of 16 bits and full size at 30 a second or more on one core.
"""

import os
import time
from dataclasses import replace
from math import inf

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import cv2
import numpy as np
import pytest

FRAMES = 300
RATE_HZ = 30.0
MOST_FRAMES = 2.0
LEAST_HZ = RATE_HZ
SIZES = ((620, 480), (1300, 1030))
QUICK = {"FRAMES": 5, "MOST_FRAMES": inf, "LEAST_HZ": 0.0}


def test_from_the_camera_to_the_screen(tmp_path):
    from PySide6.QtCore import QEventLoop, QTimer
    from PySide6.QtWidgets import QApplication

    from rotemina.app.cameras.feed import FeedState
    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import Settings
    from rotemina.app.shell.application import make_application
    from rotemina.app.shell.window_run import make_window
    from rotemina.drivers.simulator.driver import Simulator
    from rotemina.sim.robot.file import load_robot

    make_application()
    session = MotionSession(Simulator(load_robot("rotemina")))
    window = make_window(session, Settings(tmp_path / "settings.json"), tmp_path / "played")
    window.resize(1920, 1080)
    window.show()
    window.workbench.start()
    microscope, panel = window.workbench.microscope, window.panels["microscope"]
    window.bring_up("microscope")
    late_s: dict[int, float] = {}
    loop = QEventLoop()

    def painted(frame) -> None:
        late_s.setdefault(frame.number, microscope.clock() - frame.host_time_s)
        if len(late_s) >= FRAMES:
            loop.quit()

    def until(done) -> None:
        end = time.monotonic() + 60.0
        while not done() and time.monotonic() < end:
            QApplication.processEvents()
            time.sleep(0.01)
        assert done()

    until(lambda: not window.panels.waiting)  # it is used, not built
    until(lambda: microscope.status.cameras)
    microscope.camera.open("simulated:microscope")
    until(lambda: microscope.status.feed.state is FeedState.LIVE and panel.view.frame is not None)
    panel.view.painted.connect(painted)
    QTimer.singleShot(60_000, loop.quit)
    wall, cpu = time.perf_counter(), time.process_time()
    loop.exec()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    numbers = sorted(late_s)
    whole = numbers[-1] - numbers[0] + 1
    median, worst = (1e3 * np.percentile(list(late_s.values()), one) for one in (50, 99))
    print(
        f"\ncamera to screen, 1920x1080: median {median:.1f} ms, 99 % {worst:.1f} "
        f"(limit {MOST_FRAMES * 1e3 / RATE_HZ:.0f}); {len(late_s) / wall:.1f} pictures/s, "
        f"{100 * len(late_s) / whole:.1f} % of those taken; {100 * cpu / wall:.0f} % of a core"
    )
    window.workbench.close()
    window.hide()
    assert worst <= MOST_FRAMES * 1e3 / RATE_HZ


@pytest.mark.parametrize("size", SIZES)
def test_pictures_of_16_bits(size):
    from PySide6.QtCore import QEventLoop
    from PySide6.QtWidgets import QApplication

    from rotemina.app.cameras.feed import FeedState, FeedView
    from rotemina.app.microscope.status import MicroscopeStatus
    from rotemina.app.shell.application import make_application
    from rotemina.app.shell.theme import DARK
    from rotemina.drivers.cameras.frame import Frame, Region
    from rotemina.plugins.microscope.contrast import Contrast, Table
    from rotemina.plugins.microscope.picture_view import PictureView

    make_application()
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    rng = np.random.default_rng(0)
    pictures = [rng.integers(0, 65536, (1030, 1300)).astype(np.uint16) for _ in range(4)]
    view = PictureView(DARK)
    view.resize(*size)
    view.show()
    QApplication.processEvents()  # a widget that no screen has shown yet paints nothing
    painted = []
    view.painted.connect(painted.append)
    rates = {}
    for table in Table:
        view.set_contrast(Contrast(table=table, gamma=0.8))
        spent = []
        for number in range(60):
            frame = Frame(pictures[number % 4], 0.0, number, 16, Region(0, 0, 1300, 1030))
            status = replace(
                MicroscopeStatus(), feed=FeedView(FeedState.LIVE, frame=frame, age_s=0.0)
            )
            before = time.process_time()
            view.show_status(status)
            while not painted or painted[-1] is not frame:
                QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
            spent.append(time.process_time() - before)
        rates[table.value] = 1.0 / np.median(spent[5:])
    view.hide()
    view.deleteLater()
    cv2.setNumThreads(threads)
    shown = "; ".join(f"{name} {rate:.0f}" for name, rate in rates.items())
    print(f"\n1300x1030 px in {size[0]}x{size[1]}, pictures/s (limit {LEAST_HZ:g}): {shown}")
    assert len({frame.number for frame in painted}) == 60
    assert min(rates.values()) >= LEAST_HZ
