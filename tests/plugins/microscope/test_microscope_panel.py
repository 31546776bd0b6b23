"""The microscope panel in the window, with the simulated microscope."""

import json

import numpy as np
import pytest
import tifffile
from PySide6.QtCore import QPointF, Qt

from rotemina.app.cameras import FeedState
from rotemina.app.microscope import (
    MicroscopeActivity,
    ScaleSource,
    TipState,
    VisitState,
)
from rotemina.plugins.microscope.picture_view import PointerTool
from rotemina.sim.kinematics import KinematicChain, compute_tip_position

PANELS = ("plots",)

LONG_MS = 60_000
LEFT = Qt.MouseButton.LeftButton


def raise_panel(window):
    panel = window.panels["microscope"]
    window.bring_up("microscope")
    return panel


def open_camera(qtbot, window):
    panel, microscope = raise_panel(window), window.workbench.microscope
    # The simulated microscope opens automatically if no camera was chosen.
    qtbot.waitUntil(lambda: panel.view.frame is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: microscope.status.feed.state is FeedState.LIVE, timeout=LONG_MS)
    return panel, microscope


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def test_pictures_are_shown_saved_and_filmed_and_a_bad_setting_is_refused(qtbot, window, tmp_path):
    panel, _ = open_camera(qtbot, window)
    assert panel.view.frame.pixels.shape == (1030, 1300)
    qtbot.waitUntil(panel.settings.apply.isEnabled, timeout=LONG_MS)
    panel.settings.exposure.setText("99999")
    # The button is below the visible part, so a mouse click would miss it.
    panel.settings.apply.click()
    qtbot.waitUntil(lambda: "exposure_s = 99.999" in panel.settings.problem.text(), timeout=LONG_MS)

    panel.bar.tools.setCurrentText("Save")
    qtbot.mouseClick(panel.saving.snapshot, LEFT)
    qtbot.waitUntil(lambda: any("Saved" in text for text in notices(window)), timeout=LONG_MS)
    data = window.workbench.operation.data
    (tiff,) = (data / "pictures").glob("*.tif")
    assert (data / "pictures" / f"{tiff.stem}.png").exists()
    with tifffile.TiffFile(tiff) as file:
        metadata = json.loads(file.pages[0].description)
    assert metadata["command"]["x"] == pytest.approx(
        window.workbench.session.snapshot().command["x"]
    )

    qtbot.mouseClick(panel.saving.record, LEFT)

    def has_three_pictures():
        status = panel.saving.video_capture.status
        return status is not None and status.pictures >= 3

    qtbot.waitUntil(has_three_pictures, timeout=LONG_MS)
    window.workbench.close()  # closing the window ends a running video
    (video,) = (data / "videos").glob("*.tif")
    with tifffile.TiffFile(video) as file:
        times = [json.loads(page.description)["host_time_s"] for page in file.pages]
    assert len(times) >= 3
    assert (np.diff(times) > 0.0).all()


@pytest.mark.slow
def test_after_a_calibration_a_click_moves_the_true_tip_there(qtbot, window):
    panel, microscope = open_camera(qtbot, window)
    session = window.workbench.session
    panel.bar.tools.setCurrentText("Calibrate")
    qtbot.waitUntil(panel.calibration.micro.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(panel.calibration.micro, LEFT)
    qtbot.waitUntil(
        lambda: microscope.status.activity is MicroscopeActivity.CALIBRATION, timeout=LONG_MS
    )
    qtbot.waitUntil(lambda: microscope.status.activity is MicroscopeActivity.NONE, timeout=LONG_MS)
    qtbot.waitUntil(lambda: microscope.status.calibration is not None, timeout=LONG_MS)
    assert microscope.status.scale_source is ScaleSource.CALIBRATION
    panel.bar.tools.setCurrentText("Vision")
    qtbot.waitUntil(panel.tip.track.isVisible, timeout=LONG_MS)
    qtbot.waitUntil(lambda: microscope.status.tip.state is TipState.TRACKED, timeout=LONG_MS)

    move = panel.bar.buttons[PointerTool.MOVE]
    qtbot.waitUntil(move.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(move, LEFT)
    assert panel.view.tool is PointerTool.MOVE
    goal = microscope.status.tip.pixel + np.array([60.0, -40.0])
    view = panel.view
    # Zoom in to click with subpixel accuracy.
    view._set_viewport(view.viewport.zoom_about(8.0, view.viewport.to_screen(*goal)))
    click_point = QPointF(*view.viewport.to_screen(*goal)).toPoint()
    clicked_pixel = view.viewport.to_picture(click_point.x(), click_point.y())
    qtbot.mouseClick(view, LEFT, pos=click_point)
    qtbot.waitUntil(
        lambda: (
            microscope.status.visit_status is not None
            and microscope.status.visit_status.state is not VisitState.UNDER_WAY
        ),
        timeout=LONG_MS,
    )
    assert microscope.status.visit_status.state is VisitState.ARRIVED, (
        microscope.status.visit_status.reason
    )
    chain = KinematicChain.of(session.robot)
    true_tip = compute_tip_position(
        chain, chain.select_joints(np.array(session.driver.true_positions))
    )
    tip_pixel = microscope.camera.camera.scene.optics.pixel_of(true_tip)
    assert np.linalg.norm(tip_pixel - clicked_pixel) < 0.5
    window.workbench.stop()
    qtbot.waitUntil(lambda: view.tool is PointerTool.PAN, timeout=LONG_MS)
