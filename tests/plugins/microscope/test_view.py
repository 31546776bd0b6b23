"""The picture view and its pointer tools, with a fake microscope."""

import threading

import numpy as np
import pytest
import shiboken6
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import QApplication

from rotemina.app.cameras import FeedState
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope import MarkedTarget, TipState, TipStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.style.theme import DARK
from rotemina.app.workbench import OperatorRequests
from rotemina.drivers.cameras import CameraFrame, SensorRegion
from rotemina.drivers.contract import DeviceState, Gate
from rotemina.plugins.microscope.contrast import ContrastSettings
from rotemina.plugins.microscope.histogram_view import HistogramView
from rotemina.plugins.microscope.overlays import OverlayLayer
from rotemina.plugins.microscope.picture import PictureRequest
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool
from rotemina.plugins.microscope.pointer_tools import PointerController

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def view(qtbot, microscope):
    picture_view = PictureView(DARK)
    qtbot.addWidget(picture_view)
    picture_view.resize(260, 206)  # two screen pixels per picture pixel
    picture_view.show_status(microscope.status)
    picture_view.show()
    return picture_view


class FakeSession:
    """A session that provides state, permits and stops to the tools."""

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
    return FakeSession()


@pytest.fixture
def tools(microscope, view, session):
    microscope.change(tip=TipStatus(TipState.TRACKED, np.array([65.0, 51.0])))
    controller = PointerController(OperatorRequests(session), microscope, view)
    controller.refusals = []
    controller.questions = []
    controller._workbench.refused.connect(controller.refusals.append)
    controller.confirmation_requested.connect(controller.questions.append)
    return controller


def make_frame(level=0, number=1, bright=None):
    """Return a picture of one grey level, with a white part if its rows and columns are given."""
    pixels = np.full((103, 130), level, np.uint16)
    if bright is not None:
        pixels[bright] = 4095
    return CameraFrame(pixels, 0.0, number, 12, SensorRegion(0, 0, 130, 103))


def show_frame(qtbot, view, microscope, frame):
    """Show a picture without overlays and with fixed contrast, and return the painted view."""
    for layer in OverlayLayer:
        view.set_layer(layer, False)
    view.set_contrast(ContrastSettings(auto=False))
    microscope.feed(frame=frame)
    with qtbot.waitSignal(view.painted, check_params_cb=lambda painted: painted is frame):
        view.show_status(microscope.status)


def read_level(view, image, column, row):
    """Return the red level of a painted view at a pixel of the picture."""
    return QColor(image.pixel(to_point(view, column, row))).red()


def drag(qtbot, view, button, begin, end):
    qtbot.mousePress(view, button, pos=begin)
    qtbot.mouseMove(view, end)
    qtbot.mouseRelease(view, button, pos=end)


def to_point(view, column, row):
    return QPointF(*view.viewport.to_screen(column, row)).toPoint()


def list_call_names(microscope):
    return [call[0] for call in microscope.calls]


def test_a_picture_is_painted_at_its_place_zoomed_at_once_and_veiled_if_frozen(
    qtbot, view, microscope
):
    show_frame(qtbot, view, microscope, make_frame(bright=np.s_[45:55, 60:70]))
    levels = {(61, 46): 255, (68, 53): 255, (58, 50): 0, (72, 50): 0, (65, 43): 0}
    image = view.grab().toImage()
    assert {at: read_level(view, image, *at) for at in levels} == levels
    microscope.feed(state=FeedState.FROZEN, reason="the same again")
    view.show_status(microscope.status)
    corner = QPoint(250, 200)
    assert QColor(image.pixel(corner)).red() == 0
    assert QColor(view.grab().toImage().pixel(corner)).red() > 0  # a frozen picture is greyed
    microscope.feed(state=FeedState.LIVE)
    view.show_status(microscope.status)
    view.show_one_to_one()  # does not wait for another picture
    image = view.grab().toImage()
    assert {at: read_level(view, image, *at) for at in levels} == levels


def test_pictures_that_arrive_faster_than_they_are_drawn_are_skipped(qtbot, view, microscope):
    painted = []
    view.painted.connect(painted.append)
    frames = [make_frame(level, level) for level in (100, 1000, 2000, 4095)]
    view.set_contrast(ContrastSettings(auto=False))
    for frame in frames:
        microscope.feed(frame=frame)
        view.show_status(microscope.status)
    qtbot.waitUntil(lambda: bool(painted) and painted[-1] is frames[-1])
    assert not any(frame is frames[1] or frame is frames[2] for frame in painted)
    assert read_level(view, view.grab().toImage(), 65, 30) == 255


