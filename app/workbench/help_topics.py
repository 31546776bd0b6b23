"""The help page for a message, found by the origin of its error, event or log record."""

from collections.abc import Callable, Hashable
from typing import NamedTuple

from PySide6.QtCore import QObject

from rotemina.app.language import make_error_message, translate_message
from rotemina.app.motion.state import SessionState
from rotemina.app.workbench.notice_identity import make_repeat_key

_LIMITS_PAGE = "motion.md#limits"
_FAULTS_PAGE = "faults.md#what-a-message-means"
IsSettled = Callable[[SessionState], bool]

#: Help pages by the name of a module or class. The longest matching name is used. A class takes
#: precedence over its base classes.
PAGES_BY_NAME = {
    "rotemina.app.bench": "gap-diagnosis.md",
    "rotemina.app.blind": "blind-test.md",
    "rotemina.app.calibration": "calibration.md",
    "rotemina.app.calibration.health_book": "calibration.md#health-card",
    "rotemina.app.cameras": "cameras.md#what-can-be-wrong",
    "rotemina.app.cli": "command-line.md",
    "rotemina.app.errors.errors.BenchError": "gap-diagnosis.md",
    "rotemina.app.errors.errors.BlindError": "blind-test.md",
    "rotemina.app.errors.errors.CommandError": "command-line.md",
    "rotemina.app.errors.errors.DamagedLibraryError": "recording.md#the-library",
    "rotemina.app.errors.errors.DriverUnusableError": "connection.md#device",
    "rotemina.app.errors.errors.FrameError": "teleoperation.md",
    "rotemina.app.errors.errors.HealthBookError": "calibration.md#health-card",
    "rotemina.app.errors.errors.HiddenMachineError": "blind-test.md",
    "rotemina.app.errors.errors.InputCalibrationError": "input-mapping.md#calibration-files",
    "rotemina.app.errors.errors.InputProfileError": "input-mapping.md#profiles-by-hand",
    "rotemina.app.errors.errors.LibraryError": "recording.md#the-library",
    "rotemina.app.errors.errors.MicroscopeError": "microscope.md#in-the-window",
    "rotemina.app.errors.errors.ModelError": "motion.md",
    "rotemina.app.errors.errors.OffscreenError": "window.md",
    "rotemina.app.errors.errors.PenetrationError": "penetration.md",
    "rotemina.app.errors.errors.PluginNameError": "plugins.md",
    "rotemina.app.errors.errors.PluginWriteError": "plugins.md",
    "rotemina.app.errors.errors.RecentringError": "teleoperation.md",
    "rotemina.app.errors.errors.RecordingError": "recording.md",
    "rotemina.app.errors.errors.RequestRefusedError": "motion.md#states",
    "rotemina.app.errors.errors.SavedPositionError": "control.md#the-file-of-positions",
    "rotemina.app.errors.errors.ScalingError": "teleoperation.md",
    "rotemina.app.errors.errors.VideoError": "cameras.md#what-can-be-wrong",
    "rotemina.app.errors.errors.ViewerError": "view3d.md",
    "rotemina.app.errors.errors.WorkCancelledError": "window.md",
    "rotemina.app.microscope": "microscope.md#in-the-window",
    "rotemina.app.motion": "motion.md",
    "rotemina.app.motion.device.mailbox": "motion.md#states",
    "rotemina.app.motion.inputs": "input-mapping.md",
    "rotemina.app.motion.inputs.axis_calibration": "input-mapping.md#calibration-files",
    "rotemina.app.motion.inputs.profile": "input-mapping.md#profiles-by-hand",
    "rotemina.app.motion.penetration": "penetration.md",
    "rotemina.app.motion.playback.playback": "motion.md#playing-by-hand",
    "rotemina.app.motion.recording": "recording.md",
    "rotemina.app.motion.session.saved_positions": "control.md#the-file-of-positions",
    "rotemina.app.motion.state.state.AlarmRaised": _LIMITS_PAGE,
    "rotemina.app.motion.state.state.CommandRefused": _LIMITS_PAGE,
    "rotemina.app.motion.state.state.FaultRaised": _FAULTS_PAGE,
    "rotemina.app.motion.teleoperation": "teleoperation.md",
    "rotemina.app.operation": "motion.md",
    "rotemina.app.panel": "plugins.md",
    "rotemina.app.plugin_kit": "plugins.md",
    "rotemina.app.records": "recording.md#the-library",
    "rotemina.app.scene": "view3d.md",
    "rotemina.app.settings.driver_settings": "connection.md#device",
    "rotemina.app.shell": "window.md",
    "rotemina.app.shell.panels.panel_host": "plugins.md#what-a-bad-plugin-can-do",
    "rotemina.app.workbench": "window.md",
    "rotemina.app.workbench.operator_requests": "connection.md#device",
    "rotemina.drivers": "drivers.md",
    "rotemina.drivers.cameras": "cameras.md#what-can-be-wrong",
    "rotemina.drivers.contract.errors": _FAULTS_PAGE,
    "rotemina.drivers.contract.errors.BudgetError": "protocol.md",
    "rotemina.drivers.contract.errors.CameraLostError": "cameras.md#what-can-be-wrong",
    "rotemina.drivers.contract.errors.CameraReadError": "cameras.md#what-can-be-wrong",
    "rotemina.drivers.contract.errors.CameraRefusedError": "cameras.md#what-can-be-wrong",
    "rotemina.drivers.contract.errors.CameraSettingError": "cameras.md#what-can-be-wrong",
    "rotemina.drivers.contract.errors.ConnectionLostError": "connection.md#device",
    "rotemina.drivers.contract.errors.DescriptorError": "inputs.md#when-a-joystick-is-missing",
    "rotemina.drivers.contract.errors.DriverSettingError": "connection.md#device",
    "rotemina.drivers.contract.errors.DriverTimeoutError": "connection.md#device",
    "rotemina.drivers.contract.errors.FaultCommandError": "faults.md#faults-on-purpose",
    "rotemina.drivers.contract.errors.GateError": "drivers.md",
    "rotemina.drivers.contract.errors.InputLostError": "inputs.md#when-a-joystick-is-missing",
    "rotemina.drivers.contract.errors.LimitError": _LIMITS_PAGE,
    "rotemina.drivers.contract.errors.ProtocolError": "protocol.md",
    "rotemina.drivers.contract.errors.ScriptError": "inputs.md#scripts",
    "rotemina.drivers.contract.errors.StalePermitError": "drivers.md",
    "rotemina.drivers.contract.errors.StateError": "connection.md#state",
    "rotemina.drivers.contract.registry": "plugins.md#what-a-bad-plugin-can-do",
    "rotemina.drivers.gcode": "drivers.md#a-driver-for-other-electronics",
    "rotemina.drivers.inputs": "inputs.md#when-a-joystick-is-missing",
    "rotemina.drivers.mc68hc11": "protocol.md",
    "rotemina.drivers.virtual_board": "faults.md#faults-on-purpose",
    "rotemina.sim.errors.errors.BrokenEffectError": "effects.md",
    "rotemina.sim.errors.errors.ChainError": "kinematics.md",
    "rotemina.sim.errors.errors.CompensationError": "compensation.md",
    "rotemina.sim.errors.errors.ConvergenceError": "compensation.md",
    "rotemina.sim.errors.errors.EffectError": "effects.md",
    "rotemina.sim.errors.errors.ExcitationRequestError": "excitations.md#limits",
    "rotemina.sim.errors.errors.FeedbackError": "tuning.md",
    "rotemina.sim.errors.errors.FileWriteError": "file-formats.md#export",
    "rotemina.sim.errors.errors.GapError": "gap-diagnosis.md#refusals-and-cautions",
    "rotemina.sim.errors.errors.IdentificationError": "identification.md",
    "rotemina.sim.errors.errors.IdentificationSettingError": "identification.md",
    "rotemina.sim.errors.errors.InsufficientExcitationError": "identification.md",
    "rotemina.sim.errors.errors.LostLoopError": "tuning.md",
    "rotemina.sim.errors.errors.ModelFileError": "identification.md",
    "rotemina.sim.errors.errors.OutOfLimitsError": _LIMITS_PAGE,
    "rotemina.sim.errors.errors.PlantError": "simulation.md",
    "rotemina.sim.errors.errors.PlateError": "plate.md",
    "rotemina.sim.errors.errors.PluginError": "plugins.md#what-a-bad-plugin-can-do",
    "rotemina.sim.errors.errors.RecordError": "file-formats.md#records-and-trajectories",
    "rotemina.sim.errors.errors.RegistrationError": "vision.md#limits",
    "rotemina.sim.errors.errors.RobotFileError": "file-formats.md#robot-files",
    "rotemina.sim.errors.errors.SceneError": "microscope.md#the-simulated-microscope",
    "rotemina.sim.errors.errors.SealError": "blind-test.md",
    "rotemina.sim.errors.errors.SensorCalibrationError": "calibration.md#refused",
    "rotemina.sim.errors.errors.ShapingError": "excitations.md",
    "rotemina.sim.errors.errors.StageCalibrationError": "vision.md#limits",
    "rotemina.sim.errors.errors.StateSpaceError": "kinematics.md#modes",
    "rotemina.sim.errors.errors.TimeGridError": "identification.md",
    "rotemina.sim.errors.errors.TooShortError": "identification.md",
    "rotemina.sim.errors.errors.TrajectoryError": "trajectory.md",
    "rotemina.sim.errors.errors.TuningError": "tuning.md",
    "rotemina.sim.errors.errors.UnitError": "file-formats.md#records-and-trajectories",
    "rotemina.sim.errors.errors.UnstableError": "tuning.md",
    "rotemina.sim.errors.errors.VisionError": "vision.md#limits",
    "rotemina.sim.gap": "gap-diagnosis.md#refusals-and-cautions",
    "rotemina.sim.records": "file-formats.md#records-and-trajectories",
    "rotemina.sim.trajectory": "trajectory.md",
}


