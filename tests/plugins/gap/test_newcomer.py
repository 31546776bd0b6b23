"""A new user with a window and records: five clicks name the hidden effect.

Slow: the test runs a whole diagnosis, and a motion in real time.
"""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialogButtonBox, QFileDialog, QListView, QMessageBox, QTabBar

from rotemina.app.blind import HiddenEffects, HiddenMachineSimulator
from rotemina.sim.blind import draw_case, write_case
from rotemina.sim.gap.output import localize_effect_title
from rotemina.sim.robot_files import load_robot

EFFECT = "hysteresis"
SEED = 4
MIN_GAP_REDUCTION = 5.0
LONG_MS = 600_000
SHORT_MS = 60_000


class MouseUser:
    """A user who clicks with the mouse, and counts the clicks."""

    def __init__(self, qtbot):
        self._qtbot = qtbot
        self.clicks = 0

    def click(self, widget, point=None, modifier=Qt.KeyboardModifier.NoModifier):
        position = point if point is not None else widget.rect().center()
        self._qtbot.mouseClick(widget, Qt.MouseButton.LeftButton, modifier, position)
        self.clicks += 1

    def wait_for_dialog(self, window, kind):
        """Wait for a dialog to come up, and return it."""

        def find_visible():
            return [child for child in window.findChildren(kind) if child.isVisible()]

        self._qtbot.waitUntil(lambda: bool(find_visible()), timeout=SHORT_MS)
        return find_visible()[0]


def find_dock_tab(window, title):
    """Return the tab bar that contains a dock, and the centre of its tab."""
    for bar in window.findChildren(QTabBar):
        for number in range(bar.count()):
            if bar.tabText(number).replace("&", "") == title and bar.isVisible():
                return bar, bar.tabRect(number).center()
    raise AssertionError(f"no tab {title!r}")


@pytest.mark.slow
def test_five_clicks_name_a_hidden_effect_and_a_new_motion_confirms_it(
    qtbot, settings, make_robot_window, tmp_path
):
    robot = load_robot("rotemina")
    case = draw_case(robot, "single", SEED, EFFECT)
    records = tmp_path / "records"
    write_case(records, case, robot)
    # The third record is mostly rests, and more than half of the time of the diagnosis.
    for unneeded_file in (*records.glob("test_*"), records / "train_3.csv.gz"):
        unneeded_file.unlink()
    count = len(list(records.iterdir()))
    settings.set("files.folder", str(records))
    window = make_robot_window(
        driver=lambda _: HiddenMachineSimulator(robot, HiddenEffects(SEED, case))
    )
    workbench, page = window.workbench, window.panels["gap"]
    qtbot.waitUntil(lambda: workbench.session.snapshot().lock_reason is None, timeout=SHORT_MS)

    user = MouseUser(qtbot)
    user.click(*find_dock_tab(window, page.title))
    user.click(page.start)
    dialog = user.wait_for_dialog(window, QFileDialog)
    files = dialog.findChild(QListView, "listView")
    qtbot.waitUntil(lambda: files.model().rowCount(files.rootIndex()) == count, timeout=SHORT_MS)
    rows = [files.model().index(row, 0, files.rootIndex()) for row in (0, count - 1)]
    user.click(files.viewport(), files.visualRect(rows[0]).center())
    shift = Qt.KeyboardModifier.ShiftModifier
    user.click(files.viewport(), files.visualRect(rows[1]).center(), shift)
    user.click(dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Open))
    assert user.clicks == 5
    qtbot.waitUntil(lambda: page.answer is not None, timeout=LONG_MS)
    verdict = page.result.headline.sentence.text()
    assert len(page.answer.records) == count

    user.click(page.result.twin)
    dialog = user.wait_for_dialog(window, QFileDialog)
    user.click(dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Save))
    qtbot.waitUntil(lambda: page.robots.currentText() == "twin.toml", timeout=SHORT_MS)
    assert load_robot(records / "twin.toml").effects == page.answer.diagnosis.fitted

    user.click(page.result.motion)
    question = user.wait_for_dialog(window, QMessageBox)
    user.click(question.button(QMessageBox.StandardButton.Yes))
    qtbot.waitUntil(lambda: page.result.unseen_motion.latest is not None, timeout=LONG_MS)
    assert page.result.views.currentWidget() is page.result.unseen_motion
    qtbot.waitUntil(page.result.unseen_motion.isVisible, timeout=SHORT_MS)

    hidden_effect = case.label()["effects"][0]
    assert localize_effect_title(hidden_effect["effect"]).lower() in verdict
    reductions = {
        reduction.trace.axis: reduction
        for reduction in page.result.unseen_motion.latest.reductions
        if reduction.trace.tap == "meas"
    }
    assert reductions[hidden_effect["axis"]].factor >= MIN_GAP_REDUCTION
    assert "×" in page.result.unseen_motion.table.read_texts()[0][4]
