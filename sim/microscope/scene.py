"""What stands before the microscope, and how bright it is: everything but where the tip is."""

from dataclasses import dataclass, field
from math import pi
from typing import Self

from rotemina.sim.messages import message
from rotemina.sim.microscope.cell import Cell
from rotemina.sim.microscope.errors import SceneError
from rotemina.sim.microscope.optics import Optics
from rotemina.sim.robot.model import Robot

_APPROACH_RAD = pi / 6  # where a robot file says nothing


@dataclass(frozen=True, slots=True)
class Pin:
    """The pin or pipette: a tapering tube that ends at the tip of the kinematics.

    Attributes
    ----------
    approach_rad : float
        Between its body and the dish; π/2 is upright. The body leans towards +x.
    tip_radius_m, shank_radius_m : float
        At the tip, and where it stops growing.
    taper : float
        By which the radius grows per length.
    wall, lumen : float
        Share of the light that is lost in the tube, and how much less through its bore.
    bore : float
        Radius of the bore, over the tube's.
    """

    approach_rad: float = _APPROACH_RAD
    tip_radius_m: float = 0.75e-6
    shank_radius_m: float = 60e-6
    taper: float = 0.06
    wall: float = 0.55
    lumen: float = 0.3
    bore: float = 0.6

    def __post_init__(self) -> None:
        if not 0.0 < self.approach_rad <= pi / 2:
            raise SceneError(
                message(
                    "engine",
                    "tool: approach_angle = {approach_rad} rad: must be more than 0 (flat on the "
                    "dish) and at most {pi} (upright)",
                ).fill(approach_rad=self.approach_rad, pi=pi / 2)
            )


@dataclass(frozen=True, slots=True)
class Light:
    """The illumination, and what falls off from the middle to the edges.

    Attributes
    ----------
    rate : float
        Photoelectrons per pixel and second in the middle.
    vignetting : float
        Share lost in the corners, growing with the square of the distance from the middle.
    gradient : tuple of float
        Change across the whole width and height, as a share.
    dust : float
        Contrast of what is never in focus and never moves, as a share.
    """

    rate: float = 5e5
    vignetting: float = 0.2
    gradient: tuple[float, float] = (0.10, -0.06)
    dust: float = 0.01


@dataclass(frozen=True, slots=True)
class Sensor:
    """The camera's chip and converter.

    Attributes
    ----------
    bits : int
        Of a pixel.
    full_well : float
        Photoelectrons that a pixel holds.
    read_noise : float
        Standard deviation, photoelectrons.
    electrons_per_number : float
        At gain 1.
    black_level : float
        Number of a pixel without light.
    """

    bits: int = 12
    full_well: float = 17_000.0
    read_noise: float = 8.0
    electrons_per_number: float = 4.0
    black_level: float = 40.0

    @property
    def largest(self) -> int:
        """The number of a saturated pixel."""
        return (1 << self.bits) - 1


@dataclass(frozen=True, slots=True)
class Scene:
    """All of it; ``seed`` draws the cell's grains and the dust, not the noise of a frame."""

    optics: Optics = field(default_factory=Optics)
    pin: Pin = field(default_factory=Pin)
    cell: Cell | None = None
    light: Light = field(default_factory=Light)
    sensor: Sensor = field(default_factory=Sensor)
    seed: int = 0

    @classmethod
    def of(cls, robot: Robot, *, seed: int = 0, **mounting: object) -> Self:
        """Return the scene of a robot file, with a cell beside the middle of the view.

        ``mounting`` are fields of :class:`Optics`.
        """
        optics = Optics.of(robot, **mounting)
        angle = robot.tool.approach_angle
        pin = Pin(_APPROACH_RAD if angle is None else angle)
        return cls(optics, pin, Cell.beside(optics.centre_m), seed=seed)
