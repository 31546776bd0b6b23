"""Faults that a virtual board can be given, as commands with parameters. Free of Qt."""

from dataclasses import dataclass


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


_TOWARDS = Pick("Direction", (("to board", "board"), ("to program", "host")))


def faults(axes: tuple[str, ...], steppers: tuple[str, ...], lines: int) -> tuple[Fault, ...]:
    """Return the faults of a robot with these axes, behind so many lines."""
    every = (("all lines", ""), *((f"line {n}", f"line {n}") for n in range(1, lines + 1)))
    line = Pick("Line", every if lines > 1 else every[:1])
    boards = tuple((f"board {n}", f"{n}") for n in range(1, (len(axes) + 2) // 3 + 1))
    damage = (("lose", "drop"), ("double", "double"), ("corrupt", "corrupt"), ("add", "garbage"))
    made = [
        Fault(
            "Bytes",
            "The next bytes are lost, come twice, or with a wrong bit; or some that nobody sent",
            (Pick("What", damage), Number("Bytes", 3, 1, 10_000), _TOWARDS, line),
        ),
        Fault(
            "Delay",
            "From now on bytes come this much later; 0 ends it",
            (
                Pick("What", (("delay", "delay"),)),
                Number("Delay", 5.0, 0.0, 1000.0, "ms", "ms", 1),
                _TOWARDS,
                line,
            ),
        ),
        Fault(
            "Cable",
            "Nothing comes through, both ways; torn off, the boards hear a zero as well",
            (
                Pick("What", (("silent", "silence"), ("torn off", "tear"))),
                Number("Duration", 2.0, 0.0, 3600.0, "s", "s", 1),
                line,
            ),
        ),
        Fault(
            "Board",
            "A board begins anew; it does not know where its steppers are",
            (
                Pick("What", (("reset", "reset"), ("brown-out", "brown-out"))),
                Pick("Board", boards),
            ),
        ),
        Fault(
            "Sensor",
            "A sensor says the same until it is thawed",
            (Pick("What", (("freeze", "freeze"), ("thaw", "thaw"))), _axes(axes)),
        ),
    ]
    if steppers:
        lost = Number("Microsteps", 40, 1, 1_000_000)
        what = Pick("What", (("lose steps", "lose"),))
        made.append(Fault("Stepper", "It stays behind its command", (what, _axes(steppers), lost)))
    return tuple(made)


def _axes(names: tuple[str, ...]) -> Pick:
    return Pick("Axis", tuple((name, name) for name in names))
