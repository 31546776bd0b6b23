"""Numbers of a penetration as typed by an operator: unit, bounds, effect."""

from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.penetration.parameters import BOUNDS, PenetrationParameters
from rotemina.plugins.penetration import mark, tr
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import parsed, rounded

_PRESETS = PenetrationParameters()


class Group(StrEnum):
    """What belongs together on the screen."""

    APPROACH = mark("Approach")
    CONTACT = mark("Contact detection")
    THRUST = mark("Thrust")
    HOLD = mark("Hold and inject")
    RETRACT = mark("Retract")
    LIMITS = mark("Limits")


class TypedError(InputError):
    """What was typed is no number, or out of bounds."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number.

    Attributes
    ----------
    key : str
        Its name among the parameters.
    title, unit : str
        As an English screen has them.
    per_si : float
        How many of the unit make one SI unit.
    group : Group
    about : str
        What it does, in a sentence without its full stop.
    """

    key: str
    title: str
    unit: str
    per_si: float
    group: Group
    about: str

    @property
    def shown_title(self) -> str:
        """The title in the language in use."""
        return tr(self.title)

    @property
    def name(self) -> str:
        """Title and unit, for those who hear the screen."""
        return (
            tr("{title}, {unit}").format(title=self.shown_title, unit=self.unit)
            if self.unit
            else self.shown_title
        )

    @property
    def tip(self) -> tuple[str, str]:
        """What it does, and its bounds and preset."""
        bound, preset = BOUNDS[self.key], getattr(_PRESETS, self.key)
        least, most = self.number(bound.least), self.text(bound.most)
        about = tr(self.about)
        bounds = tr("{least} to {most}; preset {preset}")
        return f"{about}.", bounds.format(least=least, most=most, preset=self.text(preset))

    def number(self, value: float) -> str:
        """Return a value (SI) as digits in the unit."""
        return rounded(value * self.per_si, 6)

    def text(self, value: float) -> str:
        """Return a value (SI) with its unit."""
        return f"{self.number(value)} {self.unit}".rstrip()

    def value(self, typed: str) -> float:
        """Return what a text means, SI.

        Raises
        ------
        TypedError
            With the text and the bounds.
        """
        text = typed.strip()
        number = parsed(text)
        if number is None:
            unit = f" in {self.unit}" if self.unit else ""
            raise TypedError(
                tr(
                    "{title}: {text!r} is not a number; enter one{unit} with a decimal point"
                ).format(title=self.shown_title, text=text, unit=unit)
            )
        value, bound = number / self.per_si, BOUNDS[self.key]
        for end in bound.least, bound.most:
            if self.number(value) == self.number(end):
                value = end  # typed as it is shown: rounding must not put it beyond
        if not bound.least <= value <= bound.most:
            raise TypedError(
                tr("{title}: {value} must be {least} to {most}").format(
                    title=self.shown_title,
                    value=f"{text} {self.unit}".rstrip(),
                    least=self.number(bound.least),
                    most=self.text(bound.most),
                )
            )
        return value


_UM, _MS, _PERCENT = 1e6, 1e3, 1e2

QUANTITIES = {
    one.key: one
    for one in (
        Quantity(
            "approach_speed",
            mark("Speed"),
            "µm/s",
            _UM,
            Group.APPROACH,
            mark("Speed of the approach"),
        ),
        Quantity(
            "approach_distance",
            mark("At most"),
            "µm",
            _UM,
            Group.APPROACH,
            mark("Without contact within this distance the run fails and the tip retracts"),
        ),
        Quantity(
            "false_alarms_per_hour",
            mark("False alarms"),
            "1/h",
            1.0,
            Group.CONTACT,
            mark("Rate of false alarms from noise; fewer alarms make the detection slower"),
        ),
        Quantity(
            "drift",
            mark("Drift"),
            "%",
            _PERCENT,
            Group.CONTACT,
            mark(
                "Slope of measured − model that hysteresis, creep and gain may cause; a "
                "smaller value detects softer membranes"
            ),
        ),
        Quantity(
            "drift_length",
            mark("Drift over"),
            "µm",
            _UM,
            Group.CONTACT,
            mark("Distance over which that slope may change by the same amount"),
        ),
        Quantity(
            "contact_pause_s",
            mark("Pause"),
            "ms",
            _MS,
            Group.CONTACT,
            mark("At rest on the membrane before the thrust"),
        ),
        Quantity(
            "depth",
            mark("Depth"),
            "µm",
            _UM,
            Group.THRUST,
            mark("Depth of the thrust, from the position of rest on the membrane"),
        ),
        Quantity(
            "duration_s",
            mark("Duration"),
            "ms",
            _MS,
            Group.THRUST,
            mark("Duration of the thrust, with shaping"),
        ),
        Quantity(
            "ramp",
            mark("Ramp"),
            "%",
            _PERCENT,
            Group.THRUST,
            mark("S-curve: share of the time for acceleration, and the same for deceleration"),
        ),
        Quantity(
            "hold_s",
            mark("Hold"),
            "ms",
            _MS,
            Group.HOLD,
            mark("Time at depth before the tool is switched on"),
        ),
        Quantity(
            "inject_s",
            mark("Inject"),
            "ms",
            _MS,
            Group.HOLD,
            mark("Time with the tool on; 0: the tool stays off"),
        ),
        Quantity(
            "hold_after_s",
            mark("Hold after"),
            "ms",
            _MS,
            Group.HOLD,
            mark("Time at depth after the tool is switched off"),
        ),
        Quantity(
            "retract_speed",
            mark("Return speed"),
            "µm/s",
            _UM,
            Group.RETRACT,
            mark("Speed of the retraction"),
        ),
        Quantity(
            "depth_tolerance",
            mark("Depth tolerance"),
            "%",
            _PERCENT,
            Group.LIMITS,
            mark(
                "Permitted deviation of the measured from the requested depth; above it, "
                "the run fails"
            ),
        ),
        Quantity(
            "overload",
            mark("Overload"),
            "µm",
            _UM,
            Group.LIMITS,
            mark(
                "Maximum deviation of the axis from its set-point; above it, the tip "
                "retracts at once"
            ),
        ),
        Quantity(
            "armed_s",
            mark("Armed for"),
            "s",
            1.0,
            Group.LIMITS,
            mark("Time after which the penetration disarms automatically"),
        ),
    )
}


def in_group(group: Group) -> tuple[Quantity, ...]:
    """Return the numbers of a group, in order."""
    return tuple(one for one in QUANTITIES.values() if one.group is group)
