"""The picture and the pointer tools in it, on a microscope that does what the test says."""

import threading

import numpy as np
import pytest
import shiboken6
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import QApplication

from rotemina.app.cameras.feed import FeedState
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.status import TipSeen, TipState
from rotemina.app.microscope.targets import Target
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.operator_requests import Requests
from rotemina.app.shell.theme import DARK
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.drivers.gate import Gate
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.microscope.contrast import Contrast
from rotemina.plugins.microscope.histogram_view import HistogramView
from rotemina.plugins.microscope.overlays import Layer
from rotemina.plugins.microscope.picture import Wanted
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool
from rotemina.plugins.microscope.pointer_tools import PointerTools

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def view(qtbot, microscope):
    made = PictureView(DARK)
    qtbot.addWidget(made)
    made.resize(260, 206)  # two screen pixels a pixel
    made.show_status(microscope.status)
    made.show()
    return made


class FeedNotice:
    """A session of which tools ask state, permits and stops."""

    def __init__(self):
        gate = Gate()
        self.robot, self.state = None, SessionState(activity=DeviceState.IDLE)
        self.stop, self.permit = gate.stop, gate.permit

    @property
    def epoch(self):
        return self.permit().epoch

    def snapshot(self):
        return self.state


@pytest.fixture
def session():
    return FeedNotice()


@pytest.fixture
def tools(microscope, view, session):
    microscope.change(tip=TipSeen(TipState.TRACKED, np.array([65.0, 51.0])))
    made = PointerTools(Requests(session), microscope, view)
    made.said = []
    made.asked = []
    made._workbench.refused.connect(made.said.append)
    made.asks.connect(made.asked.append)
    return made


def at(view, column, row):
    return QPointF(*view.viewport.to_screen(column, row)).toPoint()


def names(microscope):
    return [one[0] for one in microscope.asked]


def test_the_newest_picture_is_painted_where_it_belongs(qtbot, view, microscope):
    pixels = np.zeros((103, 130), np.uint16)
    pixels[40:60, 30:50] = 4095
    taken = Frame(pixels, 0.0, 1, 12, Region(0, 0, 130, 103))
    for layer in Layer:
        view.set_layer(layer, False)
    view.set_contrast(Contrast(auto=False))
    with qtbot.waitSignal(view.painted, check_params_cb=lambda frame: frame is taken):
        microscope.feed(frame=taken)
        view.show_status(microscope.status)
    image = view.grab().toImage()
    for column, row, level in ((31, 41, 255), (49, 59, 255), (29, 50, 0), (51, 50, 0), (40, 39, 0)):
        place = at(view, column, row)
        assert QColor(image.pixel(place.x(), place.y())).red() == level
    microscope.feed(state=FeedState.FROZEN, reason="the same again")
    view.show_status(microscope.status)
    veiled = view.grab().toImage()
    corner = QPoint(250, 200)
    assert QColor(image.pixel(corner)).red() == 0
    assert QColor(veiled.pixel(corner)).red() > 0  # greyed, so that all see it


def test_pictures_that_come_faster_than_they_are_drawn_are_passed_over(qtbot, view, microscope):
    painted = []
    view.painted.connect(painted.append)
    came = [
        Frame(np.full((103, 130), level, np.uint16), 0.0, level, 12, Region(0, 0, 130, 103))
        for level in (100, 1000, 2000, 4095)
    ]
    view.set_contrast(Contrast(auto=False))
    for frame in came:
        microscope.feed(frame=frame)
        view.show_status(microscope.status)
    qtbot.waitUntil(lambda: bool(painted) and painted[-1] is came[-1])
    assert not any(frame is came[1] or frame is came[2] for frame in painted)
    place = at(view, 65, 30)
    assert QColor(view.grab().toImage().pixel(place)).red() == 255


@pytest.fixture
def held_work(monkeypatch):
    """Work on pictures that goes on when it is let; on whatever thread it is not the window's."""
    begun, let = threading.Event(), threading.Event()
    work = Wanted.worked_out

    def held(wanted):
        if threading.current_thread() is not threading.main_thread():
            begun.set()
            assert let.wait(10.0)
        return work(wanted)

    monkeypatch.setattr(Wanted, "worked_out", held)
    yield begun, let
    let.set()


