"""Box with the interrupted recordings and the button that recovers them."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QPushButton

from rotemina.app.widgets.layout import make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.recorder import tr
from rotemina.plugins.recorder.interrupted_files import InterruptedRecording, recover_all
from rotemina.plugins.recorder.words import describe_interrupted, join_names


class InterruptedRecordingsBox(QFrame):
    """Box that names interrupted recordings. It is hidden if there are none.

    Signals
    -------
    recovered() : the recovery has finished.
    """

    recovered = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.setObjectName("question")
        self._workbench = workbench
        self._recoverable_paths: tuple[Path, ...] = ()
        self._is_recovering = False
        self.text = make_plain_label(quiet=False, wrap=True)
        self.recover = QPushButton(tr("Recover"))
        self.recover.setToolTip(tr("Complete interrupted recordings with the data on the disk"))
        self.recover.clicked.connect(self._recover)
        make_row((self.text, 1), self.recover, on=self, margins=(8, 4, 8, 4))
        self.hide()

    def show_interrupted(self, recordings: Sequence[InterruptedRecording]) -> None:
        """Show the interrupted recordings."""
        self._recoverable_paths = tuple(
            recording.path for recording in recordings if not recording.busy
        )
        self.text.setText(describe_interrupted(recordings))
        self.setVisible(bool(recordings))
        self._update_button()

    def _update_button(self) -> None:
        self.recover.setVisible(bool(self._recoverable_paths))
        self.recover.setEnabled(not self._is_recovering)
        self.recover.setText(tr("Recovering …") if self._is_recovering else tr("Recover"))

    def _recover(self) -> None:
        self._is_recovering = True
        self._update_button()
        paths = self._recoverable_paths
        names = join_names([path.name for path in paths])
        activity = tr("Recovering {names} …").format(names=names)
        self._workbench.work(
            "recover", activity, lambda: recover_all(paths), self._on_recovered, self._on_finished
        )

    def _on_recovered(self, answer: tuple[tuple[Path, ...], tuple[str, ...]]) -> None:
        results, problems = answer
        if results:
            names = join_names([path.name for path in results])
            self._workbench.notify(Level.GOOD, tr("Recovered {names}").format(names=names))
        for problem in problems:
            self._workbench.notify(Level.ERROR, problem, about=self)
        self._on_finished()

    def _on_finished(self) -> None:
        self._is_recovering = False
        self._update_button()
        self.recovered.emit()
