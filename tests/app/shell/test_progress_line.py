"""How far long work is, and calling it off."""

import pytest

from rotemina.app.shell.progress_line import CancelledError, Progress, ProgressLine


class Clock:
    now_s = 10.0

    def __call__(self):
        return self.now_s


def test_time_left_is_told_when_it_can_be():
    clock = Clock()
    progress = Progress("Copied.", clock=clock)
    assert progress.left_s is None
    progress.reached(0.25)
    clock.now_s += 0.5
    assert progress.left_s is None
    clock.now_s += 9.5
    assert progress.left_s == pytest.approx(30.0)
    assert progress.text == "Copied. About 0:30 left."
    progress.reached(3.0)
    assert progress.left_s == 0.0


def test_work_that_is_called_off_ends_when_it_reports():
    progress = Progress("Copied.")
    progress.cancel()
    with pytest.raises(CancelledError, match="Cancelled"):
        progress.reached(0.5)
    kept = Progress("Merged.", cancellable=False)
    kept.cancel()
    kept.reached(0.5)
    assert kept.share == 0.5


def test_the_line_is_seen_for_long_work_only_and_cancels(qtbot):
    line, clock = ProgressLine(), Clock()
    qtbot.addWidget(line)
    progress = Progress("Copied.", clock=clock)
    line.show_progress(progress)
    assert line.isHidden()
    clock.now_s += 2.0
    progress.reached(0.5)
    line.show_progress(progress)
    assert not line.isHidden()
    assert line.bar.value() == line.bar.maximum() // 2
    assert line.text.text() == "Copied. About 0:02 left."
    line.cancel.click()
    assert progress.cancelled
    line.show_progress(progress)
    assert not line.cancel.isEnabled()
    line.show_progress(None)
    assert line.isHidden()
