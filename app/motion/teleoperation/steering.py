"""Steering in one mode: laws on the coordinates of a frame, and the resulting axis motion."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rotemina.app.motion.teleoperation.frames import Coordinate, Frame
from rotemina.app.motion.teleoperation.profile_check import DEGREES_OF_FREEDOM
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.scaling import ScalingLaw

# Where the tip, or in "pivot" the stage above it, would go against the stick by the axis' own sign.
_AGAINST = frozenset({("nano", "thy"), ("pivot", "thx")})


@dataclass(frozen=True, slots=True)
class Step:
    """Where the axes are to be now, m or rad, and how fast they are to go, per s."""

    joints: Mapping[str, float]
    speeds: Mapping[str, float]


@dataclass(slots=True)
class SteeredCoordinate:
    """One coordinate: its law, what of the operator's devices moves it, and whether that may."""

    coordinate: Coordinate
    law: ScalingLaw
    source: str
    sign: float
    engaged: bool  # else the stick must be seen in the middle first
    deflection: float = 0.0  # the latest one that counted
    held: bool = False  # the stick moves without it: clutch, distrust

    def deflection_in(self, deflections: Mapping[str, float]) -> float | None:
        """Return the deflection of its axis' or its degree of freedom's stick, in its direction."""
        name = self.coordinate.name
        own = name in deflections and name not in DEGREES_OF_FREEDOM
        told = deflections.get(name if own else self.source)
        return None if told is None else self.sign * told

    def step(self, told: float | None, dt: float, reaction: float, *, indexed: bool) -> None:
        """Advance by ``dt`` s; without a deflection, halt. ``indexed``: of a law with an index."""
        law = self.law
        if told is None:
            halted = law.bounds.at_speed(law.motion, 0.0, dt)
            law.start(*halted, self.deflection if indexed else 0.0)
            self.held, self.engaged = True, indexed
            return
        if self.held:
            self.held = False
            if indexed:
                law.start(*law.motion, told)
        self.engaged = self.engaged or told == 0.0
        self.deflection = told if self.engaged else 0.0
        law.step(self.deflection, dt, reaction)


class Steering:
    """Laws of one kind on one frame.

    The position law may be entered with the stick anywhere: it is indexed there. With the others a
    stick that is deflected when a mode begins does nothing until it was seen in the middle.

    Parameters
    ----------
    frame : Frame
    kind : LawKind
    make : callable
        Makes the law of a coordinate.
    engaged : bool
        Whether sticks count at once: the laws are exchanged in a mode that continues.
    """

    def __init__(
        self,
        frame: Frame,
        kind: LawKind,
        make: Callable[[Coordinate], ScalingLaw],
        *,
        engaged: bool = False,
    ) -> None:
        self.frame = frame
        self.kind = kind
        self._indexed = kind is LawKind.POSITION
        self.steered = {
            name: SteeredCoordinate(
                coordinate,
                make(coordinate),
                source_of(frame, name),
                -1.0 if (frame.name, name) in _AGAINST else 1.0,
                engaged or self._indexed,
                held=not engaged,
            )
            for name, coordinate in frame.coordinates.items()
        }
        for name, one in self.steered.items():
            one.law.start(frame.coordinates[name].start, 0.0, 0.0)

    @property
    def coordinates(self) -> dict[str, float]:
        """Where the coordinates are to be."""
        return {name: one.law.motion.position for name, one in self.steered.items()}

    @property
    def velocities(self) -> dict[str, float]:
        """How fast the coordinates are to go, per s."""
        return {name: one.law.motion.velocity for name, one in self.steered.items()}

    @property
    def released(self) -> bool:
        """Whether every stick was in the middle when it was last looked at."""
        return all(one.engaged and one.deflection == 0.0 for one in self.steered.values())

    def begin(
        self,
        positions: Mapping[str, float],
        velocities: Mapping[str, float],
        deflections: Mapping[str, float],
    ) -> None:
        """Continue from a motion of the coordinates, with the sticks where they are."""
        for name, one in self.steered.items():
            told = one.deflection_in(deflections)
            seen = told if told is not None and one.engaged else 0.0
            one.deflection = seen
            one.held = told is None
            one.law.start(positions[name], velocities.get(name, 0.0), seen)

    def rescale(self, factor: float) -> None:
        """Multiply all scales by a factor, in mid-move too."""
        for one in self.steered.values():
            if one.law.factor != factor:
                one.law.rescale(factor)

    def step(
        self,
        deflections: Mapping[str, float],
        dt: float,
        *,
        free: bool = True,
        reactions: Mapping[str, float],
    ) -> Step:
        """Advance by ``dt`` s; without ``free`` the sticks move and the machine does not."""
        for name, one in self.steered.items():
            told = one.deflection_in(deflections) if free else None
            one.step(told, dt, reactions.get(name, 0.0), indexed=self._indexed)
        return self.now()

    def now(self) -> Step:
        """Return what the axes are to do now."""
        coordinates = self.coordinates
        speeds = self.frame.speeds(coordinates, self.velocities)
        return Step(self.frame.joints(coordinates), speeds)

    def hold_back(self, before: Mapping[str, float], share: float) -> None:
        """Note that the machine went only this share of the way from ``before``, 0 to 1."""
        for name, one in self.steered.items():
            position, velocity = one.law.motion
            begin = before[name]
            one.law.hold(begin + share * (position - begin), share * velocity)


def source_of(frame: Frame, coordinate: str) -> str:
    """Return the degree of freedom of a stick that moves a coordinate: by name, else in order."""
    for degree, axes in DEGREES_OF_FREEDOM.items():
        if coordinate in axes:
            return degree
    order = list(frame.coordinates)
    degrees = list(DEGREES_OF_FREEDOM)
    place = order.index(coordinate)
    return degrees[place] if place < len(degrees) else coordinate
