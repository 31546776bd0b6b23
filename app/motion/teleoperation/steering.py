"""Steering in one mode: scaling laws on the coordinates of a frame, and the axis motion."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rotemina.app.motion.inputs import DEGREES_OF_FREEDOM
from rotemina.app.motion.teleoperation.frames import FrameCoordinate, SteeringFrame
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.scaling import ScalingLaw

# When these coordinates increase, the tip moves opposite to the stick. In "pivot" the stage above
# the tip does.
_INVERTED_COORDINATES = frozenset({("nano", "thy"), ("pivot", "thx")})


@dataclass(frozen=True, slots=True)
class AxisTargets:
    """Target positions of the axes, m or rad, and their target speeds, per s."""

    joints: Mapping[str, float]
    speeds: Mapping[str, float]


@dataclass(slots=True)
class SteeredCoordinate:
    """Coordinate with its law, and the degree of freedom of the stick that moves it.

    Attributes
    ----------
    coordinate : FrameCoordinate
    law : ScalingLaw
    source : str
        Degree of freedom of the stick.
    sign : float
        Sign of the coordinate's motion for a positive deflection.
    is_engaged : bool
        Whether the stick acts on the coordinate. If not, it must first return to its centre.
    deflection : float
        Latest deflection that acted on the coordinate.
    is_suspended : bool
        Whether the coordinate is decoupled from the stick, because of the clutch or because the
        stick is not trusted.
    """

    coordinate: FrameCoordinate
    law: ScalingLaw
    source: str
    sign: float
    is_engaged: bool
    deflection: float = 0.0
    is_suspended: bool = False

    def find_deflection(self, deflections: Mapping[str, float]) -> float | None:
        """Return the deflection that moves this coordinate, with its sign, or None.

        A control that drives the axis by name takes precedence over the stick.
        """
        name = self.coordinate.name
        is_direct = name in deflections and name not in DEGREES_OF_FREEDOM
        deflection = deflections.get(name if is_direct else self.source)
        return None if deflection is None else self.sign * deflection

    def step(
        self, deflection: float | None, dt: float, reaction: float, *, has_anchor: bool
    ) -> None:
        """Advance by ``dt`` s, or halt without a deflection.

        ``reaction`` is the contact signal, see :meth:`ScalingLaw.step`. ``has_anchor`` says whether
        the law is relative to the deflection at its start.
        """
        law = self.law
        if deflection is None:
            halting_motion = law.bounds.step_at_speed(law.motion, 0.0, dt)
            law.start(*halting_motion, self.deflection if has_anchor else 0.0)
            self.is_suspended, self.is_engaged = True, has_anchor
            return
        if self.is_suspended:
            self.is_suspended = False
            if has_anchor:
                law.start(*law.motion, deflection)
        self.is_engaged = self.is_engaged or deflection == 0.0
        self.deflection = deflection if self.is_engaged else 0.0
        law.step(self.deflection, dt, reaction)


class FrameSteering:
    """Laws of one kind on all coordinates of one frame.

    The position law may start with the stick at any deflection, which becomes its anchor. With
    other laws, a stick that is deflected when a mode begins does nothing until it has returned to
    its centre.

    Parameters
    ----------
    frame : SteeringFrame
    kind : LawKind
    make_law : callable
        Makes the law of a coordinate.
    engaged : bool
        Whether the sticks act at once, because only the laws change and the mode continues.
    """

    def __init__(
        self,
        frame: SteeringFrame,
        kind: LawKind,
        make_law: Callable[[FrameCoordinate], ScalingLaw],
        *,
        engaged: bool = False,
    ) -> None:
        self.frame = frame
        self.kind = kind
        self._has_anchor = kind is LawKind.POSITION
        self.steered_coordinates = {
            name: SteeredCoordinate(
                coordinate,
                make_law(coordinate),
                find_stick_axis(frame, name),
                -1.0 if (frame.name, name) in _INVERTED_COORDINATES else 1.0,
                engaged or self._has_anchor,
                is_suspended=not engaged,
            )
            for name, coordinate in frame.coordinates.items()
        }
        for name, steered in self.steered_coordinates.items():
            steered.law.start(frame.coordinates[name].start, 0.0, 0.0)

    @property
    def coordinates(self) -> dict[str, float]:
        """Target values of the coordinates."""
        return {
            name: steered.law.motion.position for name, steered in self.steered_coordinates.items()
        }

    @property
    def velocities(self) -> dict[str, float]:
        """Target velocities of the coordinates, per s."""
        return {
            name: steered.law.motion.velocity for name, steered in self.steered_coordinates.items()
        }

    @property
    def is_released(self) -> bool:
        """Whether all sticks were centred in the latest step."""
        return all(
            steered.is_engaged and steered.deflection == 0.0
            for steered in self.steered_coordinates.values()
        )

    def begin(
        self,
        positions: Mapping[str, float],
        velocities: Mapping[str, float],
        deflections: Mapping[str, float],
    ) -> None:
        """Continue from a motion of the coordinates, with the sticks at given deflections."""
        for name, steered in self.steered_coordinates.items():
            deflection = steered.find_deflection(deflections)
            acting_deflection = deflection if deflection is not None and steered.is_engaged else 0.0
            steered.deflection = acting_deflection
            steered.is_suspended = deflection is None
            steered.law.start(positions[name], velocities.get(name, 0.0), acting_deflection)

    def rescale(self, factor: float) -> None:
        """Multiply all scales by a factor, also during a motion."""
        for steered in self.steered_coordinates.values():
            if steered.law.factor != factor:
                steered.law.rescale(factor)

    def step(
        self,
        deflections: Mapping[str, float],
        dt: float,
        *,
        is_coupled: bool = True,
        reactions: Mapping[str, float],
    ) -> AxisTargets:
        """Advance by ``dt`` s.

        If the sticks are not coupled to the machine, the machine halts. ``reactions`` are the
        contact signals by coordinate.
        """
        for name, steered in self.steered_coordinates.items():
            deflection = steered.find_deflection(deflections) if is_coupled else None
            steered.step(deflection, dt, reactions.get(name, 0.0), has_anchor=self._has_anchor)
        return self.compute_targets()

    def compute_targets(self) -> AxisTargets:
        """Return the current targets of the axes."""
        coordinates = self.coordinates
        speeds = self.frame.compute_axis_speeds(coordinates, self.velocities)
        return AxisTargets(self.frame.compute_joints(coordinates), speeds)

    def hold_at_fraction(self, previous: Mapping[str, float], share: float) -> None:
        """Set the references back to a fraction, 0 to 1, of the way from ``previous`` values."""
        for name, steered in self.steered_coordinates.items():
            position, velocity = steered.law.motion
            previous_position = previous[name]
            steered.law.hold_at(
                previous_position + share * (position - previous_position), share * velocity
            )


def find_stick_axis(frame: SteeringFrame, coordinate: str) -> str:
    """Return the degree of freedom of the stick that moves a coordinate.

    They are matched by name, or else by their order.
    """
    for stick_axis, axes in DEGREES_OF_FREEDOM.items():
        if coordinate in axes:
            return stick_axis
    coordinates = list(frame.coordinates)
    stick_axes = list(DEGREES_OF_FREEDOM)
    index = coordinates.index(coordinate)
    return stick_axes[index] if index < len(stick_axes) else coordinate
