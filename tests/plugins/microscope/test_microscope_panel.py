"""The panel in the window, over the simulated microscope."""

import json

import numpy as np
import pytest
import tifffile
from PySide6.QtCore import QPointF, Qt

from rotemina.app.cameras.feed import FeedState
from rotemina.app.microscope.click_corrections import Visit
from rotemina.app.microscope.status import Activity, ScaleSource, TipState
from rotemina.plugins.microscope.picture_view import PointerTool
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position

PANELS = ("plots",)

LONG_MS = 60_000
LEFT = Qt.MouseButton.LeftButton


def shown(window):
    panel = window.panels["microscope"]
    window.bring_up("microscope")
    return panel


def open_camera(qtbot, window):
    panel, microscope = shown(window), window.workbench.microscope
    # The simulated microscope is opened by itself, where nobody has chosen a camera.
    qtbot.waitUntil(lambda: panel.view.frame is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: microscope.status.feed.state is FeedState.LIVE, timeout=LONG_MS)
    return panel, microscope


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def test_a_picture_is_shown_kept_and_filmed_and_a_refused_setting_said(qtbot, window, tmp_path):
    panel, _ = open_camera(qtbot, window)
    assert panel.view.frame.pixels.shape == (1030, 1300)
    qtbot.waitUntil(panel.settings.apply.isEnabled, timeout=LONG_MS)
    panel.settings.exposure.setText("99999")
    panel.settings.apply.click()  # it is below what can be seen without scrolling
    qtbot.waitUntil(lambda: "exposure_s = 99.999" in panel.settings.problem.text(), timeout=LONG_MS)

    panel.bar.tools.setCurrentText("Save")
    qtbot.mouseClick(panel.saving.snapshot, LEFT)
    qtbot.waitUntil(lambda: any("Saved" in one for one in notices(window)), timeout=LONG_MS)
    data = window.workbench.operation.data
    (tiff,) = (data / "pictures").glob("*.tif")
    assert (data / "pictures" / f"{tiff.stem}.png").exists()
    with tifffile.TiffFile(tiff) as file:
        facts = json.loads(file.pages[0].description)
    assert facts["command"]["x"] == pytest.approx(window.workbench.session.snapshot().command["x"])

    qtbot.mouseClick(panel.saving.record, LEFT)
    status = lambda: panel.saving.filming.status  # noqa: E731 (it is asked for twice)
    qtbot.waitUntil(lambda: status() is not None and status().pictures >= 3, timeout=LONG_MS)
    window.workbench.close()  # a film that is under way is ended with the window
    (film,) = (data / "videos").glob("*.tif")
    with tifffile.TiffFile(film) as file:
        times = [json.loads(page.description)["host_time_s"] for page in file.pages]
    assert len(times) >= 3
    assert (np.diff(times) > 0.0).all()


@pytest.mark.slow
def test_calibrate_click_and_the_true_tip_is_there(qtbot, window):
    panel, microscope = open_camera(qtbot, window)
    session = window.workbench.session
    panel.bar.tools.setCurrentText("Calibrate")
    qtbot.waitUntil(panel.calibration.micro.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(panel.calibration.micro, LEFT)
    qtbot.waitUntil(lambda: microscope.status.activity is Activity.CALIBRATION, timeout=LONG_MS)
    qtbot.waitUntil(lambda: microscope.status.activity is Activity.NONE, timeout=LONG_MS)
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
    view._view(view.viewport.zoomed(8.0, view.viewport.to_screen(*goal)))  # to click finely
    place = QPointF(*view.viewport.to_screen(*goal)).toPoint()
    wanted = view.viewport.to_picture(place.x(), place.y())
    qtbot.mouseClick(view, LEFT, pos=place)
    qtbot.waitUntil(
        lambda: (
            microscope.status.visiting is not None
            and microscope.status.visiting.visit is not Visit.UNDER_WAY
        ),
        timeout=LONG_MS,
    )
    assert microscope.status.visiting.visit is Visit.ARRIVED, microscope.status.visiting.reason
    chain = Chain.of(session.robot)
    true = tip_position(chain, chain.joints_of(np.array(session.driver.true_positions)))
    seen = microscope.camera.camera.scene.optics.pixel_of(true)
    assert np.linalg.norm(seen - wanted) < 0.5
    window.workbench.stop()
    qtbot.waitUntil(lambda: view.tool is PointerTool.PAN, timeout=LONG_MS)
