"""The panel on real threads: a stick is set up by hand, and is as it was left at the next start."""

import time

import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import SilencePolicy
from rotemina.drivers.inputs.device import InputReading
from rotemina.plugins.inputs.panel import Page
from rotemina.plugins.inputs.profiles import SETTING
from rotemina.plugins.inputs.words import NOTHING_SENT

LONG_MS = 30_000


class Hand:
    """One window, a stick at it, and a hand."""

    def __init__(self, qtbot, window, stick):
        self.qtbot, self.window, self.stick = qtbot, window, stick
        self.operation = window.workbench.operation
        self.devices = self.operation.devices
        self.panel = window.panels["inputs"]
        window.docks["inputs"].raise_()
        hub = self.devices.hub
        hub._sources = {**hub._sources, stick.key: stick}
        self.devices.look()
        self.until(lambda: self.panel.list.key == stick.key)

    def until(self, told):
        self.qtbot.waitUntil(told, timeout=LONG_MS)

    def press(self, button):
        self.until(button.isEnabled)
        self.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)

    def type(self, field, text):
        field.setText(text)
        self.qtbot.keyClick(field, Qt.Key.Key_Return)

    def raw(self, axis):
        [view] = (one for one in self.devices.view.devices if one.device.axes == self.stick.axes)
        return next(one.raw for one in view.axes if one.control == axis)

    def notices(self):
        return " ".join(notice.text for notice in self.window.notices.notices())

    def find(self, row, axis, raw, done):
        """Move an axis for a row of the mapping, and let go of it; again, as a hand would."""
        self.press(row.control)
        for _ in range(10):
            self.stick.deflect(axis, raw)
            try:
                self.qtbot.waitUntil(done, timeout=2000)
            except self.qtbot.TimeoutError:  # a window that is held up for a second misses it
                self.stick.deflect(axis, 0.0)
                self.qtbot.wait(1200)
                continue
            self.stick.deflect(axis, 0.0)
            self.until(lambda: self.raw(axis) == 0.0)
            return
        raise AssertionError(f"{axis} was never found for {row.name}")


@pytest.fixture
def stick(make_stick):
    made = make_stick("stick", ("X", "Y", "Z"), ("1", "2"))
    made.clock = time.monotonic
    return made


@pytest.fixture
def make_hand(qtbot, make_robot_window, stick):
    return lambda: Hand(qtbot, make_robot_window(), stick)


def shown_live(hand, stick):
    """What the stick says is seen, and why it is not trusted."""
    panel = hand.panel
    stick.deflect("X", 0.5)
    stick.hold("2")
    hand.until(lambda: panel.live.rows["X"].numbers.text() == "+0.50   +46 %")
    assert "Pressed: 2" in panel.live.lamps.accessibleDescription()
    stick.release_all()
    hand.until(lambda: panel.live.rows["X"].about.text() == "→ Stick X")
    assert "stick may control" in panel.headline.text()
    device = hand.devices.device(stick.key)
    device.waiting.append(InputReading.unusable(stick.clock(), device, "a strange report"))
    stick.release_all()
    hand.until(lambda: panel.live.said.text().startswith("Reports not understood: 1."))
    assert "a strange report" in panel.live.said.text()


def set_up(hand, stick):
    """Nothing is sent while it is set up."""
    panel, devices = hand.panel, hand.devices
    hand.press(panel.set_up)
    assert panel.banner.isVisible()
    assert panel.banner.text() == NOTHING_SENT
    hand.until(lambda: devices.view.setting_up)
    stick.deflect("X", 1.0)
    hand.until(lambda: hand.raw("X") == 1.0)
    assert hand.operation.intent.deflections == {}
    stick.release_all()
    hand.until(lambda: hand.raw("X") == 0.0)


def found(hand):
    """Two owners are refused, and named; then z is given up, and the axis drives zn."""
    mapping = hand.panel.mapping
    rows = mapping.target_rows
    hand.find(rows["zn"], "Z", -0.9, lambda: "Refused" in mapping.message.text())
    assert "two owners, 'Z' of hid:046d:c215:stick (drives z) and 'Z'" in hand.notices()
    hand.press(rows["z"].clear)
    hand.find(rows["zn"], "Z", -0.9, lambda: rows["zn"].control.text() == "Z")
    assert rows["zn"].inverted.isChecked()
    assert rows["z"].control.text() == "–"


def mapped(hand):
    """An axis is turned round; another one presses, beyond a threshold that can be changed."""
    mapping = hand.panel.mapping
    rows = mapping.target_rows
    hand.press(rows["zn"].inverted)
    assert not hand.devices.profile.devices[0].axes[-1].inverted
    clutch = mapping.action_rows[Action.CLUTCH]
    hand.press(rows["y"].clear)
    hand.find(clutch, "Y", 0.9, lambda: clutch.control.text() == "Y > 50 %")
    hand.type(clutch.at, "70")
    hand.until(lambda: clutch.control.text() == "Y > 70 %")
    hand.type(clutch.at, "5")
    assert "of the deflection must be" in mapping.message.text()
    hand.press(rows["y"].control)
    hand.until(lambda: rows["y"].control.text() == "move it …")
    hand.press(rows["y"].control)
    hand.until(lambda: rows["y"].control.text() == "–")


