"""Long work as every screen shows it: how far it is, the time left, and a way to call it off."""

import time

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QToolButton, QWidget

from rotemina.app.display_units import duration_text
from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import fill
from rotemina.app.widgets.labels import ElidedLabel
from rotemina.drivers.clock import Clock
from rotemina.sim.errors import InputError

_SOON_S = 0.3  # work that ends sooner is not worth a word
_ESTIMATE_S = 1.0  # before, what is left cannot be told
_STEPS = 1000
_TEXT_WIDTH, _BAR_WIDTH = 380, 120


class CancelledError(InputError):
    """The operator has called the work off."""


class Progress:
    """How far work is; the thread that works reports, and the screen reads and may call it off.

    Parameters
    ----------
    doing : str
        What is being done, as a whole sentence.
    cancellable : bool
        Whether the work reports often enough, and leaves nothing half done.
    clock : callable
    """

    def __init__(
        self, doing: str, *, cancellable: bool = True, clock: Clock = time.monotonic
    ) -> None:
        self.doing = doing
        self.cancellable = cancellable
        self.cancelled = False
        self.share: float | None = None
        self._clock = clock
        self._began_s = clock()

    def reached(self, share: float) -> None:
        """Report a share of the work that is done, 0 to 1.

        Raises
        ------
        CancelledError
            If it was called off.
        """
        if self.cancelled:
            raise CancelledError(
                translate("shell", "{doing} Cancelled; nothing was changed.").format(
                    doing=self.doing
                )
            )
        self.share = min(max(share, 0.0), 1.0)

    def cancel(self) -> None:
        """Call it off; it ends when it reports next."""
        self.cancelled = self.cancellable

    @property
    def elapsed_s(self) -> float:
        """For how long it has been worked on, s."""
        return self._clock() - self._began_s

    @property
    def left_s(self) -> float | None:
        """How long it still takes if it continues as before, s; None while that cannot be told."""
        if not self.share or self.elapsed_s < _ESTIMATE_S:
            return None
        return self.elapsed_s * (1.0 - self.share) / self.share

    @property
    def text(self) -> str:
        """What is being done, and for how long yet."""
        if self.cancelled:
            return translate("shell", "{doing} Cancelling.").format(doing=self.doing)
        if (left_s := self.left_s) is not None:
            return translate("shell", "{doing} About {left} left.").format(
                doing=self.doing, left=duration_text(left_s)
            )
        return translate("shell", "{doing} Running for {passed}.").format(
            doing=self.doing, passed=duration_text(self.elapsed_s)
        )


class _WorkText(ElidedLabel):
    """What is being done: cut where the window is narrow, rather than making it wider."""

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's name)
        """Ask for the usual width."""
        return QSize(_TEXT_WIDTH, super().sizeHint().height())


class ProgressLine(QWidget):
    """One line for the status bar: text, bar, cancel; unseen while there is nothing long."""

    def __init__(self) -> None:
        super().__init__()
        self._progress: Progress | None = None
        self.text, self.bar, self.cancel = _WorkText(), QProgressBar(), QToolButton()
        self.bar.setFixedWidth(_BAR_WIDTH)
        self.bar.setAccessibleName(translate("shell", "Progress of long work"))
        self.cancel.setText(translate("shell", "Cancel"))
        self.cancel.setToolTip(translate("shell", "Cancel this work"))
        self.cancel.clicked.connect(lambda _: self._progress and self._progress.cancel())
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for widget in (self.text, self.bar, self.cancel):
            row.addWidget(widget)
        self.hide()

    def show_progress(self, progress: Progress | None) -> None:
        """Show how work stands; None: there is none."""
        self._progress = progress
        self.setVisible(progress is not None and progress.elapsed_s >= _SOON_S)
        if progress is None or not self.isVisibleTo(self.parentWidget()):
            return
        self.text.show_text(progress.text)
        self.cancel.setVisible(progress.cancellable)
        self.cancel.setEnabled(not progress.cancelled)
        known = progress.share is not None
        self.bar.setRange(0, _STEPS if known else 0)
        if known:
            fill(self.bar, round(_STEPS * (progress.share or 0.0)))
