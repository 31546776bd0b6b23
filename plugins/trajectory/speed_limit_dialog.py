"""The question how fast axes may move, where the robot file states no limit."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QFormLayout, QLineEdit, QWidget

from rotemina.app.display_units import label
from rotemina.app.shell.requests_at_rest import WaitingRequest
from rotemina.app.widgets.controls import named
from rotemina.app.widgets.labels import plain_text
from rotemina.plugins.trajectory import tr
from rotemina.sim.quantities import Scale, parsed, scale_of
from rotemina.sim.trajectory.dry_run import AxisFigures


class SpeedLimitDialog(QDialog):
    """One field for each axis; they are empty, so that nobody agrees to a speed unread.

    Signals
    -------
    limited(dict) : axis -> greatest speed, m/s or rad/s; the operator wants to play.
    """

    limited = Signal(object)

    def __init__(
        self,
        axes: Sequence[str],
        figures: Mapping[str, AxisFigures],
        request: WaitingRequest,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._request = request
        self.rejected.connect(request.give_up)
        self.setWindowTitle(tr("Speed limit"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.fields: dict[str, QLineEdit] = {}
        self._scales: dict[str, Scale] = {}
        why = plain_text(
            tr(
                "The robot file states no speed limit for these axes. Enter the greatest speed "
                "at which each may move."
            ),
            quiet=False,
            wrap=True,
        )
        form = QFormLayout(self)
        form.addRow(why)
        for axis in axes:
            figure = figures[axis]
            scale = scale_of(f"{figure.unit}/s", figure.peak_speed)
            reaches = tr("the trajectory reaches {speed}").format(
                speed=scale.text(figure.peak_speed)
            )
            field = named(QLineEdit(), tr("Greatest speed of {axis}").format(axis=label(axis)))
            field.setPlaceholderText(reaches)
            field.setToolTip(tr("In {unit}, above 0").format(unit=scale.symbol))
            field.textChanged.connect(self._show_state)
            form.addRow(f"{label(axis)} [{scale.symbol}]", field)
            self.fields[axis], self._scales[axis] = field, scale
        buttons = QDialogButtonBox.StandardButton
        self.buttons = QDialogButtonBox(buttons.Ok | buttons.Cancel)
        self.play = self.buttons.button(buttons.Ok)
        self.play.setText(tr("Play"))
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        form.addRow(self.buttons)
        self.accepted.connect(lambda: self.limited.emit(self._speeds()))
        self.setMinimumWidth(380)
        self._show_state()

    def close_if_stopped(self) -> None:
        """Close where a stop has withdrawn the request, which reports it."""
        if not self._request.waits:
            self.reject()

    def close_for_another(self) -> None:
        """Close because another trajectory was loaded."""
        self._request.withdraw(tr("another trajectory was loaded meanwhile"))
        self.reject()

    def _speeds(self) -> dict[str, float]:
        """Return the speeds that are valid so far."""
        numbers = {axis: parsed(field.text()) for axis, field in self.fields.items()}
        return {
            axis: number / self._scales[axis].per_si
            for axis, number in numbers.items()
            if number is not None and number > 0.0
        }

    def _show_state(self) -> None:
        self.play.setEnabled(len(self._speeds()) == len(self.fields))
