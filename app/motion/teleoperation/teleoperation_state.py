"""State of teleoperation, for displays."""

from collections.abc import Mapping
from dataclasses import dataclass

from rotemina.app.motion.teleoperation.impedance import ImpedanceLaw
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.app.motion.teleoperation.steering import FrameSteering, SteeredCoordinate


@dataclass(frozen=True, slots=True)
class CoordinateView:
    """State of one coordinate, for the screen.

    Attributes
    ----------
    name, unit : str
    source : str
        Degree of freedom of the stick that moves the coordinate.
    deflection : float or None
        Deflection of the stick, with the sign of the coordinate; None if no trusted stick moves it.
    position : float
        Position of the reference, m or rad.
    is_waiting : bool
        Whether the stick must return to its centre before it acts.
    law : ScalingLaw
    contact_force_ratio : float
        Contact force as a fraction of the maximum force, −1 to 1.
    """

    name: str
    unit: str
    source: str
    deflection: float | None
    position: float
    is_waiting: bool
    law: ScalingLaw
    contact_force_ratio: float = 0.0


@dataclass(frozen=True, slots=True)
class TeleoperationState:
    """State of teleoperation after one step.

    Attributes
    ----------
    mode : str
    law : LawKind
    preset, factor : float
        Step preset, and its product with fine or coarse, which is the factor in use.
    is_driving : bool
        Whether teleoperation moves axes now.
    reason : str or None
        Why teleoperation moves no axis now.
    refusal_reason : str or None
        Why the latest motion was refused or slowed; None after a motion was accepted.
    coordinates : tuple of CoordinateView
        Coordinates of the mode; empty before the mode has begun.
    reserve : float or None
        Remaining range of the piezos: 1 in mid-range, 0 at an end.
    tilt : float or None
        Angle by which the tool has been turned since the mode began, rad.
    """

    mode: str
    law: LawKind
    preset: float = 1.0
    factor: float = 1.0
    is_driving: bool = False
    reason: str | None = None
    refusal_reason: str | None = None
    coordinates: tuple[CoordinateView, ...] = ()
    reserve: float | None = None
    tilt: float | None = None


def make_display_values(
    steering: FrameSteering, deflections: Mapping[str, float], reactions: Mapping[str, float]
) -> tuple[tuple[CoordinateView, ...], float | None, float | None]:
    """Return coordinates, reserve and tilt of :class:`TeleoperationState`.

    ``reactions`` are the contact signals by coordinate.
    """
    views = tuple(
        _make_view(steered, steered.find_deflection(deflections), reactions.get(name, 0.0))
        for name, steered in steering.steered_coordinates.items()
    )
    coordinates = steering.coordinates
    return (
        views,
        steering.frame.compute_reserve(coordinates),
        steering.frame.compute_tilt(coordinates),
    )


def _make_view(
    steered: SteeredCoordinate, deflection: float | None, reaction: float
) -> CoordinateView:
    law = steered.law
    contact_force_ratio = 0.0
    if isinstance(law, ImpedanceLaw) and law.contact is not None and law.contact.max_force:
        contact_force_ratio = law.contact.compute_force(reaction) / law.contact.max_force
    return CoordinateView(
        steered.coordinate.name,
        steered.coordinate.unit,
        steered.source,
        deflection,
        law.motion.position,
        not steered.is_engaged,
        law,
        contact_force_ratio,
    )
