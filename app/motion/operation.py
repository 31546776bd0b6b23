"""The periodic loop that executes all operator actions of a session.

The loop reads the devices, steers the machine accordingly, steps a penetration, and records all of
it during a recording. It is independent of Qt: panels of the window show it and request the rest.
"""

import threading
import time
from collections.abc import Callable, Mapping
from datetime import datetime
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from rotemina.app.calibration.store import CalibrationStore
from rotemina.app.motion.front_display import FrontDisplay
from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.arming import prepared
from rotemina.app.motion.penetration.cell_list import CellList
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.run_log import RunLog
from rotemina.app.motion.recording.arrow_tables import prepare
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.teleoperation.input_devices import InputDevices, InputSnapshot
from rotemina.app.motion.teleoperation.intent import Action, Intent
from rotemina.app.motion.teleoperation.recentring import (
    Recentring,
    plan_recentring,
    plan_with_tip_held,
)
from rotemina.app.motion.teleoperation.scales import Scales
from rotemina.app.motion.teleoperation.teleoperation_loop import Teleoperator
from rotemina.app.motion.ticker import Ticker
from rotemina.drivers.clock import Clock
from rotemina.drivers.inputs.board import BoardInputs
from rotemina.drivers.inputs.device import InputSource
from rotemina.drivers.inputs.hub import InputHub
from rotemina.drivers.inputs.pad import Pad
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.kinematics.chain import JOINTS, Chain, ChainError
from rotemina.sim.messages import message

T = TypeVar("T")

STEP_S, LOOK_S, DISPLAY_S = 0.005, 1.0, 0.5
#: What the pad on the screen can hold. Everything else has buttons of its own there, and a dead-man
#: of the pad would only keep it from acting.
PAD_BUTTONS = (Action.CLUTCH, Action.FINE, Action.COARSE, Action.TAKE_OVER)
PAD_LEASE_S = 0.5  # of a screen that hangs while something is held on it
SCALES, PENETRATION = "scales.toml", "penetration.toml"
_RUMBLE_STEP = 0.05  # a change that no hand feels is not sent


