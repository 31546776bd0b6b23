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


_PER_SI = {"µm": 1e6, "µm/s": 1e6, "ms": 1e3, "%": 1e2}
_TABLE = {
    Group.APPROACH: (
        ("approach_speed", mark("Speed"), "µm/s", mark("Speed of the approach")),
        (
            "approach_distance",
            mark("At most"),
            "µm",
            mark("Without contact within this distance the run fails and the tip retracts"),
        ),
    ),
    Group.CONTACT: (
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
        ("contact_pause_s", mark("Pause"), "ms", mark("At rest on the membrane before the thrust")),
    ),
    Group.THRUST: (
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
    Group.HOLD: (
        ("hold_s", mark("Hold"), "ms", mark("Time at depth before the tool is switched on")),
        ("inject_s", mark("Inject"), "ms", mark("Time with the tool on; 0: the tool stays off")),
        (
            "hold_after_s",
            mark("Hold after"),
            "ms",
            mark("Time at depth after the tool is switched off"),
        ),
    ),
    Group.RETRACT: (
        ("retract_speed", mark("Return speed"), "µm/s", mark("Speed of the retraction")),
    ),
    Group.LIMITS: (
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
    key: Quantity(key, title, unit, _PER_SI.get(unit, 1.0), group, about)
    for group, rows in _TABLE.items()
    for key, title, unit, about in rows
}


def in_group(group: Group) -> tuple[Quantity, ...]:
    """Return the numbers of a group, in order."""
    return tuple(one for one in QUANTITIES.values() if one.group is group)
