"""Faults of a virtual board, as commands with parameters. Free of widgets."""

from dataclasses import dataclass

from rotemina.app.shell.language import translate


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
        (translate("faults", "all lines"), ""),
        *((translate("faults", "line {n}").format(n=n), f"line {n}") for n in range(1, lines + 1)),
    )
    line = Pick(translate("faults", "Line"), every if lines > 1 else every[:1])
    boards = tuple(
        (translate("faults", "board {n}").format(n=n), f"{n}")
        for n in range(1, (len(axes) + 2) // 3 + 1)
    )
    damage = (
        (translate("faults", "lose"), "drop"),
        (translate("faults", "double"), "double"),
        (translate("faults", "corrupt"), "corrupt"),
        (translate("faults", "add"), "garbage"),
    )
    towards = Pick(
        translate("faults", "Direction"),
        ((translate("faults", "to board"), "board"), (translate("faults", "to program"), "host")),
    )
    made = [
        Fault(
            translate("faults", "Bytes"),
            translate(
                "faults",
                "The next bytes are lost, doubled or corrupted by one bit, or extra bytes arrive",
            ),
            (
                Pick(translate("faults", "Fault"), damage),
                Number(translate("faults", "Bytes"), 3, 1, 10_000),
                towards,
                line,
            ),
        ),
        Fault(
            translate("faults", "Delay"),
            translate("faults", "Delay all bytes by this time; 0 ends the delay"),
            (
                Pick(translate("faults", "Fault"), ((translate("faults", "delay"), "delay"),)),
                Number(translate("faults", "Delay"), 5.0, 0.0, 1000.0, "ms", "ms", 1),
                towards,
                line,
            ),
        ),
        Fault(
            translate("faults", "Cable"),
            translate(
                "faults",
                "The line transmits nothing in either direction; held at space, the boards "
                "receive a stop first",
            ),
            (
                Pick(
                    translate("faults", "Fault"),
                    (
                        (translate("faults", "silent"), "silence"),
                        (translate("faults", "held at space"), "space"),
                    ),
                ),
                Number(translate("faults", "Duration"), 2.0, 0.0, 3600.0, "s", "s", 1),
                line,
            ),
        ),
        Fault(
            translate("faults", "Board"),
            translate("faults", "A board restarts and loses the positions of its steppers"),
            (
                Pick(
                    translate("faults", "Fault"),
                    (
                        (translate("faults", "reset"), "reset"),
                        (translate("faults", "brown-out"), "brown-out"),
                    ),
                ),
                Pick(translate("faults", "Board"), boards),
            ),
        ),
        Fault(
            translate("faults", "Sensor"),
            translate("faults", "A sensor repeats one reading until released"),
            (
                Pick(
                    translate("faults", "Fault"),
                    (
                        (translate("faults", "freeze"), "freeze"),
                        (translate("faults", "release"), "thaw"),
                    ),
                ),
                _axes(axes),
            ),
        ),
    ]
    if steppers:
        lost = Number(translate("faults", "Microsteps"), 40, 1, 1_000_000)
        what = Pick(translate("faults", "Fault"), ((translate("faults", "lose steps"), "lose"),))
        made.append(
            Fault(
                translate("faults", "Stepper"),
                translate("faults", "The stepper falls behind its command"),
                (what, _axes(steppers), lost),
            )
        )
    return tuple(made)


def _axes(names: tuple[str, ...]) -> Pick:
    return Pick(translate("faults", "Axis"), tuple((name, name) for name in names))
