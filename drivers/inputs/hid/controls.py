"""Meaning of a report's bits for the operator: deflections, hats, and held buttons.

``take`` notes the value of a control and returns whether it is one that the descriptor allows.
"""

from dataclasses import dataclass
from math import cos, nan, pi, sin

from rotemina.drivers.inputs.hid.descriptor import Field

_MOST_DIRECTIONS = 360  # some hats count degrees; one that counts more is damaged


@dataclass(frozen=True, slots=True)
class Bits:
    """The bit position of a number in a report."""

    shift: int
    mask: int
    sign: int  # the bit that makes it negative; 0 where it never is

    @classmethod
    def of(cls, field: Field, place: int = 0) -> "Bits":
        """Return the bits of a field, or of one item of a list."""
        sign = 1 << field.size - 1 if field.low < 0 else 0
        return cls(field.offset + place * field.size, (1 << field.size) - 1, sign)

    @property
    def end(self) -> int:
        """The first bit behind."""
        return self.shift + self.mask.bit_length()

    def read(self, report: int) -> int:
        """Return the number."""
        value = report >> self.shift & self.mask
        return value - self.mask - 1 if value & self.sign else value


@dataclass(frozen=True, slots=True)
class Deflection:
    """An axis from −1 at ``low`` to 1 at ``high``; beyond, it is nowhere.

    One count beyond is the end: many declare −127 to 127 and send −128. With ``has_null`` any value
    beyond says that there is none, and is allowed.
    """

    bits: Bits
    axis: int
    low: int
    high: int
    has_null: bool

    def take(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Note the value of the axis."""
        value = self.bits.read(report)
        nearest = min(max(value, self.low), self.high)
        if abs(value - nearest) > (0 if self.has_null else 1):
            axes[self.axis] = nan
            return self.has_null
        axes[self.axis] = 2.0 * (nearest - self.low) / (self.high - self.low) - 1.0
        return True


@dataclass(frozen=True, slots=True)
class Hat:
    """A hat whose value counts its directions clockwise from "away"; any other: at rest."""

    bits: Bits
    axis: int  # its first axis, to the right; the second, towards the operator, follows
    low: int
    directions: tuple[tuple[float, float], ...]

    @classmethod
    def of(cls, field: Field, axis: int) -> "Hat":
        """Return the hat of a field; as on a stick, away is −1."""
        count = max(0, min(field.high - field.low + 1, _MOST_DIRECTIONS))
        angles = [2.0 * pi * index / count for index in range(count)]
        directions = tuple(
            (float(round(sin(angle))), float(round(-cos(angle)))) for angle in angles
        )
        return cls(Bits.of(field), axis, field.low, directions)

    def take(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Note where the hat points."""
        index = self.bits.read(report) - self.low
        right, towards = self.directions[index] if 0 <= index < len(self.directions) else (0.0, 0.0)
        axes[self.axis], axes[self.axis + 1] = right, towards
        return True


@dataclass(frozen=True, slots=True)
class Button:
    """A button with a bit, or a pressure, of its own: held from ``least`` on."""

    bits: Bits
    button: int
    least: int

    @classmethod
    def of(cls, field: Field, button: int) -> "Button":
        """Return the button of a field; one with pressure counts as held from mid-range on."""
        # Many a descriptor forgets to say again that a bit is at most 1.
        high = min(field.high, (1 << field.size) - 1)
        least = (field.low + high) // 2 + 1 if high > field.low else 1
        return cls(Bits.of(field), button, least)

    def take(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Note whether it is held."""
        buttons[self.button] = self.bits.read(report) >= self.least
        return True


@dataclass(frozen=True, slots=True)
class Buttons:
    """Buttons that a report lists by number: places with the number of one that is held each."""

    places: tuple[Bits, ...]
    low: int
    chosen: tuple[int | None, ...]  # which button a value means, from ``low`` on

    @classmethod
    def of(cls, field: Field, chosen: tuple[int | None, ...]) -> "Buttons":
        """Return the buttons of a field."""
        places = tuple(Bits.of(field, place) for place in range(field.count))
        return cls(places, field.low, chosen)

    @property
    def bits(self) -> Bits:
        """The last place."""
        return self.places[-1]

    def take(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Note which are held: those that are listed, and no other."""
        for button in self.chosen:
            if button is not None:
                buttons[button] = False
        for place in self.places:
            index = place.read(report) - self.low
            if 0 <= index < len(self.chosen) and (button := self.chosen[index]) is not None:
                buttons[button] = True
        return True


Control = Deflection | Hat | Button | Buttons
