"""Long work in the status bar: its progress, the remaining time, and a button to cancel it."""

import time

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QToolButton, QWidget

from rotemina.app.errors import WorkCancelledError
from rotemina.app.language import format_duration, translate
from rotemina.app.widgets.controls import set_bar_value
from rotemina.app.widgets.text import ElidedLabel
from rotemina.drivers.contract import Clock

# Shorter work is not shown.
_MIN_SHOWN_S = 0.3
# Before this time, the remaining time cannot be estimated.
_MIN_ESTIMATE_S = 1.0
_BAR_STEPS = 1000
_TEXT_WIDTH_PX, _BAR_WIDTH_PX = 380, 120


class WorkProgress:
    """Progress of work: the working thread reports it, and the window shows it and may cancel.

    Parameters
    ----------
    doing : str
        The work that is being done, as a whole sentence.
    cancellable : bool
        Whether the work reports often enough and leaves nothing half done.
    clock : callable
    """

    def __init__(
        self, doing: str, *, cancellable: bool = True, clock: Clock = time.monotonic
    ) -> None:
        self.description = doing
        self.cancellable = cancellable
        self.cancelled = False
        self.share: float | None = None
        self._clock = clock
        self._start_time_s = clock()

    def report(self, share: float) -> None:
        """Report the finished share of the work, 0 to 1.

        Raises
        ------
        WorkCancelledError
            If the work was cancelled.
        """
        if self.cancelled:
            raise WorkCancelledError(
                translate("shell", "{doing} Cancelled; nothing was changed.").format(
                    doing=self.description
                )
            )
        self.share = min(max(share, 0.0), 1.0)

    def cancel(self) -> None:
        """Cancel the work; it ends at its next report."""
        self.cancelled = self.cancellable

    @property
    def elapsed_s(self) -> float:
        """Time since the start of the work, s."""
        return self._clock() - self._start_time_s

    @property
    def remaining_s(self) -> float | None:
        """Estimated remaining time, s; None if it cannot be estimated yet."""
        if not self.share or self.elapsed_s < _MIN_ESTIMATE_S:
            return None
        return self.elapsed_s * (1.0 - self.share) / self.share

    @property
    def text(self) -> str:
        """The work, and its remaining or elapsed time."""
        if self.cancelled:
            return translate("shell", "{doing} Cancelling.").format(doing=self.description)
        if (remaining_s := self.remaining_s) is not None:
            return translate("shell", "{doing} About {left} left.").format(
                doing=self.description, left=format_duration(remaining_s)
            )
        return translate("shell", "{doing} Running for {passed}.").format(
            doing=self.description, passed=format_duration(self.elapsed_s)
        )


class _WorkText(ElidedLabel):
    """Label that is cut in a narrow window, so that it does not widen the window."""

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Request the usual width."""
        return QSize(_TEXT_WIDTH_PX, super().sizeHint().height())


class StatusProgressLine(QWidget):
    """Text, bar and cancel button in the status bar; hidden unless long work is running."""

    def __init__(self) -> None:
        super().__init__()
        self._progress: WorkProgress | None = None
        self.text, self.bar, self.cancel = _WorkText(), QProgressBar(), QToolButton()
        self.bar.setFixedWidth(_BAR_WIDTH_PX)
        self.bar.setAccessibleName(translate("shell", "Progress of long work"))
        self.cancel.setText(translate("shell", "Cancel"))
        self.cancel.setToolTip(translate("shell", "Cancel this work"))
        self.cancel.clicked.connect(lambda _: self._progress and self._progress.cancel())
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for widget in (self.text, self.bar, self.cancel):
            row.addWidget(widget)
        self.hide()

    def show_progress(self, progress: WorkProgress | None) -> None:
        """Show the progress of work; None hides the line."""
        self._progress = progress
        self.setVisible(progress is not None and progress.elapsed_s >= _MIN_SHOWN_S)
        if progress is None or not self.isVisibleTo(self.parentWidget()):
            return
        self.text.show_text(progress.text)
        self.cancel.setVisible(progress.cancellable)
        self.cancel.setEnabled(not progress.cancelled)
        is_share_known = progress.share is not None
        self.bar.setRange(0, _BAR_STEPS if is_share_known else 0)
        if is_share_known:
            set_bar_value(self.bar, round(_BAR_STEPS * (progress.share or 0.0)))
