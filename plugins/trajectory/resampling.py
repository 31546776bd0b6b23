"""The dialog that resamples a trajectory, with the speeds that this induces."""

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QWidget,
)

from rotemina.app.display_units import speed_changes
from rotemina.app.shell.engine_words import error_text
from rotemina.app.widgets.controls import named
from rotemina.plugins.trajectory import mark, tr
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record
from rotemina.sim.records.resampling import resample

PAUSE_MS = 250
METHODS = {
    mark("hold – as a device does between rows"): "hold",
    mark("linear – straight lines between rows"): "linear",
    mark("cubic – smooth, may overshoot the rows"): "cubic",
}


class ResamplingDialog(QDialog):
    """Rate and method; what would come out is shown before it is accepted."""

    def __init__(self, trajectory: Record, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Resample the trajectory"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._trajectory = trajectory
        self.resampled: Record | None = None
        self.rate = named(QLineEdit("1000"), tr("Rate in Hz"), tr("Rows per second, Hz; above 0"))
        self.method = QComboBox()
        for text, name in METHODS.items():
            self.method.addItem(tr(text), name)
        self.outcome = QLabel()
        self.outcome.setMinimumWidth(360)
        self.buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        form = QFormLayout(self)
        form.addRow(tr("Rate [Hz]"), self.rate)
        form.addRow(tr("Between rows"), self.method)
        form.addRow(tr("Fastest command"), self.outcome)
        form.addRow(self.buttons)
        # Not at every key: resampling a long trajectory takes its time.
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._try)
        self.rate.textChanged.connect(self._wait)
        self.method.currentIndexChanged.connect(self._wait)
        self._try()

    def _wait(self) -> None:
        self.buttons.button(QDialogButtonBox.StandardButton.Ok).setEnabled(False)
        self._pause.start()

    def _try(self) -> None:
        try:
            rate_hz = float(self.rate.text())
            self.resampled = resample(self._trajectory, rate_hz, self.method.currentData())
        except (InputError, ValueError) as error:
            self.resampled = None
            self.outcome.setText(error_text(error))
        else:
            self.outcome.setText(speed_changes(self._trajectory, self.resampled))
        ok = self.buttons.button(QDialogButtonBox.StandardButton.Ok)
        ok.setEnabled(self.resampled is not None)
