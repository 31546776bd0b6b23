"""Dialog that asks how fast axes may move if the robot file states no limit."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QFormLayout, QLineEdit, QWidget

from rotemina.app.language import get_axis_label
from rotemina.app.widgets.controls import name_widget
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import WaitingRequest
from rotemina.plugins.trajectory import tr
from rotemina.sim.messages import parse_number
from rotemina.sim.trajectory import AxisDemands
from rotemina.sim.units import DisplayScale, choose_scale


class SpeedLimitDialog(QDialog):
    """Dialog with a speed field for each axis.

    The fields are empty at first, so that the operator must enter every speed deliberately.

    Signals
    -------
    speeds_entered(dict)
        Emitted when the operator wants to play, with the maximum speed of each axis, m/s or rad/s.
    """

    speeds_entered = Signal(object)

    def __init__(
        self,
        axes: Sequence[str],
        figures: Mapping[str, AxisDemands],
        request: WaitingRequest,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._request = request
        self.rejected.connect(request.end_silently)
        self.setWindowTitle(tr("Speed limit"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.fields: dict[str, QLineEdit] = {}
        self._scales: dict[str, DisplayScale] = {}
        explanation = make_plain_label(
            tr(
                "The robot file states no speed limit for these axes. Enter the maximum speed "
                "at which each may move."
            ),
            quiet=False,
            wrap=True,
        )
        form = QFormLayout(self)
        form.addRow(explanation)
        for axis in axes:
            figure = figures[axis]
            scale = choose_scale(f"{figure.unit}/s", figure.peak_speed)
            peak_text = tr("the trajectory reaches {speed}").format(
                speed=scale.format_with_unit(figure.peak_speed)
            )
            field = name_widget(
                QLineEdit(), tr("Maximum speed of {axis}").format(axis=get_axis_label(axis))
            )
            field.setPlaceholderText(peak_text)
            field.setToolTip(tr("In {unit}, above 0").format(unit=scale.symbol))
            field.textChanged.connect(self._enable_play)
            form.addRow(f"{get_axis_label(axis)} [{scale.symbol}]", field)
            self.fields[axis], self._scales[axis] = field, scale
        standard_buttons = QDialogButtonBox.StandardButton
        self.buttons = QDialogButtonBox(standard_buttons.Ok | standard_buttons.Cancel)
        self.play = self.buttons.button(standard_buttons.Ok)
        self.play.setText(tr("Play"))
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        form.addRow(self.buttons)
        self.accepted.connect(lambda: self.speeds_entered.emit(self._read_speeds()))
        self.setMinimumWidth(380)
        self._enable_play()

    def close_if_stopped(self) -> None:
        """Close if a stop has cancelled the request. The request reports the stop."""
        if not self._request.is_waiting:
            self.reject()

    def close_for_another(self) -> None:
        """Close because another trajectory was loaded."""
        self._request.withdraw(tr("another trajectory was loaded meanwhile"))
        self.reject()

    def _read_speeds(self) -> dict[str, float]:
        """Return the speed of each field with a number above 0, m/s or rad/s."""
        numbers = {axis: parse_number(field.text()) for axis, field in self.fields.items()}
        return {
            axis: number / self._scales[axis].per_si
            for axis, number in numbers.items()
            if number is not None and number > 0.0
        }

    def _enable_play(self) -> None:
        self.play.setEnabled(len(self._read_speeds()) == len(self.fields))