@pytest.fixture
def blocked_rendering(monkeypatch):
    """Block rendering outside the main thread until an event is set; yield its two events."""
    started, may_continue = threading.Event(), threading.Event()
    render = PictureRequest.render

    def render_when_allowed(request):
        if threading.current_thread() is not threading.main_thread():
            started.set()
            assert may_continue.wait(10.0)
        return render(request)

    monkeypatch.setattr(PictureRequest, "render", render_when_allowed)
    yield started, may_continue
    may_continue.set()


def test_a_camera_that_closes_during_rendering_leaves_no_picture(
    qtbot, view, microscope, blocked_rendering
):
    started, may_continue = blocked_rendering
    qtbot.waitUntil(lambda: not view._renderer.busy or started.is_set())
    may_continue.clear()
    for frame in (make_frame(4095), None):
        microscope.feed(frame=frame)
        view.show_status(microscope.status)
    may_continue.set()
    qtbot.waitUntil(lambda: not view._renderer.busy)
    dark = make_frame(0, 2)
    may_continue.clear()
    microscope.feed(frame=dark)
    with qtbot.waitSignal(view.painted, check_params_cb=lambda painted: painted is dark):
        view.show_status(microscope.status)  # rendering is still running when the view is painted
        view.repaint()


def test_a_view_may_be_deleted_while_its_picture_is_rendered(qtbot, microscope, blocked_rendering):
    started, may_continue = blocked_rendering
    deleted_view = PictureView(DARK)
    deleted_view.show_status(microscope.status)
    assert started.wait(10.0)
    thread = deleted_view._renderer._thread
    shiboken6.delete(deleted_view)
    may_continue.set()
    thread.shutdown(wait=True)  # its result must not reach the deleted view
    QApplication.processEvents()


