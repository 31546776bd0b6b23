"""The control menu: every way to move an axis, and when it is refused."""

import re

import pytest
from PySide6.QtCore import Qt

from rotemina.drivers.samples import DeviceState

LONG_MS = 30_000


@pytest.fixture
def panel(window):
    return window.panels["control"]


def settled_at(session, axis, position, tolerance):
    state = session.snapshot()
    idle = state.activity is DeviceState.IDLE
    return (
        idle
        and abs(state.command[axis] - position) < 1e-12
        and (abs(state.measured[axis] - position) < tolerance)
    )


def test_both_stages_show_every_axis_with_its_unit(qtbot, window, panel):
    qtbot.waitSignal(window.workbench.refreshed).wait()
    assert list(panel.rows) == ["x", "y", "z", "thx", "thy", "zn"]
    texts = {axis: row._readout.text() for axis, row in panel.rows.items()}
    # The last digit is the encoder's step, which its noise may turn.
    assert re.fullmatch(r"27\.(4999|500[01]) mm", texts["x"])
    assert re.fullmatch(r"58\d\.\d µrad", texts["thx"])
    assert re.fullmatch(r"32\.[45]\d\d µm", texts["zn"])


@pytest.mark.parametrize(("axis", "step"), [("x", 1e-5), ("thy", 1e-6), ("zn", 1e-8)])
def test_one_press_moves_one_step(qtbot, window, panel, axis, step):
    session = window.workbench.session
    start = session.snapshot().command[axis]
    row = panel.rows[axis]
    qtbot.waitUntil(row.plus.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(row.plus, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: settled_at(session, axis, start + step, 5e-6), timeout=LONG_MS)
    qtbot.waitUntil(row.minus.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(row.minus, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: settled_at(session, axis, start, 5e-6), timeout=LONG_MS)


def test_a_typed_target_is_reached(qtbot, window, panel):
    row = panel.rows["z"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    qtbot.keyClicks(row.target, "40.25")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    session = window.workbench.session
    qtbot.waitUntil(lambda: settled_at(session, "z", 0.04025, 1e-6), timeout=LONG_MS)


def test_a_target_beyond_the_range_is_refused_with_the_bound(qtbot, window, panel):
    row = panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    qtbot.keyClicks(row.target, "55.5")
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    (notice,) = window.notices.notices()
    assert "x" in notice.text
    assert "55" in notice.text
    assert window.workbench.session.snapshot().command["x"] == pytest.approx(0.0275)


@pytest.mark.parametrize("text", ["1_0", "٢٥", "nan", "inf", "0x10", "2 8", "", "1e"])
def test_only_plain_numbers_move_an_axis(qtbot, window, panel, text):
    row = panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    row.target.setText(text)
    qtbot.mouseClick(row.go, Qt.MouseButton.LeftButton)
    assert "is no position" in window.notices.notices()[0].text
    assert window.workbench.session.snapshot().command["x"] == pytest.approx(0.0275)


def test_a_decimal_comma_is_never_a_thousands_separator(qtbot, window, panel):
    row = panel.rows["x"]
    qtbot.waitUntil(row.go.isEnabled, timeout=LONG_MS)
    qtbot.keyClicks(row.target, "2,8")
    qtbot.keyClick(row.target, Qt.Key.Key_Return)
    assert "decimal point" in window.notices.notices()[0].text
    assert window.workbench.session.snapshot().command["x"] == pytest.approx(0.0275)


def test_controls_lock_while_the_position_is_unknown(qtbot, window, panel):
    window.workbench.session.close()
    row = panel.rows["x"]
    qtbot.waitUntil(lambda: not row.plus.isEnabled(), timeout=LONG_MS)
    assert not row.go.isEnabled()
    assert row._readout.property("stale")