def test_a_camera_that_is_closed_meanwhile_leaves_no_picture(qtbot, view, microscope, held_work):
    begun, let = held_work
    qtbot.waitUntil(lambda: not view._work.busy or begun.is_set())
    let.clear()
    frame = Frame(np.full((103, 130), 4095, np.uint16), 0.0, 1, 12, Region(0, 0, 130, 103))
    microscope.feed(frame=frame)
    view.show_status(microscope.status)
    microscope.feed(frame=None)
    view.show_status(microscope.status)
    let.set()
    qtbot.waitUntil(lambda: not view._work.busy)
    dark = Frame(np.zeros((103, 130), np.uint16), 0.0, 2, 12, Region(0, 0, 130, 103))
    let.clear()
    microscope.feed(frame=dark)
    with qtbot.waitSignal(view.painted, check_params_cb=lambda one: one is dark):
        view.show_status(microscope.status)  # which is under way when it is painted
        view.repaint()


def test_a_view_may_go_while_its_picture_is_worked_out(qtbot, microscope, held_work):
    begun, let = held_work
    gone = PictureView(DARK)
    gone.show_status(microscope.status)
    assert begun.wait(10.0)
    thread = gone._work._thread
    shiboken6.delete(gone)
    let.set()
    thread.shutdown(wait=True)  # what it tells reaches nobody, and breaks nothing
    QApplication.processEvents()


def test_a_zoom_does_not_wait_for_the_picture(qtbot, view, microscope):
    for layer in Layer:
        view.set_layer(layer, False)
    view.set_contrast(Contrast(auto=False))
    pixels = np.zeros((103, 130), np.uint16)
    pixels[45:55, 60:70] = 4095
    frame = Frame(pixels, 0.0, 1, 12, Region(0, 0, 130, 103))
    microscope.feed(frame=frame)
    with qtbot.waitSignal(view.painted, check_params_cb=lambda one: one is frame):
        view.show_status(microscope.status)
    view.show_one_to_one()
    image = view.grab().toImage()
    for column, row, level in ((61, 46, 255), (68, 53, 255), (58, 50, 0), (72, 50, 0)):
        place = at(view, column, row)
        assert QColor(image.pixel(place)).red() == level


