"""What the panel says and what it draws, from a microscope's moment."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.cameras.feed import FeedState
from rotemina.app.microscope.click_corrections import Visit
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.status import (
    CellSeen,
    Measured,
    ScaleSource,
    TipSeen,
    TipState,
)
from rotemina.app.microscope.targets import Target
from rotemina.app.motion.state import SessionState
from rotemina.drivers.cameras.errors import CameraSettingError
from rotemina.drivers.cameras.frame import Frame, Region
from rotemina.drivers.cameras.settings import CameraSettings, PixelType, Trigger
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.microscope.camera_form import CameraTexts, settings_of, texts_of
from rotemina.plugins.microscope.cursor_readout import cursor_text, measured_text
from rotemina.plugins.microscope.feed_notice import against_clicking, feed_notice
from rotemina.plugins.microscope.overlays import Cross, Layer, Look, Ring, Stroke, shapes
from rotemina.plugins.microscope.scale_bar import scale_bar
from rotemina.plugins.microscope.words import stage_text, target_text, tip_text
from rotemina.sim.vision.cell import CellOutline, MembraneAhead
from rotemina.sim.vision.tip_fit import Depth

ALL = frozenset(Layer)


@pytest.fixture
def status(microscope):
    return microscope.status


def feed(status, **changes):
    return replace(status, feed=replace(status.feed, **changes))


@pytest.mark.parametrize(
    ("state", "title", "veiled"),
    [
        (FeedState.LIVE, "", False),
        (FeedState.OPENING, "Opening …", False),
        (FeedState.WAITING, "", False),
        (FeedState.STALLED, "STALLED", True),
        (FeedState.FROZEN, "FROZEN", True),
        (FeedState.BLACK, "BLACK", True),
        (FeedState.LOST, "LOST", True),
        (FeedState.CLOSED, "No camera", True),
    ],
)
def test_every_state_of_the_camera_is_said_and_an_old_picture_is_veiled(
    status, state, title, veiled
):
    said = feed_notice(feed(status, state=state, reason="why").feed)
    assert (said.title, said.veiled) == (title, veiled)
    assert said.badge
    if veiled:
        assert said.reason == ("why" if state is not FeedState.CLOSED else said.reason)
    none = feed_notice(feed(status, state=FeedState.LIVE, frame=None, age_s=None).feed)
    assert none.title == "Waiting for the first picture"


def test_the_age_of_a_live_picture_is_told(status):
    assert feed_notice(status.feed).badge == "live · 30 Hz · 12 ms old"
    assert feed_notice(feed(status, rate_hz=0.0).feed).badge == "live · 12 ms old"  # the first one
    gaps = replace(status.feed.frame, lost=3)
    assert feed_notice(feed(status, frame=gaps).feed).badge == "live · 30 Hz · 12 ms old · 3 lost"
    old = feed(status, state=FeedState.STALLED, age_s=3.21)
    assert feed_notice(old.feed).badge == "stalled · 3.2 s old"


def test_clicks_move_only_by_a_live_calibrated_picture_with_a_tracked_tip(status):
    ready = SessionState(activity=DeviceState.IDLE)
    tracked = replace(status, tip=TipSeen(TipState.TRACKED))
    assert against_clicking(tracked, ready) is None
    for wrong, said in (
        (status, "tip is not tracked"),
        (replace(tracked, calibration=None), "not calibrated"),
        (replace(tracked, calibration=None, calibration_problem="a bad file"), "a bad file"),
        *((feed(tracked, state=one), "not live") for one in FeedState if one != FeedState.LIVE),
        (feed(tracked, frame=None), "not live"),
    ):
        assert said in against_clicking(wrong, ready)
    assert "locked: lost" in against_clicking(tracked, replace(ready, locked="lost"))
    moving = replace(ready, activity=DeviceState.MOVING)
    assert "not at rest" in against_clicking(tracked, moving)


@pytest.mark.parametrize(
    ("pixel_m", "zoom", "length", "text"),
    [
        (0.335e-6, 0.47, 100e-6, "100 µm"),
        (0.335e-6, 40.0, 1e-6, "1 µm"),
        (10e-6, 0.1, 0.01, "10 mm"),
        (1e-9, 10.0, 10e-9, "10 nm"),
        (5e-6, 0.9, 1e-3, "1 mm"),
    ],
)
def test_the_bar_has_a_round_length_that_fits(pixel_m, zoom, length, text):
    bar = scale_bar(pixel_m, ScaleSource.CALIBRATION, zoom, 620.0)
    assert bar.text == text
    assert bar.length == pytest.approx(length / pixel_m * zoom)
    assert 0.3 * 620.0 / 2.5 <= bar.length <= 0.3 * 620.0
    assert scale_bar(pixel_m, ScaleSource.ROBOT_FILE, zoom, 620.0).remark == "from the robot file"


def test_without_a_scale_the_bar_counts_pixels():
    bar = scale_bar(None, ScaleSource.NONE, 0.5, 620.0)
    assert (bar.text, bar.remark, bar.length) == ("200 px", "not calibrated", 100.0)
    assert scale_bar(None, ScaleSource.NONE, 40.0, 20.0).text == "1 px"


def test_the_cursor_reads_pixel_value_and_place(status):
    value = int(status.feed.frame.pixels[51, 75])
    # 10 px to the right of where the tip was at x = 27.5 mm.
    said = cursor_text(status, (75.2, 50.8))
    assert said.startswith(f"75, 51 px   {value} of 4095")
    assert "x 27503.42, y 27499.93 µm" in said
    assert cursor_text(status, (130.0, 4.0)) == cursor_text(status, None) == ""
    plain = replace(status, calibration=None)
    assert "3.4, 6.7 µm from the corner" in cursor_text(plain, (10.0, 20.0))
    assert cursor_text(replace(plain, pixel_m=None), (0.0, 0.0)).count("µm") == 0
    red = Frame(np.full((4, 4, 3), 7, np.uint8), 0.0, 0, 8, Region(0, 0, 4, 4))
    assert "RGB 7 7 7" in cursor_text(feed(status, frame=red), (1.0, 1.0))


def outlined(status):
    figures = np.array([60.0, 50.0, 20.0, 10.0, np.pi / 2])
    outline = CellOutline(figures, np.eye(5), np.zeros((3, 2)), 0.1)
    ahead = MembraneAhead(12.0, 0.5, np.radians(10.0), 0.02)
    tip = TipSeen(TipState.TRACKED, np.array([80.0, 50.0]), 0.4, 0.0, Depth(2e-6, 3e-7, False))
    cell = CellSeen(outline, ahead, 4.02e-6, 1.7e-7)
    return replace(status, cell=cell, tip=tip)


def test_what_is_drawn_is_where_it_was_seen(status):
    seen = replace(
        outlined(status),
        targets=(Target(5.0, 6.0), Target(7.0, 8.0, Visit.FAILED, "lost")),
        planned=PlannedMove(
            np.array([90.0, 70.0]), np.array([90.0, 71.0]), 1.5, "micro", {}, 1e-5, False
        ),
        path=np.array([[70.0, 50.0], [80.0, 50.0]]),
        nano_limits=np.array([[60.0, 40.0], [90.0, 40.0], [75.0, 70.0]]),
        measured=Measured(np.zeros(2), np.array([3.0, 4.0]), 5.0, 1.7e-6, 0.9, 0.5),
    )
    found = shapes(seen, ALL)
    crosses = {one.look: tuple(one.at) for one in found if isinstance(one, Cross)}
    assert crosses == {
        Look.TARGET: (5.0, 6.0),
        Look.MISSED: (7.0, 8.0),
        Look.TIP: (80.0, 50.0),
        Look.GHOST: (90.0, 71.0),
    }
    rings = {one.look: one.radius for one in found if isinstance(one, Ring)}
    assert rings == {Look.TIP: 0.8, Look.GHOST: 3.0}  # two standard deviations
    lines = {one.look: one for one in found if isinstance(one, Stroke) and not one.dashed}
    cell = lines[Look.CELL].points
    assert cell.min(axis=0) == pytest.approx([50.0, 30.0], abs=1e-9)  # the long axis is upright
    assert cell.max(axis=0) == pytest.approx([70.0, 70.0], abs=1e-9)
    assert "4.02 ± 0.17 µm, 10°" in [one.label for one in found if isinstance(one, Stroke)]
    ahead = next(one for one in found if one.look is Look.AHEAD)
    assert ahead.points[1] == pytest.approx([68.0, 50.0])  # away from the body
    assert lines[Look.NANO].closed
    assert {one.look for one in shapes(seen, frozenset())} == {Look.GHOST}  # always in sight


def test_words_tell_uncertainties(status):
    said = tip_text(outlined(status).tip)
    assert "80.00, 50.00 ± 0.40 px" in said
    assert "±2.00 ± 0.30 µm from focus" in said  # its sign is not known
    assert tip_text(TipSeen(TipState.LOST, reason="covered")) == "lost: covered"
    known = stage_text("micro", status.calibration.micro)
    assert known.startswith("micro: 335.00 × 335.00 ± 0.00 nm/px, turned 0.000")
    assert "residual 0.07 px, 2026-03-04 05:06" in known
    assert stage_text("nano", None) == "nano: not calibrated"
    assert target_text(2, Target(7.0, 8.0, Visit.FAILED, "no")) == "2   7, 8 px   failed: no"
    line = Measured(np.zeros(2), np.array([3.0, 4.0]), 5.0, None, np.radians(53.0), None)
    assert measured_text(line) == "5.0 px, 53.0°"


def test_what_is_typed_for_a_camera():
    typed = CameraTexts("12.5", "2", "", "10 20 640 480", "mono8", "software", False)
    wanted = CameraSettings(
        0.0125, 2.0, None, Region(10, 20, 640, 480), PixelType.MONO8, Trigger.SOFTWARE, False
    )
    assert settings_of(typed) == wanted
    assert settings_of(texts_of(wanted)) == wanted
    assert settings_of(CameraTexts(region="Whole ")) == CameraSettings()


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        (CameraTexts(exposure="fast"), "exposure: 'fast' is not a number; enter one in ms"),
        (CameraTexts(gain="nan"), "gain: 'nan' is not a number"),
        (CameraTexts(rate="1 000"), "rate: '1 000' is not a number"),
        (
            CameraTexts(region="1 2 3"),
            "region: '1 2 3' is not valid; enter whole, or four integers",
        ),
        (CameraTexts(region="1 2 3 -4"), "first column, first row, width and height"),
    ],
)
def test_what_is_no_setting_is_said(typed, said):
    with pytest.raises(CameraSettingError) as caught:
        settings_of(typed)
    assert said in str(caught.value)