class NoticeRemedy(NamedTuple):
    """A button that removes the cause of a message: its label and what it runs."""

    label: str
    run: Callable[[], object]


class NoticeMessage(str):
    """A message with the properties that its notice needs.

    Attributes
    ----------
    page : str
        The help page for it, or "".
    remedy : NoticeRemedy or None
    subject : hashable or None
        The request that the message is about. The notice ends when that request succeeds.
    until : callable or None
        Takes the state of the session and returns whether the cause of the message is gone.
    is_refusal : bool
        Whether the message only reports that a request was refused.
    key : hashable
        Identity of the message, equal for its repeats.
    """

    __slots__ = ("is_refusal", "key", "page", "remedy", "subject", "until")
    page: str
    remedy: NoticeRemedy | None
    subject: Hashable | None
    until: IsSettled | None
    is_refusal: bool
    key: Hashable

    def __new__(
        cls,
        text: str,
        page: str = "",
        remedy: NoticeRemedy | None = None,
        *,
        subject: Hashable | None = None,
        until: IsSettled | None = None,
        is_refusal: bool = False,
    ) -> "NoticeMessage":
        """Return a message in the window's language.

        If the text is a notice message already, its properties are kept.
        """
        message = super().__new__(cls, translate_message(text))
        original = text if isinstance(text, NoticeMessage) else None
        message.page = (original.page if original else "") or page
        message.remedy = remedy or (original.remedy if original else None)
        message.subject = subject if subject is not None or original is None else original.subject
        message.until = until or (original.until if original else None)
        message.is_refusal = is_refusal or (original is not None and original.is_refusal)
        message.key = original.key if original else make_repeat_key(text)
        return message


