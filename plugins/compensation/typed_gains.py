"""Gains that the operator types instead of choosing a point of the front."""

from PySide6.QtWidgets import QLabel, QLineEdit, QWidget

from rotemina.app.motion.session import NamedRegulation
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.layout import make_grid
from rotemina.plugins.compensation import tr
from rotemina.plugins.compensation.background_search import LOOP_RATE_HZ
from rotemina.sim.effects import AxisProperties
from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback import AxisRegulation, ControllerGains
from rotemina.sim.messages import format_rounded, message, parse_number
from rotemina.sim.robot import Robot
from rotemina.sim.tuning import (
    DEFAULT_SHARES,
    gains_from_shares,
    max_gain_amounts,
    with_gain_amounts,
)

# Name in ``ControllerGains``, letter on the screen, and unit of each gain.
_GAIN_FIELDS = (
    ("proportional", "P", ""),
    ("integral", "I", "1/s"),
    ("double_integral", "J", "1/s²"),
    ("derivative", "D", "s"),
)
_GAIN_DIGITS = 6

# Two columns are wide enough for all digits.
_COLUMN_COUNT = 2


class TypedGains(QWidget):
    """Fields for the gains. They show the gains of the chosen point until the operator types."""

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self._robot = robot
        self.fields: dict[str, QLineEdit] = {}
        grid = make_grid(on=self, margins=0, spacing=4)
        for index, (name, letter, unit) in enumerate(_GAIN_FIELDS):
            row, column = divmod(index, _COLUMN_COUNT)
            field = QLineEdit()
            field.setMinimumWidth(44)
            title = f"{letter} [{unit}]" if unit else letter
            field.setAccessibleName(title)
            grid.addWidget(QLabel(title), 2 * row, column)
            grid.addWidget(field, 2 * row + 1, column)
            self.fields[name] = field

    @property
    def typed(self) -> bool:
        """Whether the operator has edited a field since gains were last shown."""
        return any(field.isModified() for field in self.fields.values())

    def show_gains(self, axis: str, gains: ControllerGains | None) -> None:
        """Show the gains of a point, or defaults if it is None. An empty axis clears the fields."""
        if axis:
            properties = AxisProperties.of(self._robot.axes[axis])
            bounds = max_gain_amounts(properties)
            gains = gains or gains_from_shares(properties, LOOP_RATE_HZ, DEFAULT_SHARES)
        for name, _, unit in _GAIN_FIELDS:
            field = self.fields[name]
            field.setText(format_rounded(getattr(gains, name), _GAIN_DIGITS) if axis else "")
            # A field that is too narrow shows the first digits.
            field.setCursorPosition(0)
            field.setModified(False)
            if axis:
                tooltip = tr("0 to {most}; checked on the axis before use")
                field.setToolTip(
                    make_tooltip(tooltip.format(most=_format_bound(bounds[name], unit)))
                )

    def read_gains(self, axis: str, base: ControllerGains | None) -> ControllerGains:
        """Return the typed gains of an axis, with the filters of ``base`` or default filters.

        Raises
        ------
        FeedbackError
            If a text is not a number within the bounds. The message names gain, text and bound.
        """
        properties = AxisProperties.of(self._robot.axes[axis])
        bounds = max_gain_amounts(properties)
        amounts = {}
        for name, letter, unit in _GAIN_FIELDS:
            text = self.fields[name].text()
            value = parse_number(text)
            if value is None or not 0.0 <= value <= bounds[name]:
                raise FeedbackError(
                    message(
                        "compensation",
                        "gain {letter} = {text}: must be a number from 0 to {most}, the bound of "
                        "the search",
                    ).fill(letter=letter, text=repr(text), most=_format_bound(bounds[name], unit))
                )
            amounts[name] = value
        return with_gain_amounts(
            base or gains_from_shares(properties, LOOP_RATE_HZ, DEFAULT_SHARES), **amounts
        )


def make_typed_loop(robot: Robot, axis: str, gains: ControllerGains) -> NamedRegulation:
    """Return typed gains as a loop that can be applied to an axis of the robot.

    Raises
    ------
    FeedbackError
        If the loop is unstable, or its peak sensitivity Ms exceeds the bound. The message gives
        both values.
    EffectError
        If an effect of the robot cannot be used.
    """
    gains_text = ", ".join(
        f"{letter} {format_rounded(getattr(gains, name), 6)}" for name, letter, _ in _GAIN_FIELDS
    )
    return NamedRegulation(
        AxisRegulation(robot, axis, gains, LOOP_RATE_HZ), f"typed gains, {gains_text}"
    )


def _format_bound(bound: float, unit: str) -> str:
    return f"{format_rounded(bound, 4)} {unit}".rstrip()
