"""The state of teleoperation, for displays."""

from collections.abc import Mapping
from dataclasses import dataclass

from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.app.motion.teleoperation.steering import SteeredCoordinate, Steering


@dataclass(frozen=True, slots=True)
class CoordinateView:
    """One coordinate for the screen.

    Attributes
    ----------
    name, unit : str
    source : str
        What of the operator's devices moves it.
    deflection : float or None
        Of its stick, in its own direction; None: there is none that is trusted.
    position : float
        Of the reference, m or rad.
    waiting : bool
        Whether its stick must be seen in the middle before it counts.
    law : ScalingLaw
    felt : float
        The share of the stick's force with which a contact pushes back, −1 to 1.
    """

    name: str
    unit: str
    source: str
    deflection: float | None
    position: float
    waiting: bool
    law: ScalingLaw
    felt: float = 0.0


@dataclass(frozen=True, slots=True)
class TeleoperationState:
    """One moment of teleoperation.

    Attributes
    ----------
    mode : str
    law : LawKind
    preset, factor : float
        The step preset, and that times fine or coarse as it acts now.
    driving : bool
        Whether axes are being moved by it.
    reason : str or None
        Why it moves nothing now.
    refused : str or None
        Why the last motion was refused or slowed; None once one is taken.
    coordinates : tuple of CoordinateView
        Empty before the mode has begun.
    reserve : float or None
        How much of its range a piezo still has: 1 in the middle, 0 at an end.
    tilt : float or None
        By how much the tool has been turned since the mode began, rad.
    """

    mode: str
    law: LawKind
    preset: float = 1.0
    factor: float = 1.0
    driving: bool = False
    reason: str | None = None
    refused: str | None = None
    coordinates: tuple[CoordinateView, ...] = ()
    reserve: float | None = None
    tilt: float | None = None


def shown(
    steering: Steering, deflections: Mapping[str, float], reactions: Mapping[str, float]
) -> tuple[tuple[CoordinateView, ...], float | None, float | None]:
    """Return the last three of :class:`TeleoperationState`.

    ``reactions`` are contact readings by coordinate.
    """
    views = tuple(
        _viewed(one, one.deflection_in(deflections), reactions.get(name, 0.0))
        for name, one in steering.steered.items()
    )
    places = steering.coordinates
    return views, steering.frame.reserve(places), steering.frame.tilt(places)


def _viewed(one: SteeredCoordinate, deflection: float | None, reaction: float) -> CoordinateView:
    law = one.law
    felt = 0.0
    if isinstance(law, Impedance) and law.contact is not None and law.contact.most:
        felt = law.contact.force(reaction) / law.contact.most
    return CoordinateView(
        one.coordinate.name,
        one.coordinate.unit,
        one.source,
        deflection,
        law.motion.position,
        not one.engaged,
        law,
        felt,
    )
