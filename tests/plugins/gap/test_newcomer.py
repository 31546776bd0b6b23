"""A newcomer with nothing but the window and records: five clicks name what is hidden.

Slow: a whole diagnosis, and a motion in real time.
"""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialogButtonBox, QFileDialog, QListView, QMessageBox, QTabBar

from rotemina.app.blind.hidden_machine import HiddenMachine, Secret
from rotemina.sim.blind.case import draw_case
from rotemina.sim.blind.files import write_case
from rotemina.sim.gap.output.report.words import effect_title
from rotemina.sim.robot.file import load_robot

EFFECT = "hysteresis"
SEED = 4
LEAST_TIMES = 5.0
LONG_MS = 600_000
SOON_MS = 60_000


class Hand:
    """Clicks with the mouse, and counts."""

    def __init__(self, qtbot):
        self._qtbot = qtbot
        self.clicks = 0

    def click(self, widget, at=None, modifier=Qt.KeyboardModifier.NoModifier):
        where = at if at is not None else widget.rect().center()
        self._qtbot.mouseClick(widget, Qt.MouseButton.LeftButton, modifier, where)
        self.clicks += 1

    def dialog(self, window, kind):
        """Wait for a dialog to come up, and return it."""

        def shown():
            return [one for one in window.findChildren(kind) if one.isVisible()]

        self._qtbot.waitUntil(lambda: bool(shown()), timeout=SOON_MS)
        return shown()[0]


def dock_tab(window, title):
    """Return the tab bar of the docks, and where the tab of this title is on it."""
    for bar in window.findChildren(QTabBar):
        for number in range(bar.count()):
            if bar.tabText(number).replace("&", "") == title and bar.isVisible():
                return bar, bar.tabRect(number).center()
    raise AssertionError(f"no tab {title!r}")


@pytest.mark.slow
def test_five_clicks_name_a_hidden_effect_and_a_new_motion_shows_the_gap_shrink(
    qtbot, settings, make_robot_window, tmp_path
):
    robot = load_robot("rotemina")
    case = draw_case(robot, "single", SEED, EFFECT)
    records = tmp_path / "records"
    write_case(records, case, robot)
    for withheld in records.glob("test_*"):
        withheld.unlink()
    count = len(list(records.iterdir()))
    settings.set("files.folder", str(records))
    window = make_robot_window(driver=lambda _: HiddenMachine(robot, Secret(SEED, case)))
    bench, page = window.workbench, window.panels["gap"]
    qtbot.waitUntil(lambda: bench.session.snapshot().locked is None, timeout=SOON_MS)

    hand = Hand(qtbot)
    hand.click(*dock_tab(window, page.title))
    hand.click(page.start)
    dialog = hand.dialog(window, QFileDialog)
    files = dialog.findChild(QListView, "listView")
    qtbot.waitUntil(lambda: files.model().rowCount(files.rootIndex()) == count, timeout=SOON_MS)
    rows = [files.model().index(row, 0, files.rootIndex()) for row in (0, count - 1)]
    hand.click(files.viewport(), files.visualRect(rows[0]).center())
    shift = Qt.KeyboardModifier.ShiftModifier
    hand.click(files.viewport(), files.visualRect(rows[1]).center(), shift)
    hand.click(dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Open))
    assert hand.clicks == 5
    qtbot.waitUntil(lambda: page.answer is not None, timeout=LONG_MS)
    named = page.result.headline.sentence.text()
    assert len(page.answer.records) == count

    hand.click(page.result.twin)
    dialog = hand.dialog(window, QFileDialog)
    hand.click(dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Save))
    qtbot.waitUntil(lambda: page.robots.currentText() == "twin.toml", timeout=SOON_MS)
    assert load_robot(records / "twin.toml").effects == page.answer.diagnosis.fitted

    hand.click(page.result.motion)
    question = hand.dialog(window, QMessageBox)
    hand.click(question.button(QMessageBox.StandardButton.Yes))
    qtbot.waitUntil(lambda: page.result.proof.proof is not None, timeout=LONG_MS)
    assert page.result.views.currentWidget() is page.result.proof
    qtbot.waitUntil(page.result.proof.isVisible, timeout=SOON_MS)

    hidden = case.label()["effects"][0]  # only now
    assert effect_title(hidden["effect"]).lower() in named
    shrunk = {
        one.trace.axis: one for one in page.result.proof.proof.shrunk if one.trace.tap == "meas"
    }
    assert shrunk[hidden["axis"]].times >= LEAST_TIMES
    assert "×" in page.result.proof.table.texts()[0][4]
