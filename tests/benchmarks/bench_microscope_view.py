"""The microscope on the screen: latency of a painted picture, and highest picture rate.

Limits: from the host time of a picture to the end of its painting at most two frame periods at the
99th percentile; at least 30 pictures of 16 bits and full size per second on one core.
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
MAX_LATENCY_FRAMES = 2.0
MIN_RATE_HZ = RATE_HZ
SIZES = ((620, 480), (1300, 1030))
QUICK = {"FRAMES": 5, "MAX_LATENCY_FRAMES": inf, "MIN_RATE_HZ": 0.0}


def test_from_the_camera_to_the_screen(tmp_path):
    from PySide6.QtCore import QEventLoop, QTimer
    from PySide6.QtWidgets import QApplication

    from rotemina.app.cameras import FeedState
    from rotemina.app.motion.session import MotionSession
    from rotemina.app.settings import UserSettings
    from rotemina.app.shell.startup.application import make_application
    from rotemina.app.shell.startup.window_run import make_window
    from rotemina.drivers.simulator import Simulator
    from rotemina.sim.robot_files import load_robot

    make_application()
    session = MotionSession(Simulator(load_robot("rotemina")))
    window = make_window(session, UserSettings(tmp_path / "settings.json"), tmp_path / "played")
    window.resize(1920, 1080)
    window.show()
    window.workbench.start()
    microscope, panel = window.workbench.microscope, window.panels["microscope"]
    window.bring_up("microscope")
    latencies_s: dict[int, float] = {}
    loop = QEventLoop()

    def record_latency(frame) -> None:
        latencies_s.setdefault(frame.number, microscope.clock() - frame.host_time_s)
        if len(latencies_s) >= FRAMES:
            loop.quit()

    def wait_until(condition) -> None:
        end_s = time.monotonic() + 60.0
        while not condition() and time.monotonic() < end_s:
            QApplication.processEvents()
            time.sleep(0.01)
        assert condition()

    # The construction of the window does not count.
    wait_until(lambda: not window.panels.pending_names)
    wait_until(lambda: microscope.status.cameras)
    microscope.camera.open("simulated:microscope")
    wait_until(
        lambda: microscope.status.feed.state is FeedState.LIVE and panel.view.frame is not None
    )
    panel.view.painted.connect(record_latency)
    QTimer.singleShot(60_000, loop.quit)
    wall, cpu = time.perf_counter(), time.process_time()
    loop.exec()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    numbers = sorted(latencies_s)
    picture_count = numbers[-1] - numbers[0] + 1
    median, worst = (
        1e3 * np.percentile(list(latencies_s.values()), percent) for percent in (50, 99)
    )
    print(
        f"\ncamera to screen, 1920x1080: median {median:.1f} ms, 99 % {worst:.1f} "
        f"(limit {MAX_LATENCY_FRAMES * 1e3 / RATE_HZ:.0f}); {len(latencies_s) / wall:.1f} "
        "pictures/s, "
        f"{100 * len(latencies_s) / picture_count:.1f} % of the pictures taken; "
        f"{100 * cpu / wall:.0f} % of a core"
    )
    window.workbench.close()
    window.hide()
    assert worst <= MAX_LATENCY_FRAMES * 1e3 / RATE_HZ


@pytest.mark.parametrize("size", SIZES)
def test_pictures_of_16_bits(size):
    from PySide6.QtCore import QEventLoop
    from PySide6.QtWidgets import QApplication

    from rotemina.app.cameras import FeedState, FeedView
    from rotemina.app.microscope import MicroscopeStatus
    from rotemina.app.shell.startup.application import make_application
    from rotemina.app.widgets.style.theme import DARK
    from rotemina.drivers.cameras import CameraFrame, SensorRegion
    from rotemina.plugins.microscope.contrast import ColourTable, ContrastSettings
    from rotemina.plugins.microscope.picture_view import PictureView

    make_application()
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    rng = np.random.default_rng(0)
    pictures = [rng.integers(0, 65536, (1030, 1300)).astype(np.uint16) for _ in range(4)]
    view = PictureView(DARK)
    view.resize(*size)
    view.show()
    # A widget paints nothing before it was shown on a screen.
    QApplication.processEvents()
    painted = []
    view.painted.connect(painted.append)
    rates = {}
    for table in ColourTable:
        view.set_contrast(ContrastSettings(table=table, gamma=0.8))
        times_s = []
        for number in range(60):
            frame = CameraFrame(
                pictures[number % 4], 0.0, number, 16, SensorRegion(0, 0, 1300, 1030)
            )
            status = replace(
                MicroscopeStatus(), feed=FeedView(FeedState.LIVE, frame=frame, age_s=0.0)
            )
            before = time.process_time()
            view.show_status(status)
            while not painted or painted[-1] is not frame:
                QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
            times_s.append(time.process_time() - before)
        rates[table.value] = 1.0 / np.median(times_s[5:])
    view.hide()
    view.deleteLater()
    cv2.setNumThreads(threads)
    results = "; ".join(f"{name} {rate:.0f}" for name, rate in rates.items())
    print(f"\n1300x1030 px in {size[0]}x{size[1]}, pictures/s (limit {MIN_RATE_HZ:g}): {results}")
    assert len({frame.number for frame in painted}) == 60
    assert min(rates.values()) >= MIN_RATE_HZ
