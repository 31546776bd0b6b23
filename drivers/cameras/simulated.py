"""The simulated microscope: a camera that shows the true tip of a simulated machine."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from rotemina.drivers.abilities import EffectCarrier, TruePositions
from rotemina.drivers.cameras.camera import (
    CameraIdentity,
    FocusDrive,
    RawFrame,
    Wait,
)
from rotemina.drivers.cameras.frame import PixelType
from rotemina.drivers.cameras.pace import FramePacer
from rotemina.drivers.cameras.settings import (
    CameraDescription,
    CameraSettings,
    CameraTrigger,
)
from rotemina.drivers.cameras.source import CameraSource
from rotemina.drivers.contract import (
    CameraLostError,
    CameraRefusedError,
    CameraSettingError,
    Clock,
    Driver,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import CONTACT, AttachedEffect
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics import KinematicChain, compute_tip_position, compute_tool_axis
from rotemina.sim.messages import marked, message
from rotemina.sim.microscope import (
    DEFAULT_EXPOSURE_S,
    UNTOUCHED_CELL_STATE,
    MicroscopeScene,
    SceneRenderer,
    SimulatedCell,
    advance_cell_state,
)
from rotemina.sim.robot import AxisEffect, Robot

DEFAULT_RATE_HZ = 30.0
_FOCUS_RANGE_M = (-500e-6, 500e-6)
_EXPOSURE_RANGE_S, _GAIN_RANGE, _RATE_RANGE_HZ = (1e-4, 1.0), (0.25, 16.0), (0.5, 100.0)


class SimulatedMicroscope(CameraSource):
    """Source of the microscope above the simulated machine in use.

    Only the worker thread of the driver may call its methods. This class only reads the newest true
    positions, which any thread may do.

    Parameters
    ----------
    driver : callable
        Returns the driver in use, which may be replaced while the program runs.
    clock, wait : callable
        See :class:`Camera`.
    seed : int
        Seed of grains, dust and noise.
    mounting : mapping
        Fields of :class:`rotemina.sim.microscope.optics.MicroscopeOptics` that override the robot
        file, such as a rotation of the camera that a calibration has to find.
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
        """Why the machine in use cannot be shown; see :class:`CameraSource`."""
        driver = self.driver()
        if driver is None or isinstance(driver, TruePositions):
            return None
        return message(
            "engine", "{name} shows only a simulated machine; connect the simulator"
        ).fill(name=driver.name)

    def devices(self) -> Sequence[CameraIdentity]:
        """Return the microscope, if a simulated machine is in use."""
        is_simulated = isinstance(self.driver(), TruePositions)
        return (
            (CameraIdentity("simulated:microscope", self.name, "simulated"),)
            if is_simulated
            else ()
        )

    def camera(self, identity: CameraIdentity) -> "SimulatedCamera":
        """Return the camera; see :class:`CameraSource`."""
        return SimulatedCamera(identity, self)


