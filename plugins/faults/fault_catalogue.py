"""Faults that a virtual board can simulate, as commands with parameters. Does not use Qt."""

from dataclasses import dataclass

from rotemina.plugins.faults import tr


@dataclass(frozen=True, slots=True)
class ChoiceParameter:
    """Parameter of a fault that is one of several words.

    Attributes
    ----------
    name : str
    options : tuple of (str, str)
        For each option, the text on the screen and the word in the command.
    """

    name: str
    options: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class NumberParameter:
    """Parameter of a fault that is a number with a unit.

    Attributes
    ----------
    name : str
    default, low, high : float
        Default value and bounds, in ``unit``.
    unit, sent_unit : str
        The unit on the screen, and the unit in the command.
    decimals : int
    """

    name: str
    default: float
    low: float
    high: float
    unit: str = ""
    sent_unit: str = ""
    decimals: int = 0

    def format_for_command(self, value: float) -> str:
        """Return a value as text for the command."""
        number = f"{value:.{self.decimals}f}"
        return f"{number} {self.sent_unit}".rstrip()


@dataclass(frozen=True, slots=True)
class InjectableFault:
    """Kind of fault that can be injected. Its parameters are in the order of the command."""

    title: str
    meaning: str
    parameters: tuple[ChoiceParameter | NumberParameter, ...]

    def make_command(self, words: tuple[str, ...]) -> str:
        """Return the command for a virtual board, given one word for each parameter."""
        return " ".join(word for word in words if word)


def list_injectable_faults(
    axes: tuple[str, ...], steppers: tuple[str, ...], lines: int
) -> tuple[InjectableFault, ...]:
    """Return the faults of the virtual boards of a robot.

    Parameters
    ----------
    axes, steppers : tuple of str
        The names of all axes, and of the stepper axes.
    lines : int
        Number of serial lines to the boards.
    """
    line_options = (
        (tr("all lines"), ""),
        *((tr("line {n}").format(n=n), f"line {n}") for n in range(1, lines + 1)),
    )
    line_parameter = ChoiceParameter(tr("Line"), line_options if lines > 1 else line_options[:1])
    board_options = tuple(
        (tr("board {n}").format(n=n), f"{n}") for n in range(1, (len(axes) + 2) // 3 + 1)
    )
    damage_options = (
        (tr("lose"), "drop"),
        (tr("double"), "double"),
        (tr("corrupt"), "corrupt"),
        (tr("add"), "garbage"),
    )
    direction_parameter = ChoiceParameter(
        tr("Direction"), ((tr("to board"), "board"), (tr("to program"), "host"))
    )
    faults = [
        InjectableFault(
            tr("Bytes"),
            tr("The next bytes are lost, doubled or corrupted by one bit, or extra bytes arrive"),
            (
                ChoiceParameter(tr("Fault"), damage_options),
                NumberParameter(tr("Bytes"), 3, 1, 10_000),
                direction_parameter,
                line_parameter,
            ),
        ),
        InjectableFault(
            tr("Delay"),
            tr("Delay all bytes by this time; 0 ends the delay"),
            (
                ChoiceParameter(tr("Fault"), ((tr("delay"), "delay"),)),
                NumberParameter(tr("Delay"), 5.0, 0.0, 1000.0, "ms", "ms", 1),
                direction_parameter,
                line_parameter,
            ),
        ),
        InjectableFault(
            tr("Cable"),
            tr(
                "The line transmits nothing in either direction; held at space, the boards "
                "receive a stop first"
            ),
            (
                ChoiceParameter(
                    tr("Fault"), ((tr("silent"), "silence"), (tr("held at space"), "space"))
                ),
                NumberParameter(tr("Duration"), 2.0, 0.0, 3600.0, "s", "s", 1),
                line_parameter,
            ),
        ),
        InjectableFault(
            tr("Board"),
            tr("A board restarts and loses the positions of its steppers"),
            (
                ChoiceParameter(
                    tr("Fault"), ((tr("reset"), "reset"), (tr("brown-out"), "brown-out"))
                ),
                ChoiceParameter(tr("Board"), board_options),
            ),
        ),
        InjectableFault(
            tr("Sensor"),
            tr("A sensor repeats one reading until released"),
            (
                ChoiceParameter(tr("Fault"), ((tr("freeze"), "freeze"), (tr("release"), "thaw"))),
                _make_axis_parameter(axes),
            ),
        ),
    ]
    if steppers:
        lost_steps = NumberParameter(tr("Microsteps"), 40, 1, 1_000_000)
        step_loss = ChoiceParameter(tr("Fault"), ((tr("lose steps"), "lose"),))
        faults.append(
            InjectableFault(
                tr("Stepper"),
                tr("The stepper falls behind its command"),
                (step_loss, _make_axis_parameter(steppers), lost_steps),
            )
        )
    return tuple(faults)


def _make_axis_parameter(names: tuple[str, ...]) -> ChoiceParameter:
    return ChoiceParameter(tr("Axis"), tuple((name, name) for name in names))
