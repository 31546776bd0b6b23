"""The simulated microscope: a camera that sees the true tip of a simulated machine."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from rotemina.drivers.cameras.camera import (
    CameraIdentity,
    FocusDrive,
    Picture,
    Wait,
)
from rotemina.drivers.cameras.errors import CameraLostError, CameraRefusedError, CameraSettingError
from rotemina.drivers.cameras.pace import Pace
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    PixelType,
    Trigger,
)
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.model_abilities import EffectCarrier
from rotemina.drivers.simulator.true_positions import TruePositions
from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.contact import CONTACT
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.chain import Chain
from rotemina.sim.kinematics.forward import tip_position, tool_axis
from rotemina.sim.messages import marked, message
from rotemina.sim.microscope.cell import UNTOUCHED, Cell, met
from rotemina.sim.microscope.renderer import EXPOSURE_S, Renderer
from rotemina.sim.microscope.scene import Scene
from rotemina.sim.robot.model import AxisEffect, Robot

RATE_HZ = 30.0
_FOCUS_RANGE_M = (-500e-6, 500e-6)
_EXPOSURES_S, _GAINS, _RATES_HZ = (1e-4, 1.0), (0.25, 16.0), (0.5, 100.0)


class SimulatedMicroscope(CameraSource):
    """A microscope over the simulated machine in use, if it is one.

    The driver belongs to a worker that alone talks to it: its newest true positions are looked at,
    as any thread may.

    Parameters
    ----------
    driver : callable
        Returns the driver in use now; the program exchanges it.
    clock, wait : callable
        As of :class:`Camera`.
    seed : int
        Of grains, dust and noise.
    mounting : mapping
        Fields of :class:`rotemina.sim.microscope.optics.Optics` that differ from the robot file's:
        how the camera is turned, for a calibration to find out.
    """

    name = marked("engine", "Simulated microscope")

    def __init__(
        self,
        driver: Callable[[], Driver | None],
        *,
        clock: Clock = time.monotonic,
        wait: Wait = time.sleep,
        seed: int = 0,
        mounting: Mapping[str, object] = MappingProxyType({}),
    ) -> None:
        super().__init__(clock=clock, wait=wait)
        self.driver, self.seed, self.mounting = driver, seed, dict(mounting)

    @property
    def problem(self) -> str | None:
        """Why it cannot look at the machine in use; see :class:`CameraSource`."""
        driver = self.driver()
        if driver is None or isinstance(driver, TruePositions):
            return None
        return message(
            "engine", "{name} shows only a simulated machine; connect the simulator"
        ).fill(name=driver.name)

    def devices(self) -> Sequence[CameraIdentity]:
        """Return the one microscope, if a simulated machine is in use."""
        found = isinstance(self.driver(), TruePositions)
        return (CameraIdentity("simulated:microscope", self.name, "simulated"),) if found else ()

    def camera(self, identity: CameraIdentity) -> "SimulatedCamera":
        """Return it; see :class:`CameraSource`."""
        return SimulatedCamera(identity, self)


class SimulatedCamera(FocusDrive):
    """Draws the scene of the machine's robot file.

    A machine that is disconnected stays where it was; one with another robot is another machine,
    and the picture is lost.
    """

    def __init__(self, identity: CameraIdentity, source: SimulatedMicroscope) -> None:
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._source = source
        self._focus_m = 0.0
        self._robot: Robot | None = None
        self._chain: Chain | None = None
        self._renderer: Renderer | None = None
        self._state = UNTOUCHED
        self._contact: AxisEffect | None = None  # what the cell is felt by
        self._joints = np.zeros(6)

    @property
    def scene(self) -> Scene:
        """What it looks at, and how: the truth that a calibration is compared with."""
        return self._drawing.scene

    @property
    def focus_m(self) -> float:
        """Depth of the focal plane; see :class:`FocusDrive`. 0: the tip in mid-range is sharp."""
        return self._focus_m

    @property
    def focus_range_m(self) -> tuple[float, float]:
        """How far it goes; see :class:`FocusDrive`."""
        return _FOCUS_RANGE_M

    def move_focus(self, focus_m: float) -> None:
        """Move the focal plane; see :class:`FocusDrive`."""
        low, high = _FOCUS_RANGE_M
        if not low <= focus_m <= high:
            raise CameraSettingError(
                message("engine", "{name}: focus at {focus_m} µm: must be {low} to {high} µm").fill(
                    name=self.name,
                    focus_m=focus_m * 1000000.0,
                    low=low * 1000000.0,
                    high=high * 1000000.0,
                )
            )
        self._focus_m = float(focus_m)

    def replace_cell(self) -> None:
        """Put an untouched cell in place of the present one."""
        self._state = UNTOUCHED

    @property
    def _drawing(self) -> Renderer:
        assert self._renderer is not None, "there is a scene while it is open"
        return self._renderer

    def _open(self) -> CameraDescription:
        driver = self._source.driver()
        if not isinstance(driver, TruePositions):
            raise CameraLostError(
                message(
                    "engine",
                    "{name}: there is no simulated machine; connect the simulator",
                ).fill(name=self.name)
            )
        try:
            chain = Chain.of(driver.robot)
            scene = Scene.of(driver.robot, seed=self._source.seed, **self._source.mounting)
        except InputError as error:
            raise CameraRefusedError(
                message("engine", "{name}: {error}").fill(name=self.name, error=str(error))
            ) from error
        self._robot, self._chain = driver.robot, chain
        self._renderer = Renderer(scene)
        self._rng = np.random.default_rng([self._source.seed, 1])
        self._state, self._contact = UNTOUCHED, None
        self._lost = 0
        self._pace = Pace(RATE_HZ, clock=self.clock, wait=self.wait)
        return CameraDescription(
            scene.optics.width,
            scene.optics.height,
            (PixelType.MONO16,),
            (Trigger.FREE, Trigger.SOFTWARE),
            _EXPOSURES_S,
            _GAINS,
            _RATES_HZ,
        )

    def _close(self) -> None:
        self._renderer = None

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        self._pace.change(max(1.0 / (settings.rate_hz or RATE_HZ), settings.exposure_s or 0.0))
        return settings

    def _grab(self, timeout_s: float) -> Picture | None:
        if self.settings.trigger is Trigger.FREE:
            beats = self._pace.beats(timeout_s)
            if not beats:
                return None
            self._lost += beats - 1
        joints = self._latest_joints()
        assert self._chain is not None
        self._look_for_contact(self._chain)
        scene, tip_m = self._drawing.scene, tip_position(self._chain, joints)
        if scene.cell is not None:
            self._state = met(scene.cell, self._state, tip_m)
        exposure_s, focus_m = self.settings.exposure_s or EXPOSURE_S, self._focus_m
        pixels = self._drawing.frame(
            tip_m,
            tool_axis(joints),
            focus_m,
            self._rng,
            self._state,
            exposure_s=exposure_s,
            gain=self.settings.gain or 1.0,
        )
        return Picture(
            pixels,
            scene.sensor.bits,
            self.clock(),
            exposure_s=exposure_s,
            lost=self._lost,
            metadata={"focus_m": focus_m, "pierced": self._state.pierced},
        )

    def _look_for_contact(self, chain: Chain) -> None:
        """Draw the cell where the tip feels one: where an effect ``contact`` was just put.

        One that is taken away while the tip is inside has given way, and stays.
        """
        driver = self._source.driver()
        if not (isinstance(driver, TruePositions) and isinstance(driver, EffectCarrier)):
            return
        felt = (one for one in driver.effects if one.enabled and one.id == CONTACT.id)
        contact = next(felt, None)
        if contact == self._contact:
            return
        self._contact = contact
        if contact is not None:
            self._drawing.use_cell(_cell_of(contact, driver, chain))
            self._state = UNTOUCHED
        elif self._state.entry_m is not None:
            self._state = replace(self._state, hole_m=self._state.entry_m)
        else:
            self._drawing.use_cell(Cell.beside(self._drawing.scene.optics.centre_m))
            self._state = UNTOUCHED

    def _latest_joints(self) -> FloatArray:
        """Return where the joints (6,) truly are, or were last."""
        driver, chain = self._source.driver(), self._chain
        assert chain is not None
        if isinstance(driver, TruePositions):
            if driver.robot is not self._robot and driver.robot != self._robot:
                raise CameraLostError(
                    message(
                        "engine",
                        "{name} was opened with another robot than {robot_name}, which is "
                        "now in use; close it and open it again",
                    ).fill(name=self.name, robot_name=repr(driver.robot.name))
                )
            self._joints = chain.joints_of(np.array(driver.true_positions))
        return self._joints


def _cell_of(contact: AxisEffect, driver: TruePositions, chain: Chain) -> Cell | None:
    """Return the cell that its axis meets, the others as they truly are; None: the tip stays."""
    values = Attached.of(driver.robot, contact).values
    column, axis = driver.axes.index(contact.axis), driver.robot.axes[contact.axis]
    before, there = (np.array(driver.true_positions) for _ in range(2))
    there[column] = axis.range[0] + values["place"]
    strength = values.get("stiffness", values.get("blocked", 0.0))
    before[column] = there[column] - np.copysign(1e-3 * axis.span, strength)
    begin, end = (tip_position(chain, chain.joints_of(one)) for one in (before, there))
    return Cell.met_at(end, end - begin) if (end != begin).any() else None
