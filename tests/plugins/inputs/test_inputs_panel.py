"""The inputs panel on real threads: a stick is set up, and its settings survive a restart."""

import time

import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.inputs import OperatorAction, SilencePolicy
from rotemina.drivers.inputs import InputReading
from rotemina.plugins.inputs.panel import SetUpPage
from rotemina.plugins.inputs.profiles import PROFILE_KEY
from rotemina.plugins.inputs.words import SET_UP_BANNER

LONG_MS = 30_000


class PanelUser:
    """A user of one window with one stick."""

    def __init__(self, qtbot, window, stick):
        self.qtbot, self.window, self.stick = qtbot, window, stick
        self.operation = window.workbench.operation
        self.devices = self.operation.devices
        self.panel = window.panels["inputs"]
        window.docks["inputs"].raise_()
        hub = self.devices.hub
        hub._sources = {**hub._sources, stick.key: stick}
        self.devices.detect_changes()
        self.wait_until(lambda: self.panel.device_list.device_key == stick.key)

    def wait_until(self, condition):
        self.qtbot.waitUntil(condition, timeout=LONG_MS)

    def press(self, button):
        self.wait_until(button.isEnabled)
        self.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)

    def type(self, field, text):
        field.setText(text)
        self.qtbot.keyClick(field, Qt.Key.Key_Return)

    def read_raw(self, axis):
        devices = self.devices.view.devices
        [view] = (device for device in devices if device.device.axes == self.stick.axes)
        return next(axis_view.raw for axis_view in view.axes if axis_view.control == axis)

    def join_notices(self):
        return " ".join(notice.text for notice in self.window.notices.notices())

    def map_axis(self, row, axis, raw, is_done):
        """Move an axis for a row of the mapping, and release it; repeat this if it is missed."""
        self.press(row.control)
        for _ in range(10):
            self.stick.deflect(axis, raw)
            try:
                self.qtbot.waitUntil(is_done, timeout=2000)
            except self.qtbot.TimeoutError:  # a busy window may miss the movement
                self.stick.deflect(axis, 0.0)
                self.qtbot.wait(1200)
                continue
            self.stick.deflect(axis, 0.0)
            self.wait_until(lambda: self.read_raw(axis) == 0.0)
            return
        raise AssertionError(f"{axis} was never found for {row.name}")


@pytest.fixture
def stick(make_stick):
    pad = make_stick("stick", ("X", "Y", "Z"), ("1", "2"))
    pad.clock = time.monotonic
    return pad


@pytest.fixture
def make_user(qtbot, make_robot_window, stick):
    return lambda: PanelUser(qtbot, make_robot_window(), stick)


def check_live_view(user, stick):
    """Check that the panel shows the readings of the stick, and reports that are not understood."""
    panel = user.panel
    stick.deflect("X", 0.5)
    stick.hold("2")
    user.wait_until(lambda: panel.live.rows["X"].numbers.text() == "+0.50   +46 %")
    assert "Pressed: 2" in panel.live.lamps.accessibleDescription()
    stick.release_all()
    user.wait_until(lambda: panel.live.rows["X"].target_text.text() == "→ Stick X")
    assert "stick may control" in panel.headline.text()
    device = user.devices.find_device(stick.key)
    device.unread_readings.append(
        InputReading.make_unusable(stick.clock(), device, "a strange report")
    )
    stick.release_all()
    user.wait_until(lambda: panel.live.problem_text.text().startswith("Reports not understood: 1."))
    assert "a strange report" in panel.live.problem_text.text()


def start_set_up(user, stick):
    """Start the set-up, and check that no motion is commanded during it."""
    panel, devices = user.panel, user.devices
    user.press(panel.set_up)
    assert panel.banner.isVisible()
    assert panel.banner.text() == SET_UP_BANNER
    user.wait_until(lambda: devices.view.is_mapping_open)
    stick.deflect("X", 1.0)
    user.wait_until(lambda: user.read_raw("X") == 1.0)
    assert user.operation.intent.deflections == {}
    stick.release_all()
    user.wait_until(lambda: user.read_raw("X") == 0.0)


def map_axis_to_zn(user):
    """Map the axis Z to zn: this is refused until the mapping of z is cleared."""
    mapping = user.panel.mapping
    rows = mapping.target_rows
    user.map_axis(rows["zn"], "Z", -0.9, lambda: "Refused" in mapping.message.text())
    assert "two owners, 'Z' of hid:046d:c215:stick (drives z) and 'Z'" in user.join_notices()
    user.press(rows["z"].clear)
    user.map_axis(rows["zn"], "Z", -0.9, lambda: rows["zn"].control.text() == "Z")
    assert rows["zn"].inverted.isChecked()
    assert rows["z"].control.text() == "–"
    user.press(rows["zn"].inverted)
    assert not user.devices.profile.devices[0].axes[-1].inverted


