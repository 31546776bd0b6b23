"""Interrupted recordings, and the button that recovers them."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QPushButton

from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.plugins.recorder import tr
from rotemina.plugins.recorder.interrupted_files import Unfinished, recovered
from rotemina.plugins.recorder.words import listed, unfinished_text


class UnfinishedBox(QFrame):
    """Names what was not ended; unseen where there is nothing.

    Signals
    -------
    recovered() : what could be recovered is there now.
    """

    recovered = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("question")
        self._workbench = workbench
        self._waiting: tuple[Path, ...] = ()
        self._doing = False
        self.text = plain_text(quiet=False, wrap=True)
        self.recover = QPushButton(tr("Recover"))
        self.recover.setToolTip(tr("Complete interrupted recordings with the data on the disk"))
        self.recover.clicked.connect(self._recover)
        in_row((self.text, 1), self.recover, on=self, margins=(8, 4, 8, 4))
        self.hide()

    def show_unfinished(self, unfinished: Sequence[Unfinished]) -> None:
        """Show the interrupted recordings."""
        self._waiting = tuple(one.path for one in unfinished if not one.busy)
        self.text.setText(unfinished_text(unfinished))
        self.setVisible(bool(unfinished))
        self._show()

    def _show(self) -> None:
        self.recover.setVisible(bool(self._waiting))
        self.recover.setEnabled(not self._doing)
        self.recover.setText(tr("Recovering …") if self._doing else tr("Recover"))

    def _recover(self) -> None:
        self._doing = True
        self._show()
        waiting = self._waiting
        names = listed([path.name for path in waiting])
        doing = tr("Recovering {names} …").format(names=names)
        self._workbench.work("recover", doing, lambda: recovered(waiting), self._take, self._end)

    def _take(self, answer: tuple[tuple[Path, ...], tuple[str, ...]]) -> None:
        done, refused = answer
        if done:
            names = listed([path.name for path in done])
            self._workbench.notify(Level.GOOD, tr("Recovered {names}").format(names=names))
        for reason in refused:
            self._workbench.notify(Level.ERROR, reason, about=self)
        self._end()

    def _end(self) -> None:
        self._doing = False
        self._show()
        self.recovered.emit()
