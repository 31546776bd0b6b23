"""The scene under the microscope and its lighting, without the position of the tip."""

from dataclasses import dataclass, field
from math import pi
from typing import Self

from rotemina.sim.errors import SceneError
from rotemina.sim.microscope.cell import SimulatedCell
from rotemina.sim.microscope.optics import MicroscopeOptics
from rotemina.sim.robot import Robot

# Approach angle if the robot file gives none.
_DEFAULT_APPROACH_RAD = pi / 6


@dataclass(frozen=True, slots=True)
class TaperedPin:
    """The pin or pipette: a tapering tube whose end is the tip of the kinematics.

    Attributes
    ----------
    approach_rad : float
        Angle between the body and the dish; π/2 is upright. The body leans towards +x.
    tip_radius_m, shank_radius_m : float
        Radius at the tip, and the largest radius.
    taper : float
        Growth of the radius per length.
    wall, lumen : float
        Share of the light lost in the tube, and share regained through its bore.
    bore : float
        Radius of the bore over the radius of the tube.
    """

    approach_rad: float = _DEFAULT_APPROACH_RAD
    tip_radius_m: float = 0.75e-6
    shank_radius_m: float = 60e-6
    taper: float = 0.06
    wall_opacity: float = 0.55
    lumen_gain: float = 0.3
    bore_ratio: float = 0.6

    def __post_init__(self) -> None:
        if not 0.0 < self.approach_rad <= pi / 2:
            raise SceneError(
                "tool: approach_angle = {approach_rad} rad: must be more than 0 (flat on the "
                "dish) and at most {pi} (upright)",
                approach_rad=self.approach_rad,
                pi=pi / 2,
            )


@dataclass(frozen=True, slots=True)
class SceneLighting:
    """Illumination of the scene and its unevenness.

    Attributes
    ----------
    rate : float
        Photoelectrons per pixel and second in the middle.
    vignetting : float
        Share lost in the corners. The loss grows with the square of the distance from the middle.
    gradient : tuple of float
        Change across the whole width and height, as a share.
    dust : float
        Contrast of dust, which is never in focus and never moves, as a share.
    """

    rate: float = 5e5
    vignetting: float = 0.2
    gradient: tuple[float, float] = (0.10, -0.06)
    dust: float = 0.01


@dataclass(frozen=True, slots=True)
class CameraSensor:
    """Image sensor and converter of the camera.

    Attributes
    ----------
    bits : int
        Bits per pixel.
    full_well : float
        Largest number of photoelectrons in a pixel.
    read_noise : float
        Standard deviation of the read noise, photoelectrons.
    electrons_per_number : float
        Photoelectrons per step of the pixel value, at gain 1.
    black_level : float
        Value of a pixel without light.
    """

    bits: int = 12
    full_well: float = 17_000.0
    read_noise: float = 8.0
    electrons_per_number: float = 4.0
    black_level: float = 40.0

    @property
    def max_number(self) -> int:
        """Value of a saturated pixel."""
        return (1 << self.bits) - 1


@dataclass(frozen=True, slots=True)
class MicroscopeScene:
    """A complete scene. ``seed`` determines grains and dust, but not the noise of a frame."""

    optics: MicroscopeOptics = field(default_factory=MicroscopeOptics)
    pin: TaperedPin = field(default_factory=TaperedPin)
    cell: SimulatedCell | None = None
    light: SceneLighting = field(default_factory=SceneLighting)
    sensor: CameraSensor = field(default_factory=CameraSensor)
    seed: int = 0

    @classmethod
    def of(cls, robot: Robot, *, seed: int = 0, **mounting: object) -> Self:
        """Return the scene of a robot file, with a cell near the middle of the view.

        ``mounting`` are fields of :class:`MicroscopeOptics`.
        """
        optics = MicroscopeOptics.of(robot, **mounting)
        angle = robot.tool.approach_angle
        pin = TaperedPin(_DEFAULT_APPROACH_RAD if angle is None else angle)
        return cls(optics, pin, SimulatedCell.near_view_centre(optics.centre_m), seed=seed)
