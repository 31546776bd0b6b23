"""The state of the microscope at one instant, for views."""

from dataclasses import dataclass, field
from enum import StrEnum

from rotemina.app.cameras import FeedView
from rotemina.app.microscope.calibration_file import MicroscopeCalibration
from rotemina.app.microscope.calibration_run import StageCalibrationStatus
from rotemina.app.microscope.click_corrections import VisitStatus
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.focus_run import FocusStatus
from rotemina.app.microscope.stack_run import StackStatus
from rotemina.app.microscope.targets import MarkedTarget
from rotemina.drivers.cameras import CameraIdentity
from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision import BackgroundDrift, CellOutline, MembraneAhead, TipDepth


class MicroscopeActivity(StrEnum):
    """The kind of run that is under way; there is at most one run."""

    NONE = "none"
    CALIBRATION = "calibration"
    CLICK = "click"
    TARGETS = "visit of a target"
    AUTOFOCUS = "autofocus"
    STACK = "z-stack"


class TipState(StrEnum):
    """The state of the tracked tip."""

    OFF = "off"
    SEARCHED = "searched"
    TRACKED = "tracked"
    LOST = "lost"


class ScaleSource(StrEnum):
    """The source of the pixel size."""

    NONE = "unknown"
    ROBOT_FILE = "robot file"
    CALIBRATION = "calibration"


@dataclass(frozen=True, slots=True, eq=False)
class TipStatus:
    """The tracked tip.

    Attributes
    ----------
    state : TipState
    pixel, sigma_px : (2,) or None, float or None
        Current or last seen pixel, and the standard deviation in its least certain direction.
    direction : float or None
        Direction from the tip along the body, rad: the angle from the +column direction towards
        the +row direction.
    depth : TipDepth or None
        Distance from focus, m, with its uncertainty.
    position_m, sigma_m : (2,) or None
        x and y by the calibration of the micro stage, and their standard deviations; None without
        that calibration.
    quality : float
        0 to 1.
    reason : str
        Why the tip is lost or was not found.
    """

    state: TipState = TipState.OFF
    pixel: FloatArray | None = None
    sigma_px: float | None = None
    direction: float | None = None
    depth: TipDepth | None = None
    position_m: FloatArray | None = None
    sigma_m: FloatArray | None = None
    quality: float = 0.0
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class CellStatus:
    """The outline of a cell, and the position of the tip relative to it.

    Attributes
    ----------
    outline : CellOutline or None
    ahead : MembraneAhead or None
        The membrane in the direction in which the pipette points, px and rad; None without a tip,
        or if that line misses the cell.
    distance_m, sigma_m : float or None
        Distance of the membrane from the tip, and its standard deviation; None if the size of a
        pixel is unknown.
    reason : str
        Why no outline was found.
    """

    outline: CellOutline | None = None
    ahead: MembraneAhead | None = None
    distance_m: float | None = None
    sigma_m: float | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredLine:
    """A line that was drawn in the picture.

    Attributes
    ----------
    begin, end : (2,)
        Ends of the line, px.
    length_px : float
    length_m : float or None
        None if the size of a pixel is unknown.
    angle : float
        Angle from the +column direction towards the +row direction, rad.
    angle_to_pipette : float or None
        Angle to the pipette's body, rad, 0 to π/2; None without a tip.
    """

    begin: FloatArray
    end: FloatArray
    length_px: float
    length_m: float | None
    angle: float
    angle_to_pipette: float | None


@dataclass(frozen=True, slots=True)
class FocusAxis:
    """A drive for focusing: the microscope's focus drive, or an axis of the machine.

    Attributes
    ----------
    name : str
        ``focus`` for the microscope's drive, otherwise the name of the axis.
    position : float or None
        Current position, m; None if it is unknown.
    low, high : float
        Range, m.
    """

    name: str
    position: float | None
    low: float
    high: float


@dataclass(frozen=True, slots=True, eq=False)
class DriftStatus:
    """Status of the drift monitoring.

    ``drift`` is the displacement of the background since the monitoring began; None if nothing is
    monitored or measured yet.
    """

    is_watched: bool = False
    drift: BackgroundDrift | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class MicroscopeStatus:
    """Everything that a view shows. Pixels are (column, row) of the picture in ``feed``.

    Attributes
    ----------
    cameras : tuple of CameraIdentity
        Cameras that are available now.
    camera_problems : dict source -> str
        Why a source finds no cameras.
    camera : CameraIdentity or None
        The camera in use.
    feed : FeedView
        State and newest picture of the camera in use.
    objective : str
        The objective in use; ``objectives`` are all those chosen since the start.
    calibration : MicroscopeCalibration or None
        Calibration of camera and objective.
    calibration_problem : str
        Why the stored calibration cannot be used.
    pixel_m, scale_source : float or None, ScaleSource
        Size of a pixel in the specimen, m, and its source.
    activity : MicroscopeActivity
        Kind of the run that is under way.
    calibration_status, visit_status, focus_status, stack_status : status or None
        Status of the latest run of each kind, also after its end: phase, progress, residuals,
        reasons.
    abort_reason : str
        Why the latest run was aborted (camera, lost tip, operator); empty if it was not.
    planned_move : PlannedMove or None
        The move that :meth:`Microscope.go` would make; ``ghost`` is the pixel of the tip after it.
    tip_path : (n, 2) or None
        Path of the tip in the picture, px, newest point last.
    tip : TipStatus
    cell : CellStatus
    measured_line : MeasuredLine or None
    targets : tuple of MarkedTarget
    nano_limits : (n, 2) or None
        Closed polygon around the pixels that the nano stage can reach; None without calibration.
    focus_axes : tuple of FocusAxis
    drift : DriftStatus
    has_background : bool
        Whether tracking used a picture of the background beneath the tip.
    frames_processed, frames_skipped : int
        Numbers of pictures since tracking was switched on. The tracker always takes the newest
        picture, and skips the pictures in between.
    simulation_problem : str
        Why the simulated microscope cannot show this machine; empty if it can, or is not used.
    """

    cameras: tuple[CameraIdentity, ...] = ()
    camera_problems: dict[str, str] = field(default_factory=dict)
    camera: CameraIdentity | None = None
    feed: FeedView = field(default_factory=FeedView)
    objective: str = ""
    objectives: tuple[str, ...] = ()
    calibration: MicroscopeCalibration | None = None
    calibration_problem: str = ""
    pixel_m: float | None = None
    scale_source: ScaleSource = ScaleSource.NONE
    activity: MicroscopeActivity = MicroscopeActivity.NONE
    calibration_status: StageCalibrationStatus | None = None
    visit_status: VisitStatus | None = None
    focus_status: FocusStatus | None = None
    stack_status: StackStatus | None = None
    abort_reason: str = ""
    planned_move: PlannedMove | None = None
    tip_path: FloatArray | None = None
    tip: TipStatus = field(default_factory=TipStatus)
    cell: CellStatus = field(default_factory=CellStatus)
    measured_line: MeasuredLine | None = None
    targets: tuple[MarkedTarget, ...] = ()
    nano_limits: FloatArray | None = None
    focus_axes: tuple[FocusAxis, ...] = ()
    drift: DriftStatus = field(default_factory=DriftStatus)
    has_background: bool = False
    frames_processed: int = 0
    frames_skipped: int = 0
    simulation_problem: str = ""
