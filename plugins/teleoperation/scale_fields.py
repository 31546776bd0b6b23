"""Input fields of a coordinate scale: names, units, texts and checks."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import NamedTuple

from pydantic import TypeAdapter, ValidationError

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation import CoordinateScale, FrameCoordinate, LawKind, ModeScales
from rotemina.plugins.teleoperation import mark, tr
from rotemina.sim.messages import format_rounded, parse_number
from rotemina.sim.units import display_symbol_of, format_exact, per_si

# Longer distances are displayed in mm instead of µm.
_MICROMETRE_DISPLAY_LIMIT_M = 1e-4
_BOUND_TEXTS = {
    "gt": mark("above {bound}"),
    "ge": mark("at least {bound}"),
    "lt": mark("below {bound}"),
    "le": mark("at most {bound}"),
}


class ScaleField(NamedTuple):
    """Input field for one attribute of a :class:`CoordinateScale`.

    ``name`` is the name of the attribute. ``unit`` is the unit on the screen, or None if it depends
    on the coordinate. ``tip`` says what the value means, and which laws use it.
    """

    name: str
    title: str
    unit: str | None
    tip: str

    @property
    def shown_title(self) -> str:
        """The title in the language in use."""
        return tr(self.title)

    @property
    def shown_tip(self) -> str:
        """The tip in the language in use."""
        return tr(self.tip)


FIELDS = (
    ScaleField(
        "way", mark("Distance at full stick"), None, mark("Position, and impedance with a spring")
    ),
    ScaleField(
        "speed", mark("Speed at full stick"), None, mark("Rate, and impedance without a spring")
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
        mark("Impedance: gain of the contact force, in percent of the highest safe gain; 0: none"),
    ),
)
_FIELDS_BY_NAME = {field.name: field for field in FIELDS}


class FieldUnit(NamedTuple):
    """Screen unit of a field, and the number of screen units in one SI unit."""

    unit: str
    factor: float

    def format_number(self, value: float) -> str:
        """Return a value (SI) as digits."""
        return format_rounded(value * self.factor, 6)

    def format_value(self, value: float) -> str:
        """Return a value (SI) with its unit."""
        return f"{self.format_number(value)} {self.unit}".rstrip()


def find_field_unit(field: ScaleField, coordinate: FrameCoordinate) -> FieldUnit:
    """Return the screen unit of a field for a coordinate."""
    if field.unit is not None:
        return FieldUnit(field.unit, 100.0 if field.unit == "%" else 1.0)
    unit = "urad"
    if coordinate.unit == "m":
        unit = (
            "mm"
            if CoordinateScale.make_preset(coordinate).way > _MICROMETRE_DISPLAY_LIMIT_M
            else "um"
        )
    return FieldUnit(
        display_symbol_of(unit) + ("/s" if field.name == "speed" else ""), per_si(unit)
    )


def format_bounds(field: ScaleField, coordinate: FrameCoordinate) -> str:
    """Return the permitted range of a field for a coordinate, with its unit."""
    unit, bounds = find_field_unit(field, coordinate), coordinate.bounds
    if field.name == "way":
        return tr("above 0, up to {most}").format(most=unit.format_value(bounds.high - bounds.low))
    if field.name == "speed":
        return tr("above 0, up to {most}").format(most=unit.format_value(bounds.max_speed))
    schema = _read_schema()[field.name]
    return tr("{least} to {most}").format(
        least=unit.format_number(schema["minimum"]), most=unit.format_value(schema["maximum"])
    )


@cache
def _read_schema() -> dict[str, dict[str, float]]:
    """Return the JSON schema of each attribute of :class:`CoordinateScale`, with its bounds."""
    properties: dict[str, dict[str, float]] = TypeAdapter(CoordinateScale).json_schema()[
        "properties"
    ]
    return properties


def with_entered_value(
    scale: CoordinateScale, name: str, text: str, coordinate: FrameCoordinate
) -> CoordinateScale:
    """Return a scale of a coordinate in which one attribute has the value that was entered.

    Raises
    ------
    ScalingError
        If the text is not a number, or the number is out of bounds.
    """
    field = _FIELDS_BY_NAME[name]
    unit = find_field_unit(field, coordinate)
    title = tr("{title} of {name}").format(title=field.shown_title, name=coordinate.name)
    text = text.strip()
    number = parse_number(text)
    if number is None:
        unit_text = f" in {unit.unit}" if unit.unit else ""
        raise ScalingError(
            tr("{title}: {text!r} is not a number; enter one{unit} with a decimal point").format(
                title=title, text=text, unit=unit_text
            )
        )
    value = number / unit.factor
    if unit.format_number(value) == unit.format_number(getattr(scale, name)):
        # The text is the current value as displayed, with fewer digits. The exact value is kept.
        return scale
    entered_text = f"{title}: {text} {unit.unit}".rstrip()
    _check_coordinate_bounds(entered_text, name, value, coordinate)
    try:
        new_scale = replace(scale, **{name: value})
    except ValidationError as error:
        raise ScalingError(
            tr("{typed}: must be {bound}").format(
                typed=entered_text, bound=_describe_bound(error, unit)
            )
        ) from error
    # Every law is built only because its constructor checks the scale.
    for law_kind in LawKind:
        new_scale.make_law(law_kind, coordinate, 0.0)
    return new_scale


def with_presets(scales: ModeScales, mode: str) -> ModeScales:
    """Return scales in which one mode is reset to its presets."""
    return ModeScales(modes={name: scale for name, scale in scales.modes.items() if name != mode})


def format_fields(scale: CoordinateScale, coordinate: FrameCoordinate) -> Mapping[str, str]:
    """Return the number in each field for a scale, as text."""
    return {
        field.name: find_field_unit(field, coordinate).format_number(getattr(scale, field.name))
        for field in FIELDS
    }


def _check_coordinate_bounds(
    entered_text: str, name: str, value: float, coordinate: FrameCoordinate
) -> None:
    """Raise :class:`ScalingError` if a value exceeds the range or speed of the coordinate."""
    bounds, unit = coordinate.bounds, coordinate.unit
    if name == "way" and value > bounds.high - bounds.low:
        limit = format_exact(bounds.high - bounds.low, unit)
        raise ScalingError(
            tr("{typed}: must be at most the range of {most}").format(
                typed=entered_text, most=limit
            )
        )
    if name == "speed" and value > bounds.max_speed:
        limit = format_exact(bounds.max_speed, f"{unit}/s")
        raise ScalingError(
            tr("{typed}: must be at most the maximum speed of {most}").format(
                typed=entered_text, most=limit
            )
        )


def _describe_bound(error: ValidationError, unit: FieldUnit) -> str:
    context = error.errors(include_url=False)[0].get("ctx", {})
    bound_texts = (
        tr(text).format(bound=unit.format_value(context[key]))
        for key, text in _BOUND_TEXTS.items()
        if key in context
    )
    return next(bound_texts, tr("a finite number"))
