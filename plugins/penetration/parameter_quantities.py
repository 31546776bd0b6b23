"""Numerical parameters of a penetration on the screen: unit, bounds and meaning."""

from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.penetration import PARAMETER_BOUNDS, PenetrationParameters
from rotemina.plugins.penetration import mark, tr
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_rounded, parse_number

_DEFAULT_PARAMETERS = PenetrationParameters()


class ParameterGroup(StrEnum):
    """Group of parameters on the screen."""

    APPROACH = mark("Approach")
    CONTACT = mark("Contact detection")
    THRUST = mark("Thrust")
    HOLD = mark("Hold and inject")
    RETRACT = mark("Retract")
    LIMITS = mark("Limits")


class ParameterInputError(InputError):
    """Typed text that is not a number, or a number out of bounds."""


@dataclass(frozen=True, slots=True)
class ParameterQuantity:
    """Numerical parameter as it is displayed.

    Attributes
    ----------
    key : str
        Its name in :class:`PenetrationParameters`.
    title, unit : str
        English title, and unit on the screen.
    per_si : float
        Number of screen units in one SI unit.
    group : ParameterGroup
    description : str
        Meaning, as an English sentence without its full stop.
    """

    key: str
    title: str
    unit: str
    per_si: float
    group: ParameterGroup
    description: str

    @property
    def shown_title(self) -> str:
        """The title in the language in use."""
        return tr(self.title)

    @property
    def name(self) -> str:
        """Title and unit, for screen readers."""
        return (
            tr("{title}, {unit}").format(title=self.shown_title, unit=self.unit)
            if self.unit
            else self.shown_title
        )

    @property
    def tip(self) -> tuple[str, str]:
        """Lines of the tooltip: meaning, then bounds and default."""
        bound, preset = PARAMETER_BOUNDS[self.key], getattr(_DEFAULT_PARAMETERS, self.key)
        minimum, maximum = self.format_number(bound.minimum), self.format_value(bound.maximum)
        description = tr(self.description)
        bounds = tr("{least} to {most}; preset {preset}")
        return f"{description}.", bounds.format(
            least=minimum, most=maximum, preset=self.format_value(preset)
        )

    def format_number(self, value: float) -> str:
        """Return a value (SI) as digits in the screen unit."""
        return format_rounded(value * self.per_si, 6)

    def format_value(self, value: float) -> str:
        """Return a value (SI) as digits with the screen unit."""
        return f"{self.format_number(value)} {self.unit}".rstrip()

    def parse_value(self, typed: str) -> float:
        """Return the value (SI) of a text that the operator has typed.

        Raises
        ------
        ParameterInputError
            If the text is not a number within the bounds.
        """
        text = typed.strip()
        number = parse_number(text)
        if number is None:
            unit = f" in {self.unit}" if self.unit else ""
            raise ParameterInputError(
                tr(
                    "{title}: {text!r} is not a number; enter one{unit} with a decimal point"
                ).format(title=self.shown_title, text=text, unit=unit)
            )
        value, bound = number / self.per_si, PARAMETER_BOUNDS[self.key]
        for limit in bound.minimum, bound.maximum:
            if self.format_number(value) == self.format_number(limit):
                # The displayed bound is rounded. If it is typed, it must be accepted.
                value = limit
        if not bound.minimum <= value <= bound.maximum:
            raise ParameterInputError(
                tr("{title}: {value} must be {least} to {most}").format(
                    title=self.shown_title,
                    value=f"{text} {self.unit}".rstrip(),
                    least=self.format_number(bound.minimum),
                    most=self.format_value(bound.maximum),
                )
            )
        return value


_UNITS_PER_SI = {"µm": 1e6, "µm/s": 1e6, "ms": 1e3, "%": 1e2}
_ROWS_BY_GROUP = {
    ParameterGroup.APPROACH: (
        ("approach_speed", mark("Speed"), "µm/s", mark("Speed of the approach")),
        (
            "approach_distance",
            mark("At most"),
            "µm",
            mark("Without contact within this distance the run fails and the tip retracts"),
        ),
    ),
    ParameterGroup.CONTACT: (
        (
            "false_alarms_per_hour",
            mark("False alarms"),
            "1/h",
            mark("Rate of false alarms from noise; fewer alarms make the detection slower"),
        ),
        (
            "drift",
            mark("Drift"),
            "%",
            mark(
                "Slope of measured − model that hysteresis, creep and gain may cause; a "
                "smaller value detects softer membranes"
            ),
        ),
        (
            "drift_length",
            mark("Drift over"),
            "µm",
            mark("Distance over which that slope may change by the same amount"),
        ),
        (
            "contact_pause_s",
            mark("Pause"),
            "ms",
            mark("Time at rest on the membrane before the thrust"),
        ),
    ),
    ParameterGroup.THRUST: (
        (
            "depth",
            mark("Depth"),
            "µm",
            mark("Depth of the thrust, from the position of rest on the membrane"),
        ),
        ("duration_s", mark("Duration"), "ms", mark("Duration of the thrust, with shaping")),
        (
            "ramp",
            mark("Ramp"),
            "%",
            mark("S-curve: share of the time for acceleration, and the same for deceleration"),
        ),
    ),
    ParameterGroup.HOLD: (
        ("hold_s", mark("Hold"), "ms", mark("Time at depth before the tool is switched on")),
        ("inject_s", mark("Inject"), "ms", mark("Time with the tool on; 0: the tool stays off")),
        (
            "hold_after_s",
            mark("Hold after"),
            "ms",
            mark("Time at depth after the tool is switched off"),
        ),
    ),
    ParameterGroup.RETRACT: (
        ("retract_speed", mark("Return speed"), "µm/s", mark("Speed of the retraction")),
    ),
    ParameterGroup.LIMITS: (
        (
            "depth_tolerance",
            mark("Depth tolerance"),
            "%",
            mark(
                "Permitted deviation of the measured from the requested depth; above it, "
                "the run fails"
            ),
        ),
        (
            "overload",
            mark("Overload"),
            "µm",
            mark(
                "Maximum deviation of the axis from its set-point; above it, the tip "
                "retracts at once"
            ),
        ),
        (
            "armed_s",
            mark("Armed for"),
            "s",
            mark("Time after which the penetration disarms automatically"),
        ),
    ),
}
QUANTITIES = {
    key: ParameterQuantity(key, title, unit, _UNITS_PER_SI.get(unit, 1.0), group, description)
    for group, rows in _ROWS_BY_GROUP.items()
    for key, title, unit, description in rows
}


def find_quantities(group: ParameterGroup) -> tuple[ParameterQuantity, ...]:
    """Return the numerical parameters of a group, in order."""
    return tuple(quantity for quantity in QUANTITIES.values() if quantity.group is group)