def map_clutch_to_axis(user):
    """Let an axis act as the clutch beyond a changed threshold."""
    mapping = user.panel.mapping
    rows = mapping.target_rows
    clutch = mapping.action_rows[OperatorAction.CLUTCH]
    user.press(rows["y"].clear)
    user.map_axis(clutch, "Y", 0.9, lambda: clutch.control.text() == "Y > 50 %")
    user.type(clutch.threshold_field, "70")
    user.wait_until(lambda: clutch.control.text() == "Y > 70 %")
    user.type(clutch.threshold_field, "5")
    assert "of the deflection must be" in mapping.message.text()
    user.press(rows["y"].control)
    user.wait_until(lambda: rows["y"].control.text() == "move it …")
    user.press(rows["y"].control)
    user.wait_until(lambda: rows["y"].control.text() == "–")


def choose_continue_when_silent(user):
    """Choose that a silent device continues, and check that the panel explains it."""
    mapping = user.panel.mapping
    assert "or it counts as released" in mapping.silence_meaning.text()
    index = mapping.silence.findData(SilencePolicy.CONTINUE)
    mapping.silence.setCurrentIndex(index)
    mapping.silence.activated.emit(index)
    assert user.devices.profile.devices[0].when_silent is SilencePolicy.CONTINUE
    user.wait_until(lambda: "even if its link has failed" in mapping.silence_meaning.text())


def save_profile(user):
    """Save the changed profile under a name."""
    profile = user.panel.profile
    user.wait_until(lambda: "not saved" in profile.state.text())
    profile.name.setText("Mine")
    user.press(profile.save_button)
    assert user.window.workbench.settings.get(PROFILE_KEY, "") == "Mine"
    user.wait_until(lambda: not profile.discard_button.isEnabled())


def calibrate_x(user, stick):
    """Calibrate the axis X, change its curve, and store both."""
    panel, measuring = user.panel, user.panel.calibration.measuring
    panel.tabs.setCurrentIndex(list(SetUpPage).index(SetUpPage.CALIBRATION))
    for axis in ("Y", "Z"):
        measuring.axis_boxes[axis].setChecked(False)
    user.press(measuring.next_button)
    user.wait_until(lambda: "release" in measuring.text.text())
    assert not measuring.next_button.isEnabled()
    user.press(measuring.next_button)  # it is enabled after a second
    user.wait_until(lambda: "axis X hardly moved" in measuring.problems.text())
    for raw in (-0.7, 0.8, 0.0):
        stick.deflect("X", raw)
        user.wait_until(lambda raw=raw: user.read_raw("X") == raw)
    user.wait_until(lambda: measuring.next_button.text() == "Done")
    user.press(measuring.next_button)
    assert "-0.69 to +0.78" in panel.calibration.summary.text()
    user.type(panel.calibration.expo, "2")
    assert panel.calibration.expo.property("bad")
    user.type(panel.calibration.expo, "0.4")
    user.press(panel.calibration.apply_button)
    assert "The calibration of stick is stored" in user.join_notices()


def test_a_stick_is_shown_and_mapped_by_moving_it(make_user, stick):
    user = make_user()
    check_live_view(user, stick)
    start_set_up(user, stick)
    map_axis_to_zn(user)
    choose_continue_when_silent(user)
    user.press(user.panel.set_up)
    user.wait_until(lambda: user.operation.intent.deflections == {"x": 0.0, "y": 0.0, "zn": 0.0})
    user.wait_until(lambda: "not saved: set up, and save it" in user.panel.profile.state.text())


@pytest.mark.slow
def test_the_set_up_of_a_stick_survives_a_restart(make_user, stick):
    user = make_user()
    start_set_up(user, stick)
    map_clutch_to_axis(user)
    save_profile(user)
    calibrate_x(user, stick)
    user.press(user.panel.set_up)
    user.wait_until(lambda: user.operation.intent.deflections == {"x": 0.0, "z": 0.0})
    user.window.workbench.close()

    next_user = make_user()
    next_user.wait_until(lambda: next_user.operation.intent.deflections == {"x": 0.0, "z": 0.0})
    assert next_user.panel.profile.choice.currentText() == "Mine"
    stored = next_user.devices.view.devices[-1].calibration.find_axis("X")
    assert (stored.expo, stored.low) == (0.4, pytest.approx(-0.686))
    assert next_user.join_notices() == ""


def test_a_missing_profile_is_reported_and_hiding_the_panel_ends_the_set_up(
    make_user, settings, stick
):
    settings.set(PROFILE_KEY, "Gone")
    user = make_user()
    user.wait_until(lambda: "no profile 'Gone' any more" in user.join_notices())
    panel, devices = user.panel, user.devices
    assert panel.profile.choice.currentText() == "Automatic"
    user.press(panel.set_up)
    user.wait_until(lambda: devices.view.is_mapping_open)
    panel.tabs.setCurrentIndex(list(SetUpPage).index(SetUpPage.CALIBRATION))
    user.wait_until(panel.calibration.expo.isVisible)
    user.type(panel.calibration.expo, "0.5")
    user.window.docks["inputs"].hide()
    assert not panel.set_up.isChecked()
    user.wait_until(lambda: not devices.view.is_mapping_open)
    assert "The changed calibration of stick was not stored" in user.join_notices()
    user.window.docks["inputs"].show()
    assert not panel.banner.isVisible()
    user.press(panel.set_up)
    stick.unplug()
    user.wait_until(lambda: panel.device_list.device_key != stick.key)
    user.wait_until(lambda: "pad" in panel.mapping.heading.text())