def test_the_wheel_zooms_a_drag_pans_and_keys_reset(qtbot, view):
    cursor = QPointF(60.0, 40.0)
    anchored_pixel = view.viewport.to_picture(60.0, 40.0)
    wheel = QWheelEvent(
        cursor,
        view.mapToGlobal(cursor),
        QPoint(),
        QPoint(0, 240),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    view.wheelEvent(wheel)
    assert view.viewport.zoom == pytest.approx(2.0 * 1.2**2)
    assert view.viewport.to_screen(*anchored_pixel) == pytest.approx((60.0, 40.0))
    drag(qtbot, view, Qt.MouseButton.MiddleButton, QPoint(100, 100), QPoint(110, 95))
    assert view.viewport.to_screen(*anchored_pixel) == pytest.approx((70.0, 35.0))
    view.set_tool(PointerTool.MARK)  # with this tool, only the space bar makes the left button pan
    view_centre = view.viewport.at
    with qtbot.assertNotEmitted(view.pressed):
        qtbot.keyPress(view, Qt.Key.Key_Space)
        drag(qtbot, view, LEFT, QPoint(100, 100), QPoint(90, 100))
        qtbot.keyRelease(view, Qt.Key.Key_Space)
    assert view.viewport.at != view_centre
    qtbot.keyClick(view, Qt.Key.Key_1)
    assert view.viewport.zoom == pytest.approx(1.0)
    qtbot.keyClick(view, Qt.Key.Key_F)
    assert view.viewport.zoom == pytest.approx(2.0)


def test_clicks_move_nothing_unless_the_move_tool_is_chosen(qtbot, view, microscope, tools):
    for tool in (
        PointerTool.PAN,
        PointerTool.MARK,
        PointerTool.TIP,
        PointerTool.CELL,
        PointerTool.MEASURE,
    ):
        tools.choose_tool(tool)
        qtbot.mouseClick(view, LEFT, pos=to_point(view, 80, 40))
    names = ["mark_target", "track", "outline_cell", "clear_measurement"]
    assert list_call_names(microscope) == names
    tools.choose_tool(PointerTool.MEASURE)
    microscope.calls.clear()
    qtbot.mousePress(view, LEFT, pos=to_point(view, 20, 20))
    qtbot.mouseMove(view, to_point(view, 60, 50))
    assert view.measure_line is not None
    qtbot.mouseRelease(view, LEFT, pos=to_point(view, 60, 50))
    (name, begin, end), *_ = microscope.calls
    assert name == "measure"
    assert np.subtract(end, begin) == pytest.approx([40.0, 30.0])
    assert view.measure_line is None


def test_a_press_plans_a_move_a_drag_updates_it_and_a_release_starts_it(
    qtbot, view, microscope, tools
):
    tools.choose_tool(PointerTool.MOVE)
    qtbot.mousePress(view, LEFT, pos=to_point(view, 80, 40))
    # The planned tip is shown before anything moves.
    assert microscope.status.planned_move is not None
    assert list_call_names(microscope) == ["plan"]
    qtbot.mouseMove(view, to_point(view, 90, 45))
    qtbot.mouseRelease(view, LEFT, pos=to_point(view, 90, 45))
    assert list_call_names(microscope) == ["plan", "plan", "go", "cancel_plan"]
    assert microscope.calls[1][1] == pytest.approx((90.0, 45.0), abs=0.5)
    assert microscope.calls[2] == ("go", False)


def test_a_large_move_needs_a_confirmation(qtbot, view, microscope, tools):
    microscope.confirm = True
    tools.choose_tool(PointerTool.MOVE)
    qtbot.mouseClick(view, LEFT, pos=to_point(view, 80, 40))
    assert "go" not in list_call_names(microscope)
    assert tools.questions[-1] == "Move the tip 20 µm with the micro stage, ± 0.5 px?"
    tools.answer(False)
    assert (list_call_names(microscope)[-1], tools.questions[-1]) == ("cancel_plan", "")
    tools.answer(True)  # an answer to a question that was answered already
    assert "go" not in list_call_names(microscope)
    qtbot.mouseClick(view, LEFT, pos=to_point(view, 80, 40))
    tools.answer(True)
    assert ("go", True) in microscope.calls


@pytest.mark.parametrize("interruption", ["Esc", "stop", "hidden", "frozen", "mode off"])
def test_leaving_the_move_tool_cancels_the_planned_move(
    qtbot, view, microscope, tools, session, press_escape, interruption
):
    microscope.confirm = True
    tools.choose_tool(PointerTool.MOVE)
    qtbot.mouseClick(view, LEFT, pos=to_point(view, 80, 40))
    if interruption == "Esc":
        press_escape(view)
    elif interruption == "stop":
        session.stop()
    elif interruption == "hidden":
        view.hide()
    elif interruption == "frozen":
        microscope.feed(state=FeedState.FROZEN)
    else:
        tools.choose_tool(PointerTool.PAN)
    tools.refresh(microscope.status)
    assert view.tool is PointerTool.PAN
    assert microscope.status.planned_move is None
    assert tools.questions[-1] == ""
    tools.answer(True)
    assert "go" not in list_call_names(microscope)


def test_an_objection_to_a_move_is_reported_and_nothing_is_planned(
    qtbot, view, microscope, tools, session
):
    tools.choose_tool(PointerTool.MOVE)
    microscope.change(tip=TipStatus(TipState.LOST))
    qtbot.mouseClick(view, LEFT, pos=to_point(view, 80, 40))
    assert list_call_names(microscope) == []
    assert "no move: the tip is not tracked" in tools.refusals[-1]
    tools.choose_tool(PointerTool.MARK)
    objections = tools.find_objections(microscope.status, session.state)
    assert "tip is not tracked" in objections[PointerTool.MOVE]
    assert objections[PointerTool.MARK] is None
    tools.choose_tool(PointerTool.MOVE)
    microscope.change(tip=TipStatus(TipState.TRACKED))
    microscope.refusal = MicroscopeError("outside the calibrated field")
    qtbot.mouseClick(view, LEFT, pos=to_point(view, 80, 40))
    assert tools.refusals[-1] == "outside the calibrated field"
    assert "go" not in list_call_names(microscope)


def test_targets_are_visited_in_order(view, microscope, tools):
    microscope.change(targets=(MarkedTarget(10.0, 20.0), MarkedTarget(30.0, 40.0)))
    tools.visit_next()
    assert microscope.calls[0] == ("plan", (10.0, 20.0), None)
    assert list_call_names(microscope)[1:] == ["visit_next", "cancel_plan"]
    microscope.confirm = True
    microscope.calls.clear()
    tools.visit_next()
    assert list_call_names(microscope) == ["plan"]
    tools.answer(True)
    assert ("visit_next", True) in microscope.calls


def test_the_handles_of_the_histogram_do_not_cross(qtbot):
    view = HistogramView(DARK)
    qtbot.addWidget(view)
    view.resize(200, 70)
    view.show_counts(np.arange(256), (0.25, 0.75))
    moves = []
    view.moved.connect(lambda low, high: moves.append((low, high)))
    qtbot.mousePress(view, LEFT, pos=QPoint(50, 30))
    qtbot.mouseMove(view, QPoint(80, 30))
    qtbot.mouseMove(view, QPoint(190, 30))  # must stop before the other handle
    qtbot.mouseRelease(view, LEFT, pos=QPoint(190, 30))
    qtbot.mouseMove(view, QPoint(20, 30))
    assert moves[0] == pytest.approx((0.4, 0.75))
    assert moves[-1] == pytest.approx((0.75 - 1 / 256, 0.75))
    view.grab()
