"""Fields of a scale: names, units, text, and refusals."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import NamedTuple

from pydantic import TypeAdapter, ValidationError

from rotemina.app.motion.teleoperation.frames import Coordinate
from rotemina.app.motion.teleoperation.reference import ScalingError
from rotemina.app.motion.teleoperation.scales import LawKind, Scale, Scales
from rotemina.plugins.teleoperation import mark, tr
from rotemina.sim.quantities import exact, parsed, rounded
from rotemina.sim.units import per_si, symbol

_TABLE_M = 1e-4  # what has a longer way reads better in mm
_BOUNDS = {
    "gt": mark("above {bound}"),
    "ge": mark("at least {bound}"),
    "lt": mark("below {bound}"),
    "le": mark("at most {bound}"),
}


class ScaleField(NamedTuple):
    """One number of a scale: its name in :class:`Scale`, its title, its unit, what it means.

    ``unit`` is that of the screen; ``way`` and ``speed`` follow from the coordinate.
    """

    name: str
    title: str
    unit: str
    tip: str

    @property
    def shown_title(self) -> str:
        """The title in the language in use."""
        return tr(self.title)

    @property
    def shown_tip(self) -> str:
        """What it means, in the language in use."""
        return tr(self.tip)


FIELDS = (
    ScaleField(
        "way", mark("Distance at full stick"), "way", mark("Position, and impedance with a spring")
    ),
    ScaleField(
        "speed", mark("Speed at full stick"), "speed", mark("Rate, and impedance without a spring")
    ),
    ScaleField(
        "time_constant_s",
        mark("Time constant"),
        "s",
        mark("Impedance without a spring: time in which the virtual mass reaches its speed"),
    ),
    ScaleField(
        "spring_hz",
        mark("Spring frequency"),
        "Hz",
        mark("Impedance: frequency of the virtual mass; 0: no spring, the mass glides"),
    ),
    ScaleField(
        "damping_ratio",
        mark("Damping ratio"),
        "",
        mark("Impedance with a spring: overshoots below 1, creeps above 1"),
    ),
    ScaleField(
        "contact_gain",
        mark("Contact gain"),
        "%",
        mark("Impedance: contact force relative to the largest safe force; 0: none"),
    ),
)
_BY_NAME = {field.name: field for field in FIELDS}


class Shown(NamedTuple):
    """How a field's numbers are shown: the unit, and how many of it make one SI unit."""

    unit: str
    factor: float

    def number(self, value: float) -> str:
        """Return a value (SI) as digits."""
        return rounded(value * self.factor, 6)

    def text(self, value: float) -> str:
        """Return a value (SI) with its unit."""
        return f"{self.number(value)} {self.unit}".rstrip()


def shown(field: ScaleField, coordinate: Coordinate) -> Shown:
    """Return how a field of a coordinate is shown."""
    if field.unit not in ("way", "speed"):
        return Shown(field.unit, 100.0 if field.unit == "%" else 1.0)
    unit = "urad"
    if coordinate.unit == "m":
        unit = "mm" if Scale.preset(coordinate).way > _TABLE_M else "um"
    return Shown(symbol(unit) + ("/s" if field.unit == "speed" else ""), per_si(unit))


def bounds_text(field: ScaleField, coordinate: Coordinate) -> str:
    """Return what a field of a coordinate may hold, with its unit."""
    unit, bounds = shown(field, coordinate), coordinate.bounds
    if field.name == "way":
        return tr("above 0, up to {most}").format(most=unit.text(bounds.high - bounds.low))
    if field.name == "speed":
        return tr("above 0, up to {most}").format(most=unit.text(bounds.max_speed))
    kept = _checked()[field.name]
    return tr("{least} to {most}").format(
        least=unit.number(kept["minimum"]), most=unit.text(kept["maximum"])
    )


@cache
def _checked() -> dict[str, dict[str, float]]:
    """Return what :class:`Scale` itself checks of each number, by JSON schema's words."""
    properties: dict[str, dict[str, float]] = TypeAdapter(Scale).json_schema()["properties"]
    return properties


def changed(scale: Scale, name: str, text: str, coordinate: Coordinate) -> Scale:
    """Return a scale of a coordinate with one field as it was typed.

    Raises
    ------
    ScalingError
        With the field, what was typed, and its bound.
    """
    field = _BY_NAME[name]
    unit = shown(field, coordinate)
    title = tr("{title} of {name}").format(title=field.shown_title, name=coordinate.name)
    text = text.strip()
    number = parsed(text)
    if number is None:
        unit_text = f" in {unit.unit}" if unit.unit else ""
        raise ScalingError(
            tr("{title}: {text!r} is not a number; enter one{unit} with a decimal point").format(
                title=title, text=text, unit=unit_text
            )
        )
    value = number / unit.factor
    if unit.number(value) == unit.number(getattr(scale, name)):
        return scale  # what is shown has fewer digits than what is meant
    typed = f"{title}: {text} {unit.unit}".rstrip()
    _check_reach(typed, name, value, coordinate)
    try:
        made = replace(scale, **{name: value})
    except ValidationError as error:
        raise ScalingError(
            tr("{typed}: must be {bound}").format(typed=typed, bound=_bound(error, unit))
        ) from error
    for kind in LawKind:
        made.law(kind, coordinate, 0.0)
    return made


def without(scales: Scales, mode: str) -> Scales:
    """Return scales with the presets of one mode."""
    return Scales(modes={name: kept for name, kept in scales.modes.items() if name != mode})


def texts(scale: Scale, coordinate: Coordinate) -> Mapping[str, str]:
    """Return the text of each field."""
    return {
        field.name: shown(field, coordinate).number(getattr(scale, field.name)) for field in FIELDS
    }


def _check_reach(typed: str, name: str, value: float, coordinate: Coordinate) -> None:
    """Refuse what is more than the coordinate has."""
    bounds, unit = coordinate.bounds, coordinate.unit
    if name == "way" and value > bounds.high - bounds.low:
        most = exact(bounds.high - bounds.low, unit)
        raise ScalingError(
            tr("{typed}: must be at most the range of {most}").format(typed=typed, most=most)
        )
    if name == "speed" and value > bounds.max_speed:
        most = exact(bounds.max_speed, f"{unit}/s")
        raise ScalingError(
            tr("{typed}: must be at most the maximum speed of {most}").format(
                typed=typed, most=most
            )
        )


def _bound(error: ValidationError, unit: Shown) -> str:
    context = error.errors(include_url=False)[0].get("ctx", {})
    told = (
        tr(text).format(bound=unit.text(context[key]))
        for key, text in _BOUNDS.items()
        if key in context
    )
    return next(told, tr("a finite number"))