def explain_error(error: BaseException, *, refused: Hashable | None = None) -> NoticeMessage:
    """Return the message of an error in the window's language, with its help page.

    ``refused`` is the refused request if the error is a refusal.
    """
    return NoticeMessage(
        make_error_message(error),
        find_help_page(error),
        subject=refused,
        is_refusal=refused is not None,
    )


def get_message_page(text: str) -> str:
    """Return the help page that a message carries, or ""."""
    return text.page if isinstance(text, NoticeMessage) else ""


def find_help_page(about: object) -> str:
    """Return the help page for an error, event or widget; a string is already a page name."""
    if isinstance(about, str):
        return about
    if isinstance(about, QObject) and (page := find_panel_page(about)):
        return page
    for class_ in type(about).__mro__:
        if page := find_module_page(f"{class_.__module__}.{class_.__qualname__}"):
            return page
    return ""


def find_panel_page(part: QObject | None) -> str:
    """Return the page of the panel that contains a widget, or ""."""
    while part is not None:
        # Panels import this module, so it cannot import their class.
        page = getattr(part, "help_page", "")
        if page and isinstance(page, str):
            return page
        part = part.parent()
    return ""


def find_module_page(name: str) -> str:
    """Return the page for a module or a name in it, or ""."""
    while name:
        if name in PAGES_BY_NAME:
            return PAGES_BY_NAME[name]
        name = name.rpartition(".")[0]
    return ""
