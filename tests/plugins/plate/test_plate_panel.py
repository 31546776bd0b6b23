"""The holding plate's panel: solving, sliders, modes, files, and refusals."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QWheelEvent
from PySide6.QtWidgets import QApplication

from rotemina.plugins.plate.background_solution import Solving
from rotemina.plugins.plate.coloured_quantities import QUANTITIES
from rotemina.plugins.plate.solution import solved
from rotemina.plugins.plate.surface_drawing import View
from rotemina.plugins.plate.surface_picture import mode_picture, static_picture
from rotemina.plugins.plate.words import EMPTY, MESHES, mode_titles, plate_text, pose_lines
from rotemina.sim.robot.file import load_robot

LONG_MS = 60_000
ROBOT = load_robot("rotemina")
COARSE = MESHES[0][1]
HIGHEST = np.array([65e-6, 1.16355e-3, 1.16355e-3])


@pytest.fixture(scope="module")
def answer():
    stages = []
    answer = solved(ROBOT, 32, stages.append)
    assert stages == ["meshing", "solving", "modes", "range of motion"]
    return answer


def test_colours_have_one_scale_over_the_whole_range(answer):
    for quantity in QUANTITIES:
        top = static_picture(answer, HIGHEST, quantity, 1.0)
        middle = static_picture(answer, 0.5 * HIGHEST, quantity, 1.0)
        assert (top.low, top.high) == (middle.low, middle.high)
        values = top.surface.values
        assert np.nanmax(values) <= 1.0 + 1e-9
        assert np.nanmin(values) >= -1e-9
    assert static_picture(answer, HIGHEST, QUANTITIES[3], 1.0).high == pytest.approx(65.0, rel=0.2)


def test_deformation_is_drawn_as_much_larger_as_is_said(answer):
    picture = static_picture(answer, HIGHEST, QUANTITIES[0], 0.5)
    height = picture.surface.points[2]
    assert height[-1] == pytest.approx(picture.magnified * 65e-6)
    flat = static_picture(answer, HIGHEST, QUANTITIES[0], 0.0)
    assert np.abs(flat.surface.points[2]).max() == 0.0
    # The tip goes where the kinematics say: thx to +y, thy to -x.
    assert picture.surface.rod[0, 1] < 0.0 < picture.surface.rod[1, 1]


def test_modes_swing(answer):
    up, down = (mode_picture(answer, 2, phase, 1.0) for phase in (np.pi / 2, -np.pi / 2))
    assert up.surface.points[2] == pytest.approx(-down.surface.points[2])
    assert "Mode 3" in up.title


def test_words(answer):
    assert "agree with the shipped robot" in plate_text(answer)
    assert "safety" in pose_lines(answer, HIGHEST)
    assert pose_lines(answer, np.zeros(3)).startswith("Reaction 0.0 N")
    assert "hub along the pin" in mode_titles(answer)[2]


def test_a_stopped_solution_gives_no_answer(qtbot):
    from PySide6.QtCore import QObject

    owner = QObject()
    solving = Solving(owner)
    answers = []
    solving.finished.connect(answers.append)
    solving.failed.connect(answers.append)
    solving.start(ROBOT, COARSE)
    solving.stop()
    assert not solving.running
    solving.close()
    QApplication.processEvents()
    assert answers == []
    bad = replace(ROBOT, plate=replace(ROBOT.plate, hub_radius=0.1))
    with qtbot.waitSignal(solving.failed, timeout=LONG_MS) as failed:
        solving.start(bad, COARSE)
    assert "plate.hub_radius = 0.1" in failed.args[0]
    assert not solving.running
    solving.close()


def test_panel_solves_shows_and_saves(qtbot, window, tmp_path):
    window.docks["plate"].raise_()
    panel = window.panels["plate"]
    assert panel.canvas.hint == EMPTY
    assert not panel.png.isEnabled()
    assert "no plate is solved" in panel.png.toolTip()
    panel.mesh.setCurrentIndex(0)
    qtbot.mouseClick(panel.start, Qt.MouseButton.LeftButton)
    assert panel.stop.isEnabled()
    qtbot.waitUntil(lambda: panel.solved is not None, timeout=LONG_MS)
    assert panel.start.isEnabled()
    assert panel.controls.pose == pytest.approx(HIGHEST)
    high = panel.pose_text.text()

    panel.controls.sliders[0].setValue(0)
    assert panel.controls.pose[0] == 0.0
    assert panel.pose_text.text() != high
    assert not panel._frames.isActive()
    panel.controls.what.setCurrentIndex(3)
    assert panel._frames.isActive()
    assert not panel.controls.sliders[0].isEnabled()
    before = panel.canvas.picture
    qtbot.waitUntil(lambda: panel.canvas.picture is not before, timeout=LONG_MS)
    panel.controls.what.setCurrentIndex(0)
    assert not panel._frames.isActive()

    look(qtbot, panel.canvas)
    picture, fields = tmp_path / "plate.png", tmp_path / "plate.vtu"
    panel.save_png(picture)
    qtbot.waitUntil(picture.exists, timeout=LONG_MS)
    assert QImage(str(picture)).width() >= panel.canvas.width()
    panel.save_vtu(fields)
    qtbot.waitUntil(fields.exists, timeout=LONG_MS)
    # A plate that cannot be is told, and what is shown stays.
    panel.solving.start(replace(ROBOT, plate=replace(ROBOT.plate, thickness=0.1)), COARSE)
    qtbot.waitUntil(lambda: not panel.solving.running, timeout=LONG_MS)
    said = [notice.text for notice in window.notices.notices()]
    assert any("plate.thickness = 0.1: must be" in text for text in said)
    assert panel.canvas.picture is not None


def look(qtbot, canvas):
    """Turn by mouse and keys, zoom by wheel, and go back."""
    first = canvas.view
    qtbot.mousePress(canvas, Qt.MouseButton.LeftButton, pos=QPoint(50, 50))
    qtbot.mouseMove(canvas, QPoint(90, 70))
    qtbot.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=QPoint(90, 70))
    assert canvas.view.azimuth != first.azimuth
    assert canvas.view.elevation > first.elevation
    wheel = QWheelEvent(
        QPointF(50, 50),
        QPointF(50, 50),
        QPoint(),
        QPoint(0, 120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(canvas, wheel)
    assert canvas.view.zoom > 1.0
    qtbot.keyClick(canvas, Qt.Key.Key_Left)
    qtbot.mouseDClick(canvas, Qt.MouseButton.LeftButton, pos=QPoint(50, 50))
    assert canvas.view == View()
