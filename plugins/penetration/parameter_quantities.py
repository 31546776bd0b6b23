"""Numbers of a penetration as typed by an operator: unit, bounds, effect."""

from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.penetration.parameters import BOUNDS, PenetrationParameters
from rotemina.app.shell.language import marked, translate
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import parsed, rounded

_PRESETS = PenetrationParameters()


class Group(StrEnum):
    """What belongs together on the screen."""

    APPROACH = marked("penetration", "Approach")
    CONTACT = marked("penetration", "Contact detection")
    THRUST = marked("penetration", "Thrust")
    HOLD = marked("penetration", "Hold and inject")
    RETRACT = marked("penetration", "Retract")
    LIMITS = marked("penetration", "Limits")


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
        return translate("penetration", self.title)

    @property
    def name(self) -> str:
        """Title and unit, for those who hear the screen."""
        return (
            translate("penetration", "{title}, {unit}").format(
                title=self.shown_title, unit=self.unit
            )
            if self.unit
            else self.shown_title
        )

    @property
    def tip(self) -> tuple[str, str]:
        """What it does, and its bounds and preset."""
        bound, preset = BOUNDS[self.key], getattr(_PRESETS, self.key)
        least, most = self.number(bound.least), self.text(bound.most)
        about = translate("penetration", self.about)
        bounds = translate("penetration", "{least} to {most}; preset {preset}")
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
                translate(
                    "penetration",
                    "{title}: {text!r} is not a number; enter one{unit} with a decimal point",
                ).format(title=self.shown_title, text=text, unit=unit)
            )
        value, bound = number / self.per_si, BOUNDS[self.key]
        for end in bound.least, bound.most:
            if self.number(value) == self.number(end):
                value = end  # typed as it is shown: rounding must not put it beyond
        if not bound.least <= value <= bound.most:
            raise TypedError(
                translate("penetration", "{title}: {value} must be {least} to {most}").format(
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
            marked("penetration", "Speed"),
            "µm/s",
            _UM,
            Group.APPROACH,
            marked("penetration", "Speed of the approach"),
        ),
        Quantity(
            "approach_distance",
            marked("penetration", "At most"),
            "µm",
            _UM,
            Group.APPROACH,
            marked(
                "penetration",
                "Without contact within this distance the run fails and the tip retracts",
            ),
        ),
        Quantity(
            "false_alarms_per_hour",
            marked("penetration", "False alarms"),
            "1/h",
            1.0,
            Group.CONTACT,
            marked(
                "penetration",
                "Rate of false alarms from noise; fewer alarms make the detection slower",
            ),
        ),
        Quantity(
            "drift",
            marked("penetration", "Drift"),
            "%",
            _PERCENT,
            Group.CONTACT,
            marked(
                "penetration",
                "Slope of measured − model that hysteresis, creep and gain may cause; a "
                "smaller value detects softer membranes",
            ),
        ),
        Quantity(
            "drift_length",
            marked("penetration", "Drift over"),
            "µm",
            _UM,
            Group.CONTACT,
            marked("penetration", "Distance over which that slope may change by the same amount"),
        ),
        Quantity(
            "contact_pause_s",
            marked("penetration", "Pause"),
            "ms",
            _MS,
            Group.CONTACT,
            marked("penetration", "At rest on the membrane before the thrust"),
        ),
        Quantity(
            "depth",
            marked("penetration", "Depth"),
            "µm",
            _UM,
            Group.THRUST,
            marked("penetration", "Depth of the thrust, from the position of rest on the membrane"),
        ),
        Quantity(
            "duration_s",
            marked("penetration", "Duration"),
            "ms",
            _MS,
            Group.THRUST,
            marked("penetration", "Duration of the thrust, with shaping"),
        ),
        Quantity(
            "ramp",
            marked("penetration", "Ramp"),
            "%",
            _PERCENT,
            Group.THRUST,
            marked(
                "penetration",
                "S-curve: share of the time for acceleration, and the same for deceleration",
            ),
        ),
        Quantity(
            "hold_s",
            marked("penetration", "Hold"),
            "ms",
            _MS,
            Group.HOLD,
            marked("penetration", "Time at depth before the tool is switched on"),
        ),
        Quantity(
            "inject_s",
            marked("penetration", "Inject"),
            "ms",
            _MS,
            Group.HOLD,
            marked("penetration", "Time with the tool on; 0: the tool stays off"),
        ),
        Quantity(
            "hold_after_s",
            marked("penetration", "Hold after"),
            "ms",
            _MS,
            Group.HOLD,
            marked("penetration", "Time at depth after the tool is switched off"),
        ),
        Quantity(
            "retract_speed",
            marked("penetration", "Return speed"),
            "µm/s",
            _UM,
            Group.RETRACT,
            marked("penetration", "Speed of the retraction"),
        ),
        Quantity(
            "depth_tolerance",
            marked("penetration", "Depth tolerance"),
            "%",
            _PERCENT,
            Group.LIMITS,
            marked(
                "penetration",
                "Permitted deviation of the measured from the requested depth; above it, "
                "the run fails",
            ),
        ),
        Quantity(
            "overload",
            marked("penetration", "Overload"),
            "µm",
            _UM,
            Group.LIMITS,
            marked(
                "penetration",
                "Maximum deviation of the axis from its set-point; above it, the tip "
                "retracts at once",
            ),
        ),
        Quantity(
            "armed_s",
            marked("penetration", "Armed for"),
            "s",
            1.0,
            Group.LIMITS,
            marked("penetration", "Time after which the penetration disarms automatically"),
        ),
    )
}


def in_group(group: Group) -> tuple[Quantity, ...]:
    """Return the numbers of a group, in order."""
    return tuple(one for one in QUANTITIES.values() if one.group is group)
