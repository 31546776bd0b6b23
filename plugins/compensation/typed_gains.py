"""Typed gains that replace those of a front's point."""

from PySide6.QtWidgets import QLabel, QLineEdit, QWidget

from rotemina.app.motion.regulation import NamedRegulation
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.layouts import in_grid
from rotemina.plugins.compensation import tr
from rotemina.plugins.compensation.background_search import RATE_HZ
from rotemina.sim.effects.facts import Facts
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.messages import message
from rotemina.sim.quantities import parsed, rounded
from rotemina.sim.robot.model import Robot
from rotemina.sim.tuning.search_problem import USUAL, gains_at, most_of, with_amounts

# Name in Gains, letter, unit.
_AMOUNTS = (
    ("proportional", "P", ""),
    ("integral", "I", "1/s"),
    ("double_integral", "J", "1/s²"),
    ("derivative", "D", "s"),
)
_DIGITS = 6
_COLUMNS = 2  # so that all digits have room


class TypedGains(QWidget):
    """A field for each gain; they show the point in hand until one of them is typed."""

    def __init__(self, robot: Robot) -> None:
        super().__init__()
        self._robot = robot
        self.fields: dict[str, QLineEdit] = {}
        grid = in_grid(on=self, margins=0, spacing=4)
        for number, (name, letter, unit) in enumerate(_AMOUNTS):
            row, column = divmod(number, _COLUMNS)
            field = QLineEdit()
            field.setMinimumWidth(44)
            shown = f"{letter} [{unit}]" if unit else letter
            field.setAccessibleName(shown)
            grid.addWidget(QLabel(shown), 2 * row, column)
            grid.addWidget(field, 2 * row + 1, column)
            self.fields[name] = field

    @property
    def typed(self) -> bool:
        """Whether something was typed since gains were shown."""
        return any(field.isModified() for field in self.fields.values())

    def show_gains(self, axis: str, gains: Gains | None) -> None:
        """Show the gains of a point, or usual ones of an axis; nothing where there is none."""
        if axis:
            facts = Facts.of(self._robot.axes[axis])
            most = most_of(facts)
            gains = gains or gains_at(facts, RATE_HZ, USUAL)
        for name, _, unit in _AMOUNTS:
            field = self.fields[name]
            field.setText(rounded(getattr(gains, name), _DIGITS) if axis else "")
            field.setCursorPosition(0)  # the first digits are seen where not all have room
            field.setModified(False)
            if axis:
                tip = tr("0 to {most}; checked on the axis before use")
                field.setToolTip(plain_tip(tip.format(most=_told(most[name], unit))))

    def gains(self, axis: str, base: Gains | None) -> Gains:
        """Return what is typed for an axis, with the filters of ``base`` or usual ones.

        Raises
        ------
        FeedbackError
            With the gain, what was typed, and the bound.
        """
        facts = Facts.of(self._robot.axes[axis])
        most = most_of(facts)
        amounts = {}
        for name, letter, unit in _AMOUNTS:
            text = self.fields[name].text()
            value = parsed(text)
            if value is None or not 0.0 <= value <= most[name]:
                raise FeedbackError(
                    message(
                        "compensation",
                        "gain {letter} = {text}: must be a number from 0 to {most}, the bound of "
                        "the search",
                    ).fill(letter=letter, text=repr(text), most=_told(most[name], unit))
                )
            amounts[name] = value
        return with_amounts(base or gains_at(facts, RATE_HZ, USUAL), **amounts)


def typed_loop(robot: Robot, axis: str, gains: Gains) -> NamedRegulation:
    """Return typed gains as a loop that may be applied to a robot's axis.

    Raises
    ------
    FeedbackError
        If the loop is unstable, or nearer to it than allowed: with Ms and its bound.
    EffectError
        If an effect of the robot cannot be used.
    """
    told = ", ".join(f"{letter} {rounded(getattr(gains, name), 6)}" for name, letter, _ in _AMOUNTS)
    return NamedRegulation(Regulation(robot, axis, gains, RATE_HZ), f"typed gains, {told}")


def _told(most: float, unit: str) -> str:
    return f"{rounded(most, 4)} {unit}".rstrip()
