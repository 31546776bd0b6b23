"""Display of effect parameters: units, digits, slider positions; no widgets."""

import math
from dataclasses import dataclass

from rotemina.plugins.effects import tr
from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import Parameter
from rotemina.sim.quantities import parsed, rounded, scale_of

SLIDER_STEPS = 1000

_RATES = ("", "/s", "/s²", "/√s")  # behind a unit of position, these leave it free to be chosen
_DIGITS = 6
_SLIDER_DIGITS = 4
_BEND_WITHOUT_PRESET = 2.0  # where the preset is nothing


class ValueRefusedError(ValueError):
    """A typed value that is no number, or out of bounds; the text says which."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """One parameter on one axis, as screens show it.

    Attributes
    ----------
    meaning, unit : str
        ``unit`` is what is shown, such as ``µrad``.
    per_si : float
        How many of it make one SI unit.
    low, high, preset : float
        SI; ``low`` and ``high`` may be infinite.
    """

    meaning: str
    unit: str
    per_si: float
    low: float
    high: float
    preset: float

    @classmethod
    def of(cls, parameter: Parameter, facts: Facts, source_unit: str = "") -> "Quantity":
        """Choose the unit of a parameter by its preset; ``source_unit`` is that of `from_axis`."""
        low, high = parameter.bounds(facts)
        preset = parameter.preset(facts)
        size = abs(preset) or _largest(low, high)
        unit, factor = _shown_unit(parameter.unit_on(facts), size, source_unit)
        return cls(parameter.meaning, unit, factor, low, high, preset)

    @property
    def bounded(self) -> bool:
        """Whether a slider can show it."""
        return math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high

    def number(self, value: float) -> str:
        """Return a value (SI) as digits, without its unit."""
        return rounded(value * self.per_si, _DIGITS)

    def text(self, value: float) -> str:
        """Return a value (SI) with its unit."""
        return f"{self.number(value)} {self.unit}".rstrip()

    @property
    def range_text(self) -> str:
        """Bounds as a sentence has them."""
        if math.isinf(self.high):
            return tr("at least {low}").format(low=self.text(self.low))
        text = tr("between {low} and {high}")
        return text.format(low=self.number(self.low), high=self.text(self.high))

    def value(self, text: str) -> float:
        """Return the value (SI) that a text with the shown unit means.

        Raises
        ------
        ValueRefusedError
            If it is no plain number, or out of bounds.
        """
        number = parsed(text)
        if number is None:
            told = tr("{text} is not a number; enter one with a decimal point")
            if self.unit:
                told = tr("{text} is not a number; enter one in {unit} with a decimal point")
            raise ValueRefusedError(told.format(text=repr(text), unit=self.unit))
        value = self._snapped(number / self.per_si)
        if not self.low <= value <= self.high or math.isinf(value):
            typed = f"{text.strip()} {self.unit}".rstrip()
            told = tr("{value} must be {range}")
            raise ValueRefusedError(told.format(value=typed, range=self.range_text))
        return value

    # --- slider -----------------------------------------------------------------------------------

    # A slider bends so that the preset is half way to its end, where it can be tuned finely. One
    # that passes zero has zero in its middle.

    def place(self, value: float) -> int:
        """Return where a value (SI) is on a slider of ``SLIDER_STEPS``."""
        zero, end = self._reach(value >= self._zero)
        share = min(max((value - zero) / (end - zero), 0.0), 1.0) ** (1.0 / self._bend)
        if zero == self.low:
            return round(SLIDER_STEPS * share)
        return round(SLIDER_STEPS * 0.5 * (1.0 + math.copysign(share, end)))

    def at(self, place: int) -> float:
        """Return the value (SI) at a place of the slider, in few digits."""
        way = place / SLIDER_STEPS
        if self._zero != self.low:
            way = 2.0 * way - 1.0
        zero, end = self._reach(way >= 0.0)
        value = zero + (end - zero) * abs(way) ** self._bend
        rounded = float(f"{value * self.per_si:.{_SLIDER_DIGITS}g}") / self.per_si
        return min(max(rounded, self.low), self.high)

    @property
    def _zero(self) -> float:
        return 0.0 if self.low < 0.0 < self.high else self.low

    def _reach(self, upward: bool) -> tuple[float, float]:
        """Return where a side of the slider begins, and its end."""
        return self._zero, self.high if upward else self.low

    @property
    def _bend(self) -> float:
        zero, end = self._reach(self.preset >= self._zero)
        share = (self.preset - zero) / (end - zero)
        if share == 0.0:
            return _BEND_WITHOUT_PRESET
        return max(math.log(share) / math.log(0.5), 1.0) if share < 1.0 else 1.0

    def _snapped(self, value: float) -> float:
        """Return the bound itself where a value was typed as the bound is shown."""
        for bound in (self.low, self.high):
            if math.isfinite(bound) and self.number(value) == self.number(bound):
                return bound
        return value


def _largest(low: float, high: float) -> float:
    return max((abs(bound) for bound in (low, high) if math.isfinite(bound)), default=0.0)


def _shown_unit(unit: str, size: float, source_unit: str) -> tuple[str, float]:
    """Return the unit in which a value of this size reads well, and how many make one SI unit."""
    head, slash, rest = unit.partition("/")
    if unit == "s" or (head in ("m", "rad") and slash + rest in _RATES):
        shown = scale_of(unit, size)
        return shown.symbol, shown.per_si
    if unit.endswith("/…"):
        head = unit.removesuffix("/…")
        return ("" if head == source_unit else f"{head}/{source_unit}"), 1.0
    return unit, 1.0
