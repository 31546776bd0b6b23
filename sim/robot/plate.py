"""The plate that holds the pin, as a robot file describes it: ``[plate]`` and its inner tables.

Lengths are in m, angles in rad, stress and moduli in Pa, masses in kg. The defaults are the shipped
plate. The moduli come from the source paper; the rest is a design choice that gives the stiffness
and mass of the nominal robot (``docs/plate.md``).
"""

from dataclasses import field
from typing import Annotated, Literal

from pydantic import Field
from pydantic.dataclasses import dataclass

from rotemina.sim.robot.numbers import FORBID_UNKNOWN, NotNegative, Number, Positive

# No metal has a negative ratio, and a plate is stable up to 0.5.
PoissonsRatio = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=0.5)]
Repeats = Annotated[int, Field(strict=True, ge=1, le=60)]


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PlateCutout:
    """Ring of equal cut-outs, evenly spaced over the circumference.

    ``"slot"``: from ``inner_radius`` to ``outer_radius``, ``width`` (rad, seen from the centre)
    wide, turned by ``twist`` (rad) from the inner to the outer end: 0 gives straight slots, other
    values spiral slots. ``"hole"``: ``radius`` around centres on ``circle_radius``. The first
    cut-out is at the angle ``start``.
    """

    kind: Literal["slot", "hole"]
    count: Repeats
    start: Number = 0.0
    inner_radius: Positive | None = None
    outer_radius: Positive | None = None
    width: Positive | None = None
    twist: Number = 0.0
    circle_radius: Positive | None = None
    radius: Positive | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PlateHub:
    """Rigid parts on the plate's hub other than the pin: the holder and part of the actuators.

    ``mass``; ``inertia`` about any diameter of the hub, ``product`` of inertia, kg m².
    """

    mass: NotNegative = 0.1475
    inertia: NotNegative = 1.88e-5
    product: Number = 3.0e-7


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PlatePin:
    """Pin: a round rod from the plate's middle down to the tip.

    By default, the pin is as long as the robot's ``pin_length``.
    """

    length: Positive | None = None
    diameter: Positive = 0.003
    youngs_modulus: Positive = 204e9
    poissons_ratio: PoissonsRatio = 0.291
    density: Positive = 7850.0
    yield_stress: Positive = 1.0e9


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class PinJoint:
    """Seat of the pin in the hub, held by Coulomb friction.

    ``clamp_force`` N: sum of the normal forces. ``arm`` m: distance from the seat's middle to where
    they act. Friction carries ``friction · clamp_force`` along the pin, and this force times
    ``arm`` as a moment.
    """

    friction: Positive = 0.15
    clamp_force: Positive = 1000.0
    arm: Positive = 0.002


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Plate:
    """Thin round plate, clamped at its rim, with a stiff hub in its middle."""

    rim_radius: Positive = 0.01725
    hub_radius: Positive = 0.005175
    thickness: Positive = 0.00048
    youngs_modulus: Positive = 211e9
    poissons_ratio: PoissonsRatio = 0.260
    density: Positive = 7850.0
    yield_stress: Positive = 1.0e9
    cutout: tuple[PlateCutout, ...] = ()
    hub: PlateHub = field(default_factory=PlateHub)
    pin: PlatePin = field(default_factory=PlatePin)
    joint: PinJoint = field(default_factory=PinJoint)

    @property
    def flexural_rigidity(self) -> float:
        """Flexural rigidity ``E h³ / (12 (1 - ν²))``, N m."""
        ratio = 1.0 - self.poissons_ratio**2
        return self.youngs_modulus * self.thickness**3 / (12.0 * ratio)
