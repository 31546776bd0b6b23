"""Faults of a virtual board, as commands with parameters. Free of widgets."""

from dataclasses import dataclass

from rotemina.plugins.faults import tr


@dataclass(frozen=True, slots=True)
class Pick:
    """A parameter that is one of some words; each is (what is shown, what is sent)."""

    name: str
    words: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Number:
    """A parameter that is a number with a unit."""

    name: str
    preset: float
    low: float
    high: float
    unit: str = ""
    sent_unit: str = ""  # as the command wants it
    decimals: int = 0

    def word(self, value: float) -> str:
        """Return a value as the command has it."""
        number = f"{value:.{self.decimals}f}"
        return f"{number} {self.sent_unit}".rstrip()


@dataclass(frozen=True, slots=True)
class Fault:
    """One kind of fault; its parameters come in the order in which they are sent."""

    title: str
    meaning: str
    parameters: tuple[Pick | Number, ...]

    def command(self, words: tuple[str, ...]) -> str:
        """Return the line that a virtual board understands."""
        return " ".join(word for word in words if word)


def faults(axes: tuple[str, ...], steppers: tuple[str, ...], lines: int) -> tuple[Fault, ...]:
    """Return the faults of a robot with these axes, behind so many lines; words as shown now."""
    every = (
        (tr("all lines"), ""),
        *((tr("line {n}").format(n=n), f"line {n}") for n in range(1, lines + 1)),
    )
    line = Pick(tr("Line"), every if lines > 1 else every[:1])
    boards = tuple(
        (tr("board {n}").format(n=n), f"{n}") for n in range(1, (len(axes) + 2) // 3 + 1)
    )
    damage = (
        (tr("lose"), "drop"),
        (tr("double"), "double"),
        (tr("corrupt"), "corrupt"),
        (tr("add"), "garbage"),
    )
    towards = Pick(tr("Direction"), ((tr("to board"), "board"), (tr("to program"), "host")))
    made = [
        Fault(
            tr("Bytes"),
            tr("The next bytes are lost, doubled or corrupted by one bit, or extra bytes arrive"),
            (Pick(tr("Fault"), damage), Number(tr("Bytes"), 3, 1, 10_000), towards, line),
        ),
        Fault(
            tr("Delay"),
            tr("Delay all bytes by this time; 0 ends the delay"),
            (
                Pick(tr("Fault"), ((tr("delay"), "delay"),)),
                Number(tr("Delay"), 5.0, 0.0, 1000.0, "ms", "ms", 1),
                towards,
                line,
            ),
        ),
        Fault(
            tr("Cable"),
            tr(
                "The line transmits nothing in either direction; held at space, the boards "
                "receive a stop first"
            ),
            (
                Pick(tr("Fault"), ((tr("silent"), "silence"), (tr("held at space"), "space"))),
                Number(tr("Duration"), 2.0, 0.0, 3600.0, "s", "s", 1),
                line,
            ),
        ),
        Fault(
            tr("Board"),
            tr("A board restarts and loses the positions of its steppers"),
            (
                Pick(tr("Fault"), ((tr("reset"), "reset"), (tr("brown-out"), "brown-out"))),
                Pick(tr("Board"), boards),
            ),
        ),
        Fault(
            tr("Sensor"),
            tr("A sensor repeats one reading until released"),
            (Pick(tr("Fault"), ((tr("freeze"), "freeze"), (tr("release"), "thaw"))), _axes(axes)),
        ),
    ]
    if steppers:
        lost = Number(tr("Microsteps"), 40, 1, 1_000_000)
        what = Pick(tr("Fault"), ((tr("lose steps"), "lose"),))
        made.append(
            Fault(
                tr("Stepper"),
                tr("The stepper falls behind its command"),
                (what, _axes(steppers), lost),
            )
        )
    return tuple(made)


def _axes(names: tuple[str, ...]) -> Pick:
    return Pick(tr("Axis"), tuple((name, name) for name in names))
