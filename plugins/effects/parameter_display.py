"""Display of effect parameters: units, digits and slider positions. Does not use Qt."""

import math
from dataclasses import dataclass

from rotemina.plugins.effects import tr
from rotemina.sim.effects import AxisProperties, EffectParameter
from rotemina.sim.messages import format_rounded, parse_number
from rotemina.sim.units import choose_scale

SLIDER_STEPS = 1000

# A unit of position may get a prefix, such as µ, if one of these follows it.
_SCALABLE_SUFFIXES = ("", "/s", "/s²", "/√s")

_TEXT_DIGITS = 6
_SLIDER_DIGITS = 4

# Exponent of the slider's power law if the preset is at the zero of the slider.
_DEFAULT_EXPONENT = 2.0


class ValueRefusedError(ValueError):
    """The typed text is not a number, or the value is out of bounds. The message says which."""


@dataclass(frozen=True, slots=True)
class DisplayedParameter:
    """Parameter of an effect on one axis, as shown to the operator.

    Attributes
    ----------
    meaning, unit : str
        Meaning of the parameter, and the unit that is shown, such as ``µrad``.
    per_si : float
        Number of shown units per SI unit.
    low, high, preset : float
        Bounds and preset, in SI units. The bounds may be infinite.
    """

    meaning: str
    unit: str
    per_si: float
    low: float
    high: float
    preset: float

    @classmethod
    def from_parameter(
        cls, parameter: EffectParameter, facts: AxisProperties, source_unit: str = ""
    ) -> "DisplayedParameter":
        """Choose a unit that suits the preset of a parameter.

        ``source_unit`` is the unit of the axis in which a coupled effect originates.
        """
        low, high = parameter.bounds(facts)
        preset = parameter.preset(facts)
        magnitude = abs(preset) or _find_largest_magnitude(low, high)
        unit, per_si = _choose_unit(parameter.unit_on(facts), magnitude, source_unit)
        return cls(parameter.meaning, unit, per_si, low, high, preset)

    @property
    def bounded(self) -> bool:
        """Whether both bounds are finite, so that a slider can show the value."""
        return math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high

    def format_number(self, value: float) -> str:
        """Return a value (SI) as text without unit."""
        return format_rounded(value * self.per_si, _TEXT_DIGITS)

    def format_value(self, value: float) -> str:
        """Return a value (SI) as text with unit."""
        return f"{self.format_number(value)} {self.unit}".rstrip()

    @property
    def range_text(self) -> str:
        """The bounds as a phrase, such as "at least 0 µm"."""
        if math.isinf(self.high):
            return tr("at least {low}").format(low=self.format_value(self.low))
        text = tr("between {low} and {high}")
        return text.format(low=self.format_number(self.low), high=self.format_value(self.high))

    def parse_value(self, text: str) -> float:
        """Return the value (SI) of a text that gives it in the shown unit.

        Raises
        ------
        ValueRefusedError
            If the text is not a number, or the value is out of bounds.
        """
        number = parse_number(text)
        if number is None:
            text_of_error = tr("{text} is not a number; enter one with a decimal point")
            if self.unit:
                text_of_error = tr(
                    "{text} is not a number; enter one in {unit} with a decimal point"
                )
            raise ValueRefusedError(text_of_error.format(text=repr(text), unit=self.unit))
        value = self._snap_to_bound(number / self.per_si)
        if not self.low <= value <= self.high or math.isinf(value):
            typed = f"{text.strip()} {self.unit}".rstrip()
            text_of_error = tr("{value} must be {range}")
            raise ValueRefusedError(text_of_error.format(value=typed, range=self.range_text))
        return value

    # The value follows a power law of the slider position. The preset is half-way between zero and
    # the end, so that values near it can be adjusted finely. If the range includes negative and
    # positive values, zero is in the middle of the slider.

    def to_slider(self, value: float) -> int:
        """Return the position of a value (SI) on a slider of ``SLIDER_STEPS``."""
        zero, end = self._find_side(value >= self._zero)
        fraction = min(max((value - zero) / (end - zero), 0.0), 1.0) ** (1.0 / self._exponent)
        if zero == self.low:
            return round(SLIDER_STEPS * fraction)
        return round(SLIDER_STEPS * 0.5 * (1.0 + math.copysign(fraction, end)))

    def from_slider(self, slider_value: int) -> float:
        """Return the value (SI) at a position of the slider, rounded to a few digits."""
        position = slider_value / SLIDER_STEPS
        if self._zero != self.low:
            position = 2.0 * position - 1.0
        zero, end = self._find_side(position >= 0.0)
        value = zero + (end - zero) * abs(position) ** self._exponent
        rounded = float(f"{value * self.per_si:.{_SLIDER_DIGITS}g}") / self.per_si
        return min(max(rounded, self.low), self.high)

    @property
    def _zero(self) -> float:
        """The value from which the power law starts: 0, or the low bound if 0 is not inside."""
        return 0.0 if self.low < 0.0 < self.high else self.low

    def _find_side(self, upward: bool) -> tuple[float, float]:
        """Return the values (SI) at the zero and at the end of one side of the slider."""
        return self._zero, self.high if upward else self.low

    @property
    def _exponent(self) -> float:
        """The exponent of the power law, at least 1."""
        zero, end = self._find_side(self.preset >= self._zero)
        fraction = (self.preset - zero) / (end - zero)
        if fraction == 0.0:
            return _DEFAULT_EXPONENT
        return max(math.log(fraction) / math.log(0.5), 1.0) if fraction < 1.0 else 1.0

    def _snap_to_bound(self, value: float) -> float:
        """Return the exact bound if the value and the bound are displayed alike."""
        for bound in (self.low, self.high):
            if math.isfinite(bound) and self.format_number(value) == self.format_number(bound):
                return bound
        return value


def _find_largest_magnitude(low: float, high: float) -> float:
    return max((abs(bound) for bound in (low, high) if math.isfinite(bound)), default=0.0)


def _choose_unit(unit: str, magnitude: float, source_unit: str) -> tuple[str, float]:
    """Return a unit that suits a value of this magnitude (SI), and its number per SI unit.

    A ``unit`` such as ``m/…`` stands for a quotient with the unit of the source axis.
    """
    base_unit, slash, rest = unit.partition("/")
    if unit == "s" or (base_unit in ("m", "rad") and slash + rest in _SCALABLE_SUFFIXES):
        scale = choose_scale(unit, magnitude)
        return scale.symbol, scale.per_si
    if unit.endswith("/…"):
        base_unit = unit.removesuffix("/…")
        return ("" if base_unit == source_unit else f"{base_unit}/{source_unit}"), 1.0
    return unit, 1.0