class Operation:
    """The operator's side of a session.

    Parameters
    ----------
    session : MotionSession
    folder : Path
        Of the user's profiles, calibrations, scales and parameters of the penetration.
    data : Path
        Of recordings and of the log of penetrations.
    sources : mapping of str to InputSource
        Of input devices, beside the installed ones, the controller's own and the pad.
    clock : callable
        The host's; the session's too.
    told : callable
        Gets what the operator must know and no state shows, on any thread.
    """

    def __init__(
        self,
        session: MotionSession,
        folder: Path,
        data: Path,
        *,
        sources: Mapping[str, InputSource] = MappingProxyType({}),
        clock: Clock = time.monotonic,
        told: Callable[[str], None] = lambda _: None,
    ) -> None:
        self.session = session
        self.data = data
        self.clock = clock
        self._told = told
        self._scales_file = folder / SCALES
        self._penetration_file = folder / PENETRATION
        #: What is wrong with files of the user's, told at the start.
        self.problems: list[str] = []
        #: Calibrations of sensors: those that are on correct readings from the start.
        self.calibrations = CalibrationStore(folder, session.robot)
        self.problems += self.calibrations.apply(session.corrections)
        #: The pad on the screen and its keys: a device like any other.
        self.pad = Pad("pad", buttons=PAD_BUTTONS, lease_s=PAD_LEASE_S, clock=clock)
        own = {
            "board": BoardInputs(lambda: session.driver, clock=clock),
            "pad": self.pad,
            **sources,
        }
        hub = InputHub.installed(own, clock=clock)
        self.devices = InputDevices(hub, tuple(session.robot.axes), folder)
        scales = self._kept(Scales.load, self._scales_file, Scales)
        self.teleoperator = Teleoperator(session, scales)
        self.display = FrontDisplay(session, lambda: self.teleoperator.state.mode)
        self.penetration_log = RunLog(data / "penetrations.jsonl")
        self.penetration = Penetration(session, self.penetration_log)
        self.penetration_parameters = self._kept(
            PenetrationParameters.kept, self._penetration_file, PenetrationParameters
        )
        #: To be penetrated one after the other; for the thread of whoever shows them.
        self.cells = CellList()
        self.intent = Intent(0.0)
        self._recorder: SessionRecorder | None = None
        self._recorder_lock = threading.Lock()
        self._closing = False
        self._rumbled = 0.0
        self._planning: threading.Thread | None = None
        self._tickers = (
            Ticker("operation", STEP_S, lambda: self.step(self.clock()), self._step_failed),
            Ticker("input devices", LOOK_S, self.devices.look),
            Ticker("display", DISPLAY_S, lambda: self.display.step(self.clock())),
        )

    def start(self) -> None:
        """Begin to listen to the input devices, on threads of their own."""
        for problem in self.problems:
            self._told(problem)
        for ticker in self._tickers:
            ticker.start()

    def close(self) -> None:
        """Stop sticks and penetration, end a recording, release the devices."""
        for ticker in self._tickers:
            ticker.close()
        if self.teleoperator.state.driving:
            self.session.stop(message("engine", "the input devices are released"))
        self.penetration.close()
        self.devices.close()
        if self._planning is not None:
            self._planning.join()
        with self._recorder_lock:  # one that begins just now is waited for
            self._closing = True
        if self.recording is not None:
            try:
                self.stop_recording()
            except InputError as error:  # what was recorded is in its folder, and is told at start
                self._told(str(error))

    def step(self, now_s: float) -> None:
        """Read the devices and execute their requests; for a separate loop, or for a test."""
        snapshot = self.devices.step(now_s)
        self.intent = snapshot.intent
        self._act(snapshot.intent, now_s)
        self.teleoperator.step(snapshot.intent, now_s)
        self.penetration.step(now_s)
        self._rumble()
        self._record(snapshot)

    # --- what buttons ask for ---------------------------------------------------------------------

    def press_penetration(self) -> None:
        """Press the penetration's button: start the run, or retract.

        Raises
        ------
        InputError
            As :meth:`Penetration.press`.
        """
        self.penetration.press(self.clock())

    def arm_penetration(self, parameters: PenetrationParameters) -> None:
        """Arm it; nothing moves until the button is pressed.

        Raises
        ------
        InputError
            As :meth:`Penetration.arm`.
        """
        self.penetration.arm(parameters, self.clock())

    def keep_penetration(self, parameters: PenetrationParameters) -> None:
        """Keep parameters for the next time, also that of another start.

        Raises
        ------
        FileWriteError
            If they cannot be written; they are known until the program ends all the same.
        """
        self.penetration_parameters = parameters
        parameters.save(self._penetration_file)

    def toggle_tool(self) -> None:
        """Switch the tool on or off.

        Raises
        ------
        RefusedError
            If there is none, or as :meth:`Tool.switch`.
        """
        self.session.tool.switch(not self.session.tool.on)

    def recentre(self, joints: tuple[str, ...] = ("zn",)) -> None:
        """Move nano joints to mid-range while the tip stays; planned on a separate thread.

        Raises
        ------
        RefusedError
            If the machine is not at rest, or one is being planned.
        InputError
            If the robot has no such joints.
        """
        chain = Chain.of(self.session.robot)
        self._play_planned(
            "Re-centring",
            lambda command, period_s: plan_recentring(chain, command, period_s, joints),
        )

    def prepare_penetration(self, parameters: PenetrationParameters) -> None:
        """Move the nano stage back as far as a penetration needs, while the tip stays.

        Planned on a separate thread. The penetration is not armed.

        Raises
        ------
        RefusedError
            As :meth:`recentre`.
        InputError
            As :func:`rotemina.app.motion.penetration.arming.prepared`.
        """
        chain = Chain.of(self.session.robot)
        targets = prepared(self.session, parameters)
        self._play_planned(
            "Preparing",
            lambda command, period_s: plan_with_tip_held(chain, command, period_s, targets),
        )

    def _play_planned(
        self, what: str, planned: Callable[[Mapping[str, float], float], Recentring]
    ) -> None:
        """Plan on a separate thread from the position of rest, and play the result."""
        if self._planning is not None and self._planning.is_alive():
            raise RefusedError(
                message("engine", "a motion of the nano stage is being planned; wait")
            )
        permit = self.session.permit()
        state = self.session.snapshot()
        if state.locked is not None:
            raise RefusedError(
                message("engine", "motion is locked: {locked}").fill(locked=state.locked)
            )
        if state.activity is not DeviceState.IDLE or state.queued:
            raise RefusedError(
                message("engine", "the machine is still moving; release the stick first")
            )
        period_s = self.session.setpoint_period_s

        def plan() -> None:
            try:
                way = planned(state.command, period_s)
                now = {**state.command, **self.session.snapshot().command}
                if any(now[axis] != state.command[axis] for axis in JOINTS):
                    raise RefusedError(
                        message("engine", "the machine has moved in the meantime; try again")
                    )
                self.session.play(way.trajectory, permit=permit, shown=False)
            except InputError as error:
                self._told(
                    message("engine", "{what}: {error}").fill(what=what, error=reason_of(error))
                )

        self._planning = threading.Thread(target=plan, name="nano stage", daemon=True)
        self._planning.start()

    def use_scales(self, scales: Scales) -> None:
        """Use other scales, and keep them.

        Raises
        ------
        ScalingError
            As :meth:`Teleoperator.use_scales`.
        FileWriteError
            If they cannot be kept; they are used all the same.
        """
        self.teleoperator.use_scales(scales)
        scales.save(self._scales_file)

    # --- recorder ---------------------------------------------------------------------------------

    @property
    def recording(self) -> SessionRecorder | None:
        """What records now; None: nothing does."""
        return self._recorder

    @property
    def recordings(self) -> Path:
        """The folder of recordings."""
        return self.data / "recordings"

    def start_recording(
        self, settings: Mapping[str, object] = MappingProxyType({}), *, name: str = ""
    ) -> Path:
        """Record everything from now on, and return into which file.

        ``name`` is what the library calls it, its time where that is empty.

        Raises
        ------
        RefusedError
            If something is being recorded.
        RecordingError
            If no file can be made.
        """
        with self._recorder_lock:
            if self._closing:
                raise RefusedError(message("engine", "the program is being closed"))
            if self._recorder is not None:
                raise RefusedError(message("engine", "a recording is running; end it first"))
            prepare()  # it takes a while the first time, in which nothing is recorded yet
            began = datetime.now().astimezone()
            stem = "_".join(filter(None, (f"{began:%Y-%m-%d_%H-%M-%S-%f}", name)))
            path = self.recordings / f"{stem}.arrows"
            try:
                self.recordings.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise RecordingError(
                    message("engine", "{folder}: the folder cannot be created ({reason})").fill(
                        folder=self.recordings, reason=str(error.strerror or str(error))
                    )
                ) from error
            recorder = SessionRecorder(
                self.session,
                path,
                settings=settings,
                began=began.isoformat(timespec="seconds"),
                clock=self.clock,
                tell=self._recorder_told,
            )
            recorder.start()
            self._recorder = recorder
            return path

    def stop_recording(self) -> Path:
        """End the recording, and return the finished file; takes as long as copying it.

        Raises
        ------
        RefusedError
            If nothing is being recorded.
        RecordingError
            If it cannot be finished; what was recorded stays to be recovered.
        """
        with self._recorder_lock:
            recorder, self._recorder = self._recorder, None
        if recorder is None:
            raise RefusedError(message("engine", "nothing is being recorded"))
        return recorder.close()

    # --- inside -----------------------------------------------------------------------------------

    def _act(self, intent: Intent, now_s: float) -> None:
        requests: dict[Action, Callable[[], None]] = {
            Action.PENETRATION: lambda: self.penetration.press(now_s),
            Action.TOOL: self.toggle_tool,
            Action.RECENTRE: self.recentre,
        }
        for action, request in requests.items():
            if action in intent.pressed:
                try:
                    request()
                except InputError as error:
                    self._told(str(error))

    def _rumble(self) -> None:
        strength = max((abs(one.felt) for one in self.teleoperator.state.coordinates), default=0.0)
        strength = min(strength, 1.0)
        gone = strength == 0.0 and self._rumbled != 0.0
        if gone or abs(strength - self._rumbled) >= _RUMBLE_STEP:
            self._rumbled = strength
            self.devices.rumble(strength)

    def _record(self, snapshot: InputSnapshot) -> None:
        recorder = self._recorder
        if recorder is None:
            return
        for key, readings in snapshot.readings.items():
            device = self.devices.device(key)
            if device is not None:
                for reading in readings:
                    recorder.record_reading(device, reading)
        recorder.record_intent(snapshot.intent)

    def _recorder_told(self, notice: str) -> None:
        self._told(message("engine", "Recorder: {message}").fill(message=notice))

    def _step_failed(self, error: Exception) -> None:
        self._told(
            message("engine", "The loop of the input devices failed: {name}: {error}").fill(
                name=type(error).__name__, error=reason_of(error)
            )
        )

    def _kept(self, load: Callable[[Path], T], path: Path, presets: Callable[[], T]) -> T:
        try:
            return load(path)
        except InputError as error:
            self.problems.append(
                message("engine", "{error}; presets are used").fill(error=reason_of(error))
            )
            return presets()


def has_tip(session: MotionSession) -> bool:
    """Whether the robot has a tip that can be held while the nano stage moves."""
    try:
        Chain.of(session.robot)
    except ChainError:
        return False
    return True