def made_to_continue(hand):
    """What silence means is chosen by the operator, and said plainly."""
    mapping = hand.panel.mapping
    assert "or it counts as released" in mapping.silence_meaning.text()
    index = mapping.silence.findData(SilencePolicy.CONTINUE)
    mapping.silence.setCurrentIndex(index)
    mapping.silence.activated.emit(index)
    assert hand.devices.profile.devices[0].when_silent is SilencePolicy.CONTINUE
    hand.until(lambda: "even if its link has failed" in mapping.silence_meaning.text())


def saved(hand):
    """What was changed is kept under a name."""
    profile = hand.panel.profile
    hand.until(lambda: "not saved" in profile.state.text())
    profile.name.setText("Mine")
    hand.press(profile.save)
    assert hand.window.workbench.settings.get(SETTING, "") == "Mine"
    hand.until(lambda: not profile.discard.isEnabled())


def measured(hand, stick):
    """One axis is measured, its curve changed, and both are kept."""
    panel, measuring = hand.panel, hand.panel.calibration.measuring
    panel.tabs.setCurrentIndex(list(Page).index(Page.CALIBRATION))
    for axis in ("Y", "Z"):
        measuring.wanted[axis].setChecked(False)
    hand.press(measuring.next)
    hand.until(lambda: "release" in measuring.text.text())
    assert not measuring.next.isEnabled()
    hand.press(measuring.next)  # it can be pressed after a second
    hand.until(lambda: "axis X hardly moved" in measuring.problems.text())
    for raw in (-0.7, 0.8, 0.0):
        stick.deflect("X", raw)
        hand.until(lambda raw=raw: hand.raw("X") == raw)
    hand.until(lambda: measuring.next.text() == "Done")
    hand.press(measuring.next)
    assert "-0.69 to +0.78" in panel.calibration.summary.text()
    hand.type(panel.calibration.expo, "2")
    assert panel.calibration.expo.property("bad")
    hand.type(panel.calibration.expo, "0.4")
    hand.press(panel.calibration.keep)
    assert "The calibration of stick is stored" in hand.notices()


def test_a_stick_is_seen_and_mapped_by_moving_it(make_hand, stick):
    hand = make_hand()
    shown_live(hand, stick)
    set_up(hand, stick)
    found(hand)
    made_to_continue(hand)
    hand.press(hand.panel.set_up)
    hand.until(lambda: hand.operation.intent.deflections == {"x": 0.0, "y": 0.0, "zn": 0.0})
    hand.until(lambda: "not saved: set up, and save it" in hand.panel.profile.state.text())


@pytest.mark.slow
def test_a_stick_is_set_up_and_as_it_was_left_at_the_next_start(make_hand, stick):
    hand = make_hand()
    set_up(hand, stick)
    found(hand)
    mapped(hand)
    saved(hand)
    measured(hand, stick)
    hand.press(hand.panel.set_up)
    hand.until(lambda: hand.operation.intent.deflections == {"x": 0.0, "zn": 0.0})
    hand.window.workbench.close()

    again = make_hand()
    again.until(lambda: again.operation.intent.deflections == {"x": 0.0, "zn": 0.0})
    assert again.panel.profile.choice.currentText() == "Mine"
    kept = again.devices.view.devices[-1].calibration.axis("X")
    assert (kept.expo, kept.low) == (0.4, pytest.approx(-0.686))
    assert again.notices() == ""


def test_a_missing_profile_is_told_and_a_hidden_panel_is_set_up_no_more(make_hand, settings, stick):
    settings.set(SETTING, "Gone")
    hand = make_hand()
    hand.until(lambda: "no profile 'Gone' any more" in hand.notices())
    panel, devices = hand.panel, hand.devices
    assert panel.profile.choice.currentText() == "Automatic"
    hand.press(panel.set_up)
    hand.until(lambda: devices.view.setting_up)
    panel.tabs.setCurrentIndex(list(Page).index(Page.CALIBRATION))
    hand.until(panel.calibration.expo.isVisible)
    hand.type(panel.calibration.expo, "0.5")
    hand.window.docks["inputs"].hide()
    assert not panel.set_up.isChecked()
    hand.until(lambda: not devices.view.setting_up)
    assert "The changed calibration of stick was not stored" in hand.notices()
    hand.window.docks["inputs"].show()
    assert not panel.banner.isVisible()
    hand.press(panel.set_up)
    stick.withdraw()
    hand.until(lambda: panel.list.key != stick.key)
    hand.until(lambda: "pad" in panel.mapping.heading.text())
