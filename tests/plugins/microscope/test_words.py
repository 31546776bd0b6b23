"""Texts and overlays of the panel, made from the status of the microscope."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.cameras import FeedState
from rotemina.app.microscope import (
    MarkedTarget,
    MeasuredLine,
    ScaleSource,
    TipState,
    TipStatus,
    VisitState,
)
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.status import CellStatus
from rotemina.app.motion.state import SessionState
from rotemina.drivers.cameras import (
    CameraFrame,
    CameraSettings,
    CameraTrigger,
    PixelType,
    SensorRegion,
)
from rotemina.drivers.contract import CameraSettingError, DeviceState
from rotemina.plugins.microscope.camera_form import CameraTexts, to_camera_settings, to_camera_texts
from rotemina.plugins.microscope.cursor_readout import describe_cursor, format_measurement
from rotemina.plugins.microscope.feed_notice import find_click_objection, make_feed_notice
from rotemina.plugins.microscope.overlays import (
    OverlayCross,
    OverlayLayer,
    OverlayLine,
    OverlayRing,
    OverlayStyle,
    make_shapes,
)
from rotemina.plugins.microscope.painting import make_scale_bar
from rotemina.plugins.microscope.words import describe_stage, describe_target, describe_tip
from rotemina.sim.vision import CellOutline, MembraneAhead, TipDepth

ALL_LAYERS = frozenset(OverlayLayer)


@pytest.fixture
def status(microscope):
    return microscope.status


def change_feed(status, **changes):
    return replace(status, feed=replace(status.feed, **changes))


@pytest.mark.parametrize(
    ("state", "title", "is_veiled"),
    [
        (FeedState.LIVE, "", False),
        (FeedState.OPENING, "Opening …", False),
        (FeedState.STALLED, "STALLED", True),
        (FeedState.FROZEN, "FROZEN", True),
        (FeedState.BLACK, "BLACK", True),
        (FeedState.LOST, "LOST", True),
        (FeedState.CLOSED, "No camera", True),
    ],
)
def test_every_camera_state_has_a_notice_and_old_pictures_are_veiled(
    status, state, title, is_veiled
):
    notice = make_feed_notice(change_feed(status, state=state, reason="why").feed)
    assert (notice.title, notice.veiled) == (title, is_veiled)
    assert notice.badge
    if is_veiled and state is not FeedState.CLOSED:
        assert notice.reason == "why"


def test_the_badge_shows_rate_age_and_lost_pictures(status):
    first = change_feed(status, frame=None, age_s=None)
    assert make_feed_notice(first.feed).title == "Waiting for the first picture"
    frame = replace(status.feed.frame, lost=3)
    for changes, badge in (
        ({"frame": frame}, "live · 30 Hz · 12 ms old · 3 lost"),
        ({"rate_hz": 0.0}, "live · 12 ms old"),  # the first picture has no rate yet
        ({"state": FeedState.STALLED, "age_s": 3.21}, "stalled · 3.2 s old"),
    ):
        assert make_feed_notice(change_feed(status, **changes).feed).badge == badge


def test_clicks_need_a_live_calibrated_picture_and_a_tracked_tip(status):
    ready = SessionState(activity=DeviceState.IDLE)
    tracked = replace(status, tip=TipStatus(TipState.TRACKED))
    assert find_click_objection(tracked, ready) is None
    unlive_states = [state for state in FeedState if state is not FeedState.LIVE]
    for unready, objection in (
        (status, "tip is not tracked"),
        (replace(tracked, calibration=None), "not calibrated"),
        (replace(tracked, calibration=None, calibration_problem="a bad file"), "a bad file"),
        *((change_feed(tracked, state=state), "not live") for state in unlive_states),
        (change_feed(tracked, frame=None), "not live"),
    ):
        assert objection in find_click_objection(unready, ready)
    assert "locked: lost" in find_click_objection(tracked, replace(ready, lock_reason="lost"))
    moving = replace(ready, activity=DeviceState.MOVING)
    assert "not at rest" in find_click_objection(tracked, moving)


@pytest.mark.parametrize(
    ("pixel_m", "zoom", "length", "text"),
    [
        (0.335e-6, 0.47, 100e-6, "100 µm"),
        (10e-6, 0.1, 0.01, "10 mm"),
        (1e-9, 10.0, 10e-9, "10 nm"),
    ],
)
def test_the_scale_bar_has_a_round_length_that_fits(pixel_m, zoom, length, text):
    bar = make_scale_bar(pixel_m, ScaleSource.ROBOT_FILE, zoom, 620.0)
    assert (bar.text, bar.remark) == (text, "from the robot file")
    assert bar.length_px == pytest.approx(length / pixel_m * zoom)
    assert 0.3 * 620.0 / 2.5 <= bar.length_px <= 0.3 * 620.0


def test_without_a_scale_the_bar_counts_pixels():
    bar = make_scale_bar(None, ScaleSource.NONE, 0.5, 620.0)
    assert (bar.text, bar.remark, bar.length_px) == ("200 px", "not calibrated", 100.0)
    assert make_scale_bar(None, ScaleSource.NONE, 40.0, 20.0).text == "1 px"


def test_the_cursor_text_shows_pixel_value_and_position(status):
    value = int(status.feed.frame.pixels[51, 75])
    # The cursor is 10 px right of the tip, which was calibrated at x = 27.5 mm.
    text = describe_cursor(status, (75.2, 50.8))
    assert text.startswith(f"75, 51 px   {value} of 4095")
    assert "x 27503.42, y 27499.93 µm" in text
    assert describe_cursor(status, (130.0, 4.0)) == describe_cursor(status, None) == ""
    uncalibrated = replace(status, calibration=None)
    assert "3.4, 6.7 µm from the corner" in describe_cursor(uncalibrated, (10.0, 20.0))
    assert describe_cursor(replace(uncalibrated, pixel_m=None), (0.0, 0.0)).count("µm") == 0
    colour_frame = CameraFrame(np.full((4, 4, 3), 7, np.uint8), 0.0, 0, 8, SensorRegion(0, 0, 4, 4))
    assert "RGB 7 7 7" in describe_cursor(change_feed(status, frame=colour_frame), (1.0, 1.0))


def with_cell_and_tip(status):
    ellipse = np.array([60.0, 50.0, 20.0, 10.0, np.pi / 2])
    outline = CellOutline(ellipse, np.eye(5), np.zeros((3, 2)), 0.1)
    membrane = MembraneAhead(12.0, 0.5, np.radians(10.0), 0.02)
    tip = TipStatus(TipState.TRACKED, np.array([80.0, 50.0]), 0.4, 0.0, TipDepth(2e-6, 3e-7, False))
    cell = CellStatus(outline, membrane, 4.02e-6, 1.7e-7)
    return replace(status, cell=cell, tip=tip)


def test_overlays_are_drawn_at_their_measured_positions(status):
    full_status = replace(
        with_cell_and_tip(status),
        targets=(MarkedTarget(5.0, 6.0), MarkedTarget(7.0, 8.0, VisitState.FAILED, "lost")),
        planned_move=PlannedMove(
            np.array([90.0, 70.0]), np.array([90.0, 71.0]), 1.5, "micro", {}, 1e-5, False
        ),
        tip_path=np.array([[70.0, 50.0], [80.0, 50.0]]),
        nano_limits=np.array([[60.0, 40.0], [90.0, 40.0], [75.0, 70.0]]),
        measured_line=MeasuredLine(np.zeros(2), np.array([3.0, 4.0]), 5.0, 1.7e-6, 0.9, 0.5),
    )
    shapes = make_shapes(full_status, ALL_LAYERS)
    crosses = {shape.style: tuple(shape.at) for shape in shapes if isinstance(shape, OverlayCross)}
    assert crosses == {
        OverlayStyle.TARGET: (5.0, 6.0),
        OverlayStyle.MISSED: (7.0, 8.0),
        OverlayStyle.TIP: (80.0, 50.0),
        OverlayStyle.GHOST: (90.0, 71.0),
    }
    rings = {shape.style: shape.radius for shape in shapes if isinstance(shape, OverlayRing)}
    assert rings == {OverlayStyle.TIP: 0.8, OverlayStyle.GHOST: 3.0}  # two standard deviations
    lines = {
        shape.style: shape
        for shape in shapes
        if isinstance(shape, OverlayLine) and not shape.dashed
    }
    cell_points = lines[OverlayStyle.CELL].points
    # The long axis is vertical.
    assert cell_points.min(axis=0) == pytest.approx([50.0, 30.0], abs=1e-9)
    assert cell_points.max(axis=0) == pytest.approx([70.0, 70.0], abs=1e-9)
    assert "4.02 ± 0.17 µm, 10°" in [
        shape.label for shape in shapes if isinstance(shape, OverlayLine)
    ]
    ahead_line = next(shape for shape in shapes if shape.style is OverlayStyle.AHEAD)
    assert ahead_line.points[1] == pytest.approx([68.0, 50.0])  # it points away from the body
    assert lines[OverlayStyle.NANO].closed
    # The planned tip is drawn without any layer.
    assert {shape.style for shape in make_shapes(full_status, frozenset())} == {OverlayStyle.GHOST}


def test_texts_show_uncertainties(status):
    tip_text = describe_tip(with_cell_and_tip(status).tip)
    assert "80.00, 50.00 ± 0.40 px" in tip_text
    assert "±2.00 ± 0.30 µm from focus" in tip_text  # the sign of the defocus is unknown
    assert describe_tip(TipStatus(TipState.LOST, reason="covered")) == "lost: covered"
    stage_text = describe_stage("micro", status.calibration.micro)
    for part in ("335.00 × 335.00 ± 0.00 nm/px", "residual 0.07 px, 2026-03-04 05:06"):
        assert part in stage_text
    assert describe_stage("nano", None) == "nano: not calibrated"
    failed_target = MarkedTarget(7.0, 8.0, VisitState.FAILED, "no")
    assert describe_target(2, failed_target) == "2   7, 8 px   failed: no"
    line = MeasuredLine(np.zeros(2), np.array([3.0, 4.0]), 5.0, None, np.radians(53.0), None)
    assert format_measurement(line) == "5.0 px, 53.0°"


def test_typed_camera_settings_are_read_and_written():
    texts = CameraTexts("12.5", "2", "", "10 20 640 480", "mono8", "software", False)
    region, trigger = SensorRegion(10, 20, 640, 480), CameraTrigger.SOFTWARE
    settings = CameraSettings(0.0125, 2.0, None, region, PixelType.MONO8, trigger, False)
    assert to_camera_settings(texts) == settings
    assert to_camera_settings(to_camera_texts(settings)) == settings
    assert to_camera_settings(CameraTexts(region="Whole ")) == CameraSettings()


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        ({"exposure": "fast"}, "exposure: 'fast' is not a number; enter one in ms"),
        ({"gain": "nan"}, "gain: 'nan' is not a number"),
        ({"region": "1 2 3"}, "region: '1 2 3' is not valid; enter whole, or four integers"),
        ({"region": "1 2 3 -4"}, "first column, first row, width and height"),
    ],
)
def test_invalid_camera_settings_are_refused(texts, message):
    with pytest.raises(CameraSettingError, match=message):
        to_camera_settings(CameraTexts(**texts))
