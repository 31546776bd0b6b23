"""The periodic loop that executes all actions of an operator in a session.

The loop reads the input devices, steers the machine, steps a penetration, and adds all of this to a
running recording. It is independent of Qt: the panels of the window show its state and call its
methods.
"""

import threading
import time
from collections.abc import Callable, Mapping
from datetime import datetime
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from rotemina.app.calibration import CalibrationStore
from rotemina.app.errors import RecordingError, RequestRefusedError
from rotemina.app.motion.device import Ticker
from rotemina.app.motion.inputs import InputDevices, InputSnapshot, Intent, OperatorAction
from rotemina.app.motion.penetration import (
    CellList,
    PenetrationController,
    PenetrationParameters,
    RunLog,
    compute_start_targets,
)
from rotemina.app.motion.recording import SessionRecorder, load_arrow
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.teleoperation import (
    ModeScales,
    RecentringPlan,
    Teleoperator,
    plan_recentring,
    plan_with_tip_held,
)
from rotemina.app.operation.front_display import FrontDisplay
from rotemina.drivers.contract import Clock, DeviceState
from rotemina.drivers.inputs import BoardJoystickSource, InputHub, InputPad, InputSource
from rotemina.sim.errors import ChainError, InputError, describe_exception
from rotemina.sim.kinematics import JOINTS, KinematicChain
from rotemina.sim.messages import message

T = TypeVar("T")

STEP_PERIOD_S, DEVICE_SCAN_PERIOD_S, DISPLAY_PERIOD_S = 0.005, 1.0, 0.5
#: Buttons of the on-screen pad. All other actions have their own buttons in the window. The pad has
#: no dead-man button, because such a button would only block the pad.
PAD_BUTTONS = (
    OperatorAction.CLUTCH,
    OperatorAction.FINE,
    OperatorAction.COARSE,
    OperatorAction.TAKE_OVER,
)
# If the window hangs, controls that are held on the pad are released after this time.
PAD_LEASE_S = 0.5
SCALES_FILE, PENETRATION_FILE = "scales.toml", "penetration.toml"
# Smaller changes of the rumble are not felt, so they are not sent.
_MIN_RUMBLE_CHANGE = 0.05