class SimulatedCamera(FocusDrive):
    """A camera that draws the scene that the machine's robot file describes.

    After the machine is disconnected, the last position is shown. If a machine with another robot
    is in use, the camera is lost.
    """

    def __init__(self, identity: CameraIdentity, source: SimulatedMicroscope) -> None:
        super().__init__(identity, clock=source.clock, wait=source.wait)
        self._source = source
        self._focus_m = 0.0
        self._robot: Robot | None = None
        self._chain: KinematicChain | None = None
        self._renderer: SceneRenderer | None = None
        self._cell_state = UNTOUCHED_CELL_STATE
        # The effect that exerts the contact force of the cell.
        self._contact: AxisEffect | None = None
        self._joints = np.zeros(6)

    @property
    def scene(self) -> MicroscopeScene:
        """The scene with its optics: the true values, to check a calibration against."""
        return self._open_renderer.scene

    @property
    def focus_m(self) -> float:
        """Position of the focal plane; see :class:`FocusDrive`.

        At 0 the tip is in focus when all axes are at mid-range.
        """
        return self._focus_m

    @property
    def focus_range_m(self) -> tuple[float, float]:
        """Lowest and highest position of the focal plane; see :class:`FocusDrive`."""
        return _FOCUS_RANGE_M

    def move_focus(self, focus_m: float) -> None:
        """Move the focal plane; see :class:`FocusDrive`."""
        low, high = _FOCUS_RANGE_M
        if not low <= focus_m <= high:
            raise CameraSettingError(
                "{name}: focus at {focus_m} µm: must be {low} to {high} µm",
                name=self.name,
                focus_m=focus_m * 1000000.0,
                low=low * 1000000.0,
                high=high * 1000000.0,
            )
        self._focus_m = float(focus_m)

    def replace_cell(self) -> None:
        """Replace the cell with an untouched one."""
        self._cell_state = UNTOUCHED_CELL_STATE

    @property
    def _open_renderer(self) -> SceneRenderer:
        assert self._renderer is not None, "an open camera has a renderer"
        return self._renderer

    def _open(self) -> CameraDescription:
        driver = self._source.driver()
        if not isinstance(driver, TruePositions):
            raise CameraLostError(
                "{name}: there is no simulated machine; connect the simulator", name=self.name
            )
        try:
            chain = KinematicChain.of(driver.robot)
            scene = MicroscopeScene.of(
                driver.robot, seed=self._source.seed, **self._source.mounting
            )
        except InputError as error:
            raise CameraRefusedError("{name}: {error}", name=self.name, error=str(error)) from error
        self._robot, self._chain = driver.robot, chain
        self._renderer = SceneRenderer(scene)
        self._rng = np.random.default_rng([self._source.seed, 1])
        self._cell_state, self._contact = UNTOUCHED_CELL_STATE, None
        self._lost_count = 0
        self._pacer = FramePacer(DEFAULT_RATE_HZ, clock=self.clock, wait=self.wait)
        return CameraDescription(
            scene.optics.width,
            scene.optics.height,
            (PixelType.MONO16,),
            (CameraTrigger.FREE, CameraTrigger.SOFTWARE),
            _EXPOSURE_RANGE_S,
            _GAIN_RANGE,
            _RATE_RANGE_HZ,
        )

    def _close(self) -> None:
        self._renderer = None

    def _configure(self, settings: CameraSettings) -> CameraSettings:
        self._pacer.set_period(
            max(1.0 / (settings.rate_hz or DEFAULT_RATE_HZ), settings.exposure_s or 0.0)
        )
        return settings

    def _grab(self, timeout_s: float) -> RawFrame | None:
        if self.settings.trigger is CameraTrigger.FREE:
            due_count = self._pacer.wait_for_frame(timeout_s)
            if not due_count:
                return None
            self._lost_count += due_count - 1
        joints = self._read_joints()
        assert self._chain is not None
        self._update_cell(self._chain)
        scene, tip_m = self._open_renderer.scene, compute_tip_position(self._chain, joints)
        if scene.cell is not None:
            self._cell_state = advance_cell_state(scene.cell, self._cell_state, tip_m)
        exposure_s, focus_m = self.settings.exposure_s or DEFAULT_EXPOSURE_S, self._focus_m
        pixels = self._open_renderer.render_frame(
            tip_m,
            compute_tool_axis(joints),
            focus_m,
            self._rng,
            self._cell_state,
            exposure_s=exposure_s,
            gain=self.settings.gain or 1.0,
        )
        return RawFrame(
            pixels,
            scene.sensor.bits,
            self.clock(),
            exposure_s=exposure_s,
            lost=self._lost_count,
            metadata={"focus_m": focus_m, "pierced": self._cell_state.is_pierced},
        )

    def _update_cell(self, chain: KinematicChain) -> None:
        """Draw the cell at the position where the effect ``contact`` exerts its force.

        If the effect is switched off while the tip is inside the cell, the pierced cell is kept.
        """
        driver = self._source.driver()
        if not (isinstance(driver, TruePositions) and isinstance(driver, EffectCarrier)):
            return
        active_contacts = (
            effect for effect in driver.effects if effect.enabled and effect.id == CONTACT.id
        )
        contact = next(active_contacts, None)
        if contact == self._contact:
            return
        self._contact = contact
        if contact is not None:
            self._open_renderer.use_cell(_make_cell(contact, driver, chain))
            self._cell_state = UNTOUCHED_CELL_STATE
        elif self._cell_state.entry_m is not None:
            self._cell_state = replace(self._cell_state, hole_m=self._cell_state.entry_m)
        else:
            self._open_renderer.use_cell(
                SimulatedCell.near_view_centre(self._open_renderer.scene.optics.centre_m)
            )
            self._cell_state = UNTOUCHED_CELL_STATE

    def _read_joints(self) -> FloatArray:
        """Return the true joint positions (6,), or the last known ones."""
        driver, chain = self._source.driver(), self._chain
        assert chain is not None
        if isinstance(driver, TruePositions):
            if driver.robot is not self._robot and driver.robot != self._robot:
                raise CameraLostError(
                    "{name} was opened for another robot than {robot_name}, which is now in "
                    "use; close it and open it again",
                    name=self.name,
                    robot_name=repr(driver.robot.name),
                )
            self._joints = chain.select_joints(np.array(driver.true_positions))
        return self._joints


def _make_cell(
    contact: AxisEffect, driver: TruePositions, chain: KinematicChain
) -> SimulatedCell | None:
    """Return the cell at the point where the tip meets it when the contact's axis moves.

    The other axes are at their true positions. Return None if the axis does not move the tip.
    """
    values = AttachedEffect.of(driver.robot, contact).values
    column, axis = driver.axes.index(contact.axis), driver.robot.axes[contact.axis]
    before, at_contact = (np.array(driver.true_positions) for _ in range(2))
    at_contact[column] = axis.range[0] + values["place"]
    strength = values.get("stiffness", values.get("blocked", 0.0))
    before[column] = at_contact[column] - np.copysign(1e-3 * axis.span, strength)
    begin, end = (
        compute_tip_position(chain, chain.select_joints(axes)) for axes in (before, at_contact)
    )
    return SimulatedCell.with_contact_at(end, end - begin) if (end != begin).any() else None
