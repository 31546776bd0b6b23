"""Dialog that resamples a trajectory and shows the resulting speeds."""

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

from rotemina.app.language import describe_error, describe_speed_changes
from rotemina.app.widgets.controls import name_widget
from rotemina.plugins.trajectory import mark, tr
from rotemina.sim.errors import InputError
from rotemina.sim.messages import parse_number
from rotemina.sim.records import Record, resample

# The preview is computed when the operator has not typed for this long.
PREVIEW_DELAY_MS = 250
RESAMPLING_METHODS = {
    mark("hold – as a device does between rows"): "hold",
    mark("linear – straight lines between rows"): "linear",
    mark("cubic – smooth, may overshoot the rows"): "cubic",
}


class ResamplingDialog(QDialog):
    """Dialog with the rate and the method. It shows the result before the operator accepts it."""

    def __init__(self, trajectory: Record, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Resample the trajectory"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._trajectory = trajectory
        self.resampled: Record | None = None
        self.rate = name_widget(
            QLineEdit("1000"), tr("Rate in Hz"), tr("Rows per second, Hz; above 0")
        )
        self.method = QComboBox()
        for text, name in RESAMPLING_METHODS.items():
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
        # The preview does not follow every key press, because resampling may take a while.
        self._preview_timer = QTimer(self, singleShot=True, interval=PREVIEW_DELAY_MS)
        self._preview_timer.timeout.connect(self._update_preview)
        self.rate.textChanged.connect(self._schedule_preview)
        self.method.currentIndexChanged.connect(self._schedule_preview)
        self._update_preview()

    def _schedule_preview(self) -> None:
        self.buttons.button(QDialogButtonBox.StandardButton.Ok).setEnabled(False)
        self._preview_timer.start()

    def _update_preview(self) -> None:
        try:
            self.resampled = resample(
                self._trajectory, self._read_rate_hz(), self.method.currentData()
            )
        except InputError as error:
            self.resampled = None
            self.outcome.setText(describe_error(error))
        else:
            self.outcome.setText(describe_speed_changes(self._trajectory, self.resampled))
        ok_button = self.buttons.button(QDialogButtonBox.StandardButton.Ok)
        ok_button.setEnabled(self.resampled is not None)

    def _read_rate_hz(self) -> float:
        """Return the rate of the field.

        Raises
        ------
        InputError
            If its text is not a number.
        """
        text = self.rate.text().strip()
        rate_hz = parse_number(text)
        if rate_hz is None:
            raise InputError(
                tr("rate: {text!r} is not a number; enter one in Hz, such as 1000").format(
                    text=text
                )
            )
        return rate_hz