def test_wheel_pan_and_keys(qtbot, view):
    about = QPointF(60.0, 40.0)
    held = view.viewport.to_picture(60.0, 40.0)
    wheel = QWheelEvent(
        about,
        view.mapToGlobal(about),
        QPoint(),
        QPoint(0, 240),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    view.wheelEvent(wheel)
    assert view.viewport.zoom == pytest.approx(2.0 * 1.2**2)
    assert view.viewport.to_screen(*held) == pytest.approx((60.0, 40.0))
    qtbot.mousePress(view, Qt.MouseButton.MiddleButton, pos=QPoint(100, 100))
    qtbot.mouseMove(view, QPoint(110, 95))
    qtbot.mouseRelease(view, Qt.MouseButton.MiddleButton, pos=QPoint(110, 95))
    assert view.viewport.to_screen(*held) == pytest.approx((70.0, 35.0))
    view.set_tool(PointerTool.MARK)  # the left button has other work: the space bar makes it pan
    before = view.viewport.at
    with qtbot.assertNotEmitted(view.pressed):
        qtbot.keyPress(view, Qt.Key.Key_Space)
        qtbot.mousePress(view, LEFT, pos=QPoint(100, 100))
        qtbot.mouseMove(view, QPoint(90, 100))
        qtbot.mouseRelease(view, LEFT, pos=QPoint(90, 100))
        qtbot.keyRelease(view, Qt.Key.Key_Space)
    assert view.viewport.at != before
    qtbot.keyClick(view, Qt.Key.Key_1)
    assert view.viewport.zoom == pytest.approx(1.0)
    qtbot.keyClick(view, Qt.Key.Key_F)
    assert view.viewport.zoom == pytest.approx(2.0)


def test_nothing_moves_unless_the_mode_is_on(qtbot, view, microscope, tools):
    for tool in (
        PointerTool.PAN,
        PointerTool.MARK,
        PointerTool.TIP,
        PointerTool.CELL,
        PointerTool.MEASURE,
    ):
        tools.choose(tool)
        qtbot.mouseClick(view, LEFT, pos=at(view, 80, 40))
    assert names(microscope) == ["mark_target", "track", "outline_cell", "forget_measure"]
    tools.choose(PointerTool.MEASURE)
    microscope.asked.clear()
    qtbot.mousePress(view, LEFT, pos=at(view, 20, 20))
    qtbot.mouseMove(view, at(view, 60, 50))
    assert view.line is not None
    qtbot.mouseRelease(view, LEFT, pos=at(view, 60, 50))
    (name, begin, end), *_ = microscope.asked
    assert name == "measure"
    assert np.subtract(end, begin) == pytest.approx([40.0, 30.0])
    assert view.line is None


def test_a_click_plans_shows_and_goes_and_a_drag_follows(qtbot, view, microscope, tools):
    tools.choose(PointerTool.MOVE)
    qtbot.mousePress(view, LEFT, pos=at(view, 80, 40))
    assert microscope.status.planned is not None  # the ghost, before anything has moved
    assert names(microscope) == ["plan"]
    qtbot.mouseMove(view, at(view, 90, 45))
    qtbot.mouseRelease(view, LEFT, pos=at(view, 90, 45))
    assert names(microscope) == ["plan", "plan", "go", "cancel_plan"]
    assert microscope.asked[1][1] == pytest.approx((90.0, 45.0), abs=0.5)
    assert microscope.asked[2] == ("go", False)


def test_a_large_move_waits_for_a_yes(qtbot, view, microscope, tools):
    microscope.confirm = True
    tools.choose(PointerTool.MOVE)
    qtbot.mouseClick(view, LEFT, pos=at(view, 80, 40))
    assert "go" not in names(microscope)
    assert tools.asked[-1] == "Move the tip 20 µm with the micro stage, ± 0.5 px?"
    tools.answer(False)
    assert (names(microscope)[-1], tools.asked[-1]) == ("cancel_plan", "")
    tools.answer(True)  # of a question that was answered already
    assert "go" not in names(microscope)
    qtbot.mouseClick(view, LEFT, pos=at(view, 80, 40))
    tools.answer(True)
    assert ("go", True) in microscope.asked


@pytest.mark.parametrize("way", ["Esc", "stop", "hidden", "frozen", "mode off"])
def test_what_ends_the_mode_forgets_the_move(
    qtbot, view, microscope, tools, session, press_escape, way
):
    microscope.confirm = True
    tools.choose(PointerTool.MOVE)
    qtbot.mouseClick(view, LEFT, pos=at(view, 80, 40))
    if way == "Esc":
        press_escape(view)
    elif way == "stop":
        session.stop()
    elif way == "hidden":
        view.hide()
    elif way == "frozen":
        microscope.feed(state=FeedState.FROZEN)
    else:
        tools.choose(PointerTool.PAN)
    tools.refresh(microscope.status)
    assert view.tool is PointerTool.PAN
    assert microscope.status.planned is None
    assert tools.asked[-1] == ""
    tools.answer(True)
    assert "go" not in names(microscope)


def test_what_speaks_against_a_move_is_said_and_nothing_is_planned(
    qtbot, view, microscope, tools, session
):
    tools.choose(PointerTool.MOVE)
    microscope.change(tip=TipSeen(TipState.LOST))
    qtbot.mouseClick(view, LEFT, pos=at(view, 80, 40))
    assert names(microscope) == []
    assert "no move: the tip is not tracked" in tools.said[-1]
    tools.choose(PointerTool.MARK)
    against = tools.against(microscope.status, session.state)
    assert "tip is not tracked" in against[PointerTool.MOVE]
    assert against[PointerTool.MARK] is None
    tools.choose(PointerTool.MOVE)
    microscope.change(tip=TipSeen(TipState.TRACKED))
    microscope.refuses = MicroscopeError("outside the calibrated field")
    qtbot.mouseClick(view, LEFT, pos=at(view, 80, 40))
    assert tools.said[-1] == "outside the calibrated field"
    assert "go" not in names(microscope)


def test_targets_are_visited_in_order(view, microscope, tools):
    microscope.change(targets=(Target(10.0, 20.0), Target(30.0, 40.0)))
    tools.visit_next()
    assert microscope.asked[0] == ("plan", (10.0, 20.0), None)
    assert names(microscope)[1:] == ["visit_next", "cancel_plan"]
    microscope.confirm = True
    microscope.asked.clear()
    tools.visit_next()
    assert names(microscope) == ["plan"]
    tools.answer(True)
    assert ("visit_next", True) in microscope.asked


def test_the_handles_of_the_histogram(qtbot):
    view = HistogramView(DARK)
    qtbot.addWidget(view)
    view.resize(200, 70)
    view.show_counts(np.arange(256), (0.25, 0.75))
    moves = []
    view.moved.connect(lambda low, high: moves.append((low, high)))
    qtbot.mousePress(view, LEFT, pos=QPoint(50, 30))
    qtbot.mouseMove(view, QPoint(80, 30))
    qtbot.mouseMove(view, QPoint(190, 30))  # not past the other
    qtbot.mouseRelease(view, LEFT, pos=QPoint(190, 30))
    qtbot.mouseMove(view, QPoint(20, 30))
    assert moves[0] == pytest.approx((0.4, 0.75))
    assert moves[-1] == pytest.approx((0.75 - 1 / 256, 0.75))
    view.grab()
