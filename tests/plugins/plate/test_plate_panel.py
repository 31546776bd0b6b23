"""The panel of the holding plate: solving, sliders, modes, files, and refusals."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QWheelEvent
from PySide6.QtWidgets import QApplication

from rotemina.plugins.plate.background_solution import BackgroundPlateSolver
from rotemina.plugins.plate.coloured_quantities import QUANTITIES
from rotemina.plugins.plate.solution import solve_plate
from rotemina.plugins.plate.surface_drawing import OrbitView
from rotemina.plugins.plate.surface_picture import make_mode_picture, make_static_picture
from rotemina.plugins.plate.words import (
    EMPTY_TEXT,
    MESH_CHOICES,
    describe_plate,
    describe_pose,
    make_mode_titles,
)
from rotemina.sim.robot_files import load_robot

LONG_MS = 60_000
ROBOT = load_robot("rotemina")
COARSE_MESH = MESH_CHOICES[0][1]
HIGHEST_POSE = np.array([65e-6, 1.16355e-3, 1.16355e-3])


@pytest.fixture(scope="module")
def answer():
    stages = []
    answer = solve_plate(ROBOT, 32, stages.append)
    assert stages == ["meshing", "solving", "modes", "range of motion"]
    return answer


def test_the_colour_scale_is_the_same_for_all_poses(answer):
    for quantity in QUANTITIES:
        top = make_static_picture(answer, HIGHEST_POSE, quantity, 1.0)
        middle = make_static_picture(answer, 0.5 * HIGHEST_POSE, quantity, 1.0)
        assert (top.low, top.high) == (middle.low, middle.high)
        values = top.surface.values
        assert np.nanmax(values) <= 1.0 + 1e-9
        assert np.nanmin(values) >= -1e-9
    assert make_static_picture(answer, HIGHEST_POSE, QUANTITIES[3], 1.0).high == pytest.approx(
        65.0, rel=0.2
    )


def test_the_deformation_is_drawn_with_the_stated_magnification(answer):
    picture = make_static_picture(answer, HIGHEST_POSE, QUANTITIES[0], 0.5)
    height = picture.surface.points[2]
    assert height[-1] == pytest.approx(picture.magnification * 65e-6)
    flat = make_static_picture(answer, HIGHEST_POSE, QUANTITIES[0], 0.0)
    assert np.abs(flat.surface.points[2]).max() == 0.0
    # The tip moves as in the kinematics: thx to +y, thy to -x.
    assert picture.surface.pin_axis[0, 1] < 0.0 < picture.surface.pin_axis[1, 1]


def test_modes_are_drawn_in_both_directions(answer):
    up, down = (make_mode_picture(answer, 2, phase, 1.0) for phase in (np.pi / 2, -np.pi / 2))
    assert up.surface.points[2] == pytest.approx(-down.surface.points[2])
    assert "Mode 3" in up.title


def test_plate_pose_and_modes_are_described(answer):
    assert "agree with the shipped robot" in describe_plate(answer)
    assert "safety" in describe_pose(answer, HIGHEST_POSE)
    assert describe_pose(answer, np.zeros(3)).startswith("Reaction 0.0 N")
    assert "hub along the pin" in make_mode_titles(answer)[2]


def test_a_stopped_solution_gives_no_answer(qtbot):
    from PySide6.QtCore import QObject

    owner = QObject()
    solver = BackgroundPlateSolver(owner)
    answers = []
    solver.finished.connect(answers.append)
    solver.failed.connect(answers.append)
    solver.start(ROBOT, COARSE_MESH)
    solver.stop()
    assert not solver.running
    solver.close()
    QApplication.processEvents()
    assert answers == []
    invalid_robot = replace(ROBOT, plate=replace(ROBOT.plate, hub_radius=0.1))
    with qtbot.waitSignal(solver.failed, timeout=LONG_MS) as failed:
        solver.start(invalid_robot, COARSE_MESH)
    assert "plate.hub_radius = 0.1" in failed.args[0]
    assert not solver.running
    solver.close()


def test_the_panel_solves_shows_and_saves_a_plate(qtbot, window, tmp_path):
    window.docks["plate"].raise_()
    panel = window.panels["plate"]
    assert panel.canvas.hint == EMPTY_TEXT
    assert not panel.png.isEnabled()
    assert "no plate is solved" in panel.png.toolTip()
    panel.mesh.setCurrentIndex(0)
    qtbot.mouseClick(panel.start, Qt.MouseButton.LeftButton)
    assert panel.stop.isEnabled()
    qtbot.waitUntil(lambda: panel.solved is not None, timeout=LONG_MS)
    assert panel.start.isEnabled()
    assert panel.controls.pose == pytest.approx(HIGHEST_POSE)
    highest_text = panel.pose_text.text()

    panel.controls.sliders[0].setValue(0)
    assert panel.controls.pose[0] == 0.0
    assert panel.pose_text.text() != highest_text
    assert not panel._frames.isActive()
    panel.controls.what.setCurrentIndex(3)
    assert panel._frames.isActive()
    assert not panel.controls.sliders[0].isEnabled()
    first_picture = panel.canvas.picture
    qtbot.waitUntil(lambda: panel.canvas.picture is not first_picture, timeout=LONG_MS)
    panel.controls.what.setCurrentIndex(0)
    assert not panel._frames.isActive()

    orbit_and_zoom(qtbot, panel.canvas)
    picture, fields = tmp_path / "plate.png", tmp_path / "plate.vtu"
    panel.save_png(picture)
    qtbot.waitUntil(picture.exists, timeout=LONG_MS)
    assert QImage(str(picture)).width() >= panel.canvas.width()
    panel.save_vtu(fields)
    qtbot.waitUntil(fields.exists, timeout=LONG_MS)
    # An impossible plate is refused, and the shown picture stays.
    panel.solver.start(replace(ROBOT, plate=replace(ROBOT.plate, thickness=0.1)), COARSE_MESH)
    qtbot.waitUntil(lambda: not panel.solver.running, timeout=LONG_MS)
    notices = [notice.text for notice in window.notices.notices()]
    assert any("plate.thickness = 0.1: must be" in text for text in notices)
    assert panel.canvas.picture is not None


def orbit_and_zoom(qtbot, canvas):
    """Rotate with mouse and keys, zoom with the wheel, and reset the view."""
    start_view = canvas.view
    qtbot.mousePress(canvas, Qt.MouseButton.LeftButton, pos=QPoint(50, 50))
    qtbot.mouseMove(canvas, QPoint(90, 70))
    qtbot.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=QPoint(90, 70))
    assert canvas.view.azimuth != start_view.azimuth
    assert canvas.view.elevation > start_view.elevation
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
    assert canvas.view == OrbitView()