class OperatorControl:
    """The operator's side of a session: input devices, steering, penetration, recordings.

    Parameters
    ----------
    session : MotionSession
    folder : Path
        Folder of the user's profiles, calibrations, scales and penetration parameters.
    data : Path
        Folder of recordings and of the log of penetrations.
    sources : mapping of str to InputSource
        Sources of input devices, in addition to the installed ones, the controller's own and the
        on-screen pad.
    clock : callable
        The host's clock, which the session uses too.
    notify : callable
        Called, on any thread, with each message to the operator that is not part of a state.
    """

    def __init__(
        self,
        session: MotionSession,
        folder: Path,
        data: Path,
        *,
        sources: Mapping[str, InputSource] = MappingProxyType({}),
        clock: Clock = time.monotonic,
        notify: Callable[[str], None] = lambda _: None,
    ) -> None:
        self.session = session
        self.data = data
        self.clock = clock
        self._notify = notify
        self._scales_file = folder / SCALES_FILE
        self._penetration_file = folder / PENETRATION_FILE
        #: Problems with the user's files, which :meth:`start` reports.
        self.problems: list[str] = []
        #: Calibrations of sensors; those in use correct the readings from the start.
        self.calibrations = CalibrationStore(folder, session.robot)
        self.problems += self.calibrations.apply(session.corrections)
        #: The on-screen pad and its keys, an input device like any other.
        self.pad = InputPad("pad", buttons=PAD_BUTTONS, lease_s=PAD_LEASE_S, clock=clock)
        all_sources = {
            "board": BoardJoystickSource(lambda: session.driver, clock=clock),
            "pad": self.pad,
            **sources,
        }
        hub = InputHub.from_plugins(all_sources, clock=clock)
        self.devices = InputDevices(hub, tuple(session.robot.axes), folder)
        scales = self._load_or_use_presets(ModeScales.load, self._scales_file, ModeScales)
        self.teleoperator = Teleoperator(session, scales)
        self.display = FrontDisplay(session, lambda: self.teleoperator.state.mode)
        self.penetration_log = RunLog(data / "penetrations.jsonl")
        self.penetration = PenetrationController(session, self.penetration_log)
        self.penetration_parameters = self._load_or_use_presets(
            PenetrationParameters.load_or_default, self._penetration_file, PenetrationParameters
        )
        #: Cells to be penetrated one after the other; used only by the thread that shows them.
        self.cells = CellList()
        self.intent = Intent(0.0)
        self._recorder: SessionRecorder | None = None
        self._recorder_lock = threading.Lock()
        self._is_closing = False
        self._latest_rumble = 0.0
        self._planning_thread: threading.Thread | None = None
        self._tickers = (
            Ticker(
                "operation", STEP_PERIOD_S, lambda: self.step(self.clock()), self._on_step_failed
            ),
            Ticker("input devices", DEVICE_SCAN_PERIOD_S, self.devices.detect_changes),
            Ticker("display", DISPLAY_PERIOD_S, lambda: self.display.step(self.clock())),
        )

    def start(self) -> None:
        """Begin to read the input devices, on separate threads."""
        for problem in self.problems:
            self._notify(problem)
        for ticker in self._tickers:
            ticker.start()

    def close(self) -> None:
        """Stop steering and the penetration, end a recording, and release the devices."""
        for ticker in self._tickers:
            ticker.close()
        if self.teleoperator.state.is_driving:
            self.session.stop(message("engine", "the input devices are released"))
        self.penetration.close()
        self.devices.close()
        if self._planning_thread is not None:
            self._planning_thread.join()
        # Acquiring the lock waits until a recording that is just beginning has begun.
        with self._recorder_lock:
            self._is_closing = True
        if self.recording is not None:
            try:
                self.stop_recording()
            except InputError as error:
                # The recorded part stays in its folder and is reported at the next start.
                self._notify(str(error))

    def step(self, now_s: float) -> None:
        """Read the devices and execute their requests. Tests call this too."""
        snapshot = self.devices.step(now_s)
        self.intent = snapshot.intent
        self._handle_actions(snapshot.intent, now_s)
        self.teleoperator.step(snapshot.intent, now_s)
        self.penetration.step(now_s)
        self._rumble()
        self._record(snapshot)

    def press_penetration(self) -> None:
        """Press the penetration button, which starts the run or retracts the pin.

        Raises
        ------
        InputError
            See :meth:`PenetrationController.press_button`.
        """
        self.penetration.press_button(self.clock())

    def arm_penetration(self, parameters: PenetrationParameters) -> None:
        """Arm the penetration; nothing moves until the button is pressed.

        Raises
        ------
        InputError
            See :meth:`PenetrationController.arm`.
        """
        self.penetration.arm(parameters, self.clock())

    def save_penetration_parameters(self, parameters: PenetrationParameters) -> None:
        """Save parameters for the next penetration, also after a restart of the program.

        Raises
        ------
        FileWriteError
            If they cannot be saved. They are then used until the program ends.
        """
        self.penetration_parameters = parameters
        parameters.save(self._penetration_file)

    def toggle_tool(self) -> None:
        """Switch the tool on or off.

        Raises
        ------
        RequestRefusedError
            If there is no tool. See also :meth:`ToolSwitch.switch`.
        """
        self.session.tool.switch(not self.session.tool.is_on)

    def recentre(self, joints: tuple[str, ...] = ("zn",)) -> None:
        """Move nano joints to mid-range while the tip stays in place.

        The motion is planned on a separate thread.

        Raises
        ------
        RequestRefusedError
            If the machine is not at rest, or another motion is being planned.
        InputError
            If the robot does not have these joints.
        """
        chain = KinematicChain.of(self.session.robot)
        self._play_planned(
            "Re-centring",
            lambda command, period_s: plan_recentring(chain, command, period_s, joints),
        )

    def prepare_penetration(self, parameters: PenetrationParameters) -> None:
        """Move the nano stage back to where a penetration has room, while the tip stays in place.

        The motion is planned on a separate thread. The penetration is not armed.

        Raises
        ------
        RequestRefusedError
            See :meth:`recentre`.
        InputError
            See :func:`rotemina.app.motion.penetration.compute_start_targets`.
        """
        chain = KinematicChain.of(self.session.robot)
        targets = compute_start_targets(self.session, parameters)
        self._play_planned(
            "Preparing",
            lambda command, period_s: plan_with_tip_held(chain, command, period_s, targets),
        )

    def _play_planned(
        self, title: str, make_plan: Callable[[Mapping[str, float], float], RecentringPlan]
    ) -> None:
        """Plan a motion from the current position at rest on a separate thread, and play it."""
        if self._planning_thread is not None and self._planning_thread.is_alive():
            raise RequestRefusedError("a motion of the nano stage is being planned; wait")
        permit = self.session.permit()
        state = self.session.snapshot()
        if state.lock_reason is not None:
            raise RequestRefusedError("motion is locked: {locked}", locked=state.lock_reason)
        if state.activity is not DeviceState.IDLE or state.queued:
            raise RequestRefusedError("the machine is still moving; release the stick first")
        period_s = self.session.setpoint_period_s

        def plan() -> None:
            try:
                motion_plan = make_plan(state.command, period_s)
                current_command = {**state.command, **self.session.snapshot().command}
                if any(current_command[axis] != state.command[axis] for axis in JOINTS):
                    raise RequestRefusedError("the machine has moved in the meantime; try again")
                self.session.play(motion_plan.trajectory, permit=permit, shown=False)
            except InputError as error:
                self._notify(
                    message("engine", "{what}: {error}").fill(
                        what=title, error=describe_exception(error)
                    )
                )

        self._planning_thread = threading.Thread(target=plan, name="nano stage", daemon=True)
        self._planning_thread.start()

    def use_scales(self, scales: ModeScales) -> None:
        """Use other scales, and save them.

        Raises
        ------
        ScalingError
            See :meth:`Teleoperator.use_scales`.
        FileWriteError
            If they cannot be saved. They are then used until the program ends.
        """
        self.teleoperator.use_scales(scales)
        scales.save(self._scales_file)

    @property
    def recording(self) -> SessionRecorder | None:
        """The recorder of the running recording, or None."""
        return self._recorder

    @property
    def recordings(self) -> Path:
        """The folder of recordings."""
        return self.data / "recordings"

    def start_recording(
        self, settings: Mapping[str, object] = MappingProxyType({}), *, name: str = ""
    ) -> Path:
        """Record everything from now on, and return the path of the file.

        ``name`` is the recording's name in the library; if it is empty, its time is used.

        Raises
        ------
        RequestRefusedError
            If something is being recorded.
        RecordingError
            If the file cannot be created.
        """
        with self._recorder_lock:
            if self._is_closing:
                raise RequestRefusedError("the program is being closed")
            if self._recorder is not None:
                raise RequestRefusedError("a recording is running; end it first")
            # The first call takes a while, because it loads a library. Make it before the
            # recording begins.
            load_arrow()
            start = datetime.now().astimezone()
            stem = "_".join(filter(None, (f"{start:%Y-%m-%d_%H-%M-%S-%f}", name)))
            path = self.recordings / f"{stem}.arrows"
            try:
                self.recordings.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise RecordingError(
                    "{folder}: the folder cannot be created ({reason})",
                    folder=self.recordings,
                    reason=str(error.strerror or str(error)),
                ) from error
            recorder = SessionRecorder(
                self.session,
                path,
                settings=settings,
                began=start.isoformat(timespec="seconds"),
                clock=self.clock,
                notify=self._on_recorder_notice,
            )
            recorder.start()
            self._recorder = recorder
            return path

    def stop_recording(self) -> Path:
        """End the recording, and return the finished file. This takes as long as copying the file.

        Raises
        ------
        RequestRefusedError
            If nothing is being recorded.
        RecordingError
            If the file cannot be finished; the recorded part can be recovered later.
        """
        with self._recorder_lock:
            recorder, self._recorder = self._recorder, None
        if recorder is None:
            raise RequestRefusedError("nothing is being recorded")
        return recorder.close()

    def _handle_actions(self, intent: Intent, now_s: float) -> None:
        requests: dict[OperatorAction, Callable[[], None]] = {
            OperatorAction.PENETRATION: lambda: self.penetration.press_button(now_s),
            OperatorAction.TOOL: self.toggle_tool,
            OperatorAction.RECENTRE: self.recentre,
        }
        for action, request in requests.items():
            if action in intent.pressed:
                try:
                    request()
                except InputError as error:
                    self._notify(str(error))

    def _rumble(self) -> None:
        strength = max(
            (
                abs(coordinate.contact_force_ratio)
                for coordinate in self.teleoperator.state.coordinates
            ),
            default=0.0,
        )
        strength = min(strength, 1.0)
        has_stopped = strength == 0.0 and self._latest_rumble != 0.0
        if has_stopped or abs(strength - self._latest_rumble) >= _MIN_RUMBLE_CHANGE:
            self._latest_rumble = strength
            self.devices.rumble(strength)

    def _record(self, snapshot: InputSnapshot) -> None:
        recorder = self._recorder
        if recorder is None:
            return
        for key, readings in snapshot.readings.items():
            device = self.devices.find_device(key)
            if device is not None:
                for reading in readings:
                    recorder.record_reading(device, reading)
        recorder.record_intent(snapshot.intent)

    def _on_recorder_notice(self, notice: str) -> None:
        self._notify(message("engine", "Recorder: {message}").fill(message=notice))

    def _on_step_failed(self, error: Exception) -> None:
        self._notify(
            message("engine", "The loop of the input devices failed: {name}: {error}").fill(
                name=type(error).__name__, error=describe_exception(error)
            )
        )

    def _load_or_use_presets(
        self, load: Callable[[Path], T], path: Path, presets: Callable[[], T]
    ) -> T:
        try:
            return load(path)
        except InputError as error:
            self.problems.append(
                message("engine", "{error}; presets are used").fill(error=describe_exception(error))
            )
            return presets()


def has_tip(session: MotionSession) -> bool:
    """Return whether the robot has a tip that can stay in place while the nano stage moves."""
    try:
        KinematicChain.of(session.robot)
    except ChainError:
        return False
    return True
