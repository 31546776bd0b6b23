"""Progress of long work, and cancelling it."""

import pytest

from rotemina.app.errors import WorkCancelledError
from rotemina.app.workbench import StatusProgressLine, WorkProgress


class Clock:
    now_s = 10.0

    def __call__(self):
        return self.now_s


def test_the_remaining_time_is_shown_once_known():
    clock = Clock()
    progress = WorkProgress("Copied.", clock=clock)
    assert progress.remaining_s is None
    progress.report(0.25)
    clock.now_s += 0.5
    assert progress.remaining_s is None
    clock.now_s += 9.5
    assert progress.remaining_s == pytest.approx(30.0)
    assert progress.text == "Copied. About 0:30 left."
    progress.report(3.0)
    assert progress.remaining_s == 0.0


def test_cancelled_work_ends_at_its_next_report():
    progress = WorkProgress("Copied.")
    progress.cancel()
    with pytest.raises(WorkCancelledError, match="Cancelled"):
        progress.report(0.5)
    uncancellable = WorkProgress("Merged.", cancellable=False)
    uncancellable.cancel()
    uncancellable.report(0.5)
    assert uncancellable.share == 0.5


def test_the_line_appears_for_long_work_and_can_cancel_it(qtbot):
    line, clock = StatusProgressLine(), Clock()
    qtbot.addWidget(line)
    progress = WorkProgress("Copied.", clock=clock)
    line.show_progress(progress)
    assert line.isHidden()
    clock.now_s += 2.0
    progress.report(0.5)
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
