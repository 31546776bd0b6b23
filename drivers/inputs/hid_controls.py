"""Controls of a device, which decode deflections, hats and buttons from the bits of a report.

``update`` stores the value of a control from a report, and returns whether the descriptor permits
this value.
"""

from dataclasses import dataclass
from math import cos, nan, pi, sin

from rotemina.drivers.inputs.hid_descriptor import ReportField

# Some hats report degrees. More directions mean that the descriptor is damaged.
_MAX_HAT_DIRECTIONS = 360


@dataclass(frozen=True, slots=True)
class BitField:
    """The position of a number in the bits of a report."""

    shift: int
    mask: int
    #: Mask of the sign bit; 0 if the number is never negative.
    sign: int

    @classmethod
    def of(cls, field: ReportField, place: int = 0) -> "BitField":
        """Return the bits of a field, or of one place in a list field."""
        sign = 1 << field.size - 1 if field.low < 0 else 0
        return cls(field.offset + place * field.size, (1 << field.size) - 1, sign)

    @property
    def end(self) -> int:
        """Index of the first bit after the number."""
        return self.shift + self.mask.bit_length()

    def read(self, report: int) -> int:
        """Read the number from a report."""
        value = report >> self.shift & self.mask
        return value - self.mask - 1 if value & self.sign else value


@dataclass(frozen=True, slots=True)
class AxisControl:
    """An axis, whose value is −1 at ``low``, 1 at ``high``, and NaN outside this range.

    A value that is out of range by one count is clipped, because many devices declare −127 to 127
    and send −128. With ``has_null`` a value out of range is permitted and means "no value".
    """

    bits: BitField
    axis: int
    low: int
    high: int
    has_null: bool

    def update(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Store the value of the axis."""
        value = self.bits.read(report)
        clipped_value = min(max(value, self.low), self.high)
        if abs(value - clipped_value) > (0 if self.has_null else 1):
            axes[self.axis] = nan
            return self.has_null
        axes[self.axis] = 2.0 * (clipped_value - self.low) / (self.high - self.low) - 1.0
        return True


@dataclass(frozen=True, slots=True)
class HatControl:
    """A hat, whose value counts directions clockwise from "forward"; other values mean "at rest".

    "Forward" is away from the operator.
    """

    bits: BitField
    #: Index of the left-right axis; the next index is the forward-backward axis.
    axis: int
    low: int
    directions: tuple[tuple[float, float], ...]

    @classmethod
    def of(cls, field: ReportField, axis: int) -> "HatControl":
        """Return the hat of a field. As for a stick, "right" is 1 and "forward" is −1."""
        direction_count = max(0, min(field.high - field.low + 1, _MAX_HAT_DIRECTIONS))
        angles = [2.0 * pi * index / direction_count for index in range(direction_count)]
        directions = tuple(
            (float(round(sin(angle))), float(round(-cos(angle)))) for angle in angles
        )
        return cls(BitField.of(field), axis, field.low, directions)

    def update(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Store the direction of the hat."""
        index = self.bits.read(report) - self.low
        is_direction = 0 <= index < len(self.directions)
        right, backward = self.directions[index] if is_direction else (0.0, 0.0)
        axes[self.axis], axes[self.axis + 1] = right, backward
        return True


@dataclass(frozen=True, slots=True)
class ButtonControl:
    """A button with its own bit or pressure value. It is held at or above ``threshold``."""

    bits: BitField
    button: int
    threshold: int

    @classmethod
    def of(cls, field: ReportField, button: int) -> "ButtonControl":
        """Return the button of a field. A button with pressure is held above mid-range."""
        # Many descriptors declare too large a maximum for a button of one bit.
        high = min(field.high, (1 << field.size) - 1)
        threshold = (field.low + high) // 2 + 1 if high > field.low else 1
        return cls(BitField.of(field), button, threshold)

    def update(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Store whether the button is held."""
        buttons[self.button] = self.bits.read(report) >= self.threshold
        return True


@dataclass(frozen=True, slots=True)
class ButtonListControl:
    """A list of the buttons that are held: each place contains the number of one button."""

    places: tuple[BitField, ...]
    low: int
    #: Index of the button for each value from ``low`` on; None if the value is not a button.
    buttons: tuple[int | None, ...]

    @classmethod
    def of(cls, field: ReportField, buttons: tuple[int | None, ...]) -> "ButtonListControl":
        """Return the button list of a field; ``buttons`` as in the attribute."""
        places = tuple(BitField.of(field, place) for place in range(field.count))
        return cls(places, field.low, buttons)

    @property
    def bits(self) -> BitField:
        """The bits of the last place."""
        return self.places[-1]

    def update(self, report: int, axes: list[float], buttons: list[bool]) -> bool:
        """Store which buttons are held; those that are not listed are released."""
        for button in self.buttons:
            if button is not None:
                buttons[button] = False
        for place in self.places:
            index = place.read(report) - self.low
            if 0 <= index < len(self.buttons) and (button := self.buttons[index]) is not None:
                buttons[button] = True
        return True


Control = AxisControl | HatControl | ButtonControl | ButtonListControl
