"""The state of the microscope at one instant, for views."""

from dataclasses import dataclass, field
from enum import StrEnum

from rotemina.app.cameras.feed import FeedView
from rotemina.app.microscope.calibration_file import MicroscopeCalibration
from rotemina.app.microscope.calibration_run import CalibrationStatus
from rotemina.app.microscope.click_corrections import VisitStatus
from rotemina.app.microscope.click_target import PlannedMove
from rotemina.app.microscope.focus_run import FocusStatus
from rotemina.app.microscope.stack_run import StackStatus
from rotemina.app.microscope.targets import Target
from rotemina.drivers.cameras.camera import CameraIdentity
from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.background_drift import Drift
from rotemina.sim.vision.cell import CellOutline, MembraneAhead
from rotemina.sim.vision.tip_fit import Depth


class Activity(StrEnum):
    """What the microscope moves something for; one at a time."""

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
class TipSeen:
    """The tracked tip.

    Attributes
    ----------
    state : TipState
    pixel, sigma_px : (2,) or None, float or None
        Where it is, or was seen last, and the standard deviation along the worst direction.
    direction : float or None
        Where its body leads, rad, from columns towards rows.
    depth : Depth or None
        From focus, m; with its uncertainty.
    place_m, sigma_m : (2,) or None
        x and y by the calibration of the tables, and their standard deviations; None without one.
    quality : float
        0 to 1.
    reason : str
        Why it is lost or was not found.
    """

    state: TipState = TipState.OFF
    pixel: FloatArray | None = None
    sigma_px: float | None = None
    direction: float | None = None
    depth: Depth | None = None
    place_m: FloatArray | None = None
    sigma_m: FloatArray | None = None
    quality: float = 0.0
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class CellSeen:
    """The outline of a cell, and the position of the tip relative to it.

    Attributes
    ----------
    outline : CellOutline or None
    ahead : MembraneAhead or None
        Along the pipette's own direction, px and rad; None without a tip, or where that way misses.
    distance_m, sigma_m : float or None
        Of the membrane from the tip, and its standard deviation; None without a scale.
    reason : str
        Why none was found.
    """

    outline: CellOutline | None = None
    ahead: MembraneAhead | None = None
    distance_m: float | None = None
    sigma_m: float | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """A line that was drawn in the picture.

    Attributes
    ----------
    begin, end : (2,)
        px.
    length_px : float
    length_m : float or None
        None without a scale.
    angle : float
        rad, from columns towards rows.
    to_body : float or None
        Angle to the pipette's body, rad, 0 to π/2; None without a tip.
    """

    begin: FloatArray
    end: FloatArray
    length_px: float
    length_m: float | None
    angle: float
    to_body: float | None


@dataclass(frozen=True, slots=True)
class FocusAxis:
    """Something that can be focused with: the microscope's drive, or an axis of the machine.

    Attributes
    ----------
    name : str
        ``focus`` for the drive, else the axis.
    position : float or None
        m.
    low, high : float
        How far it goes, m.
    """

    name: str
    position: float | None
    low: float
    high: float


@dataclass(frozen=True, slots=True, eq=False)
class DriftSeen:
    """Displacement of the background since it was last taken; None if not monitored."""

    watched: bool = False
    drift: Drift | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class MicroscopeStatus:
    """All that a view shows. Pixels are (column, row) of the picture in ``feed``.

    Attributes
    ----------
    cameras : tuple of CameraIdentity
        That are there now.
    camera_problems : dict source -> str
        Why a source finds nothing.
    camera : CameraIdentity or None
        The one in use.
    feed : FeedView
        Its newest picture and how it is doing.
    objective : str
        The one in use; ``objectives`` are those with a calibration, and this one.
    calibration : MicroscopeCalibration or None
        What is known of camera and objective.
    calibration_problem : str
        Why what is kept cannot be used.
    pixel_m, scale_source : float or None, ScaleSource
        Size of a pixel in the specimen, m, and who says so.
    activity : Activity
        What is under way now.
    calibrating, visiting, focusing, stacking : status or None
        Of the latest of each, also after it has ended: with phase, progress, residuals, reasons.
    stopped : str
        Why the latest run was ended from here (camera, lost tip, operator); empty if it was not.
    planned : PlannedMove or None
        What :meth:`Microscope.go` would do; its ``ghost`` is where the tip would be.
    path : (n, 2) or None
        Where the tip went in the picture, the latest last, px.
    tip : TipSeen
    cell : CellSeen
    measured : Measured or None
    targets : tuple of Target
    nano_limits : (n, 2) or None
        Closed polygon of where the nano stage can bring the tip, px; None without calibration.
    focus_axes : tuple of FocusAxis
    drift : DriftSeen
    background : bool
        Whether tracking has a picture of what lies beneath the tip.
    frames_processed, frames_skipped : int
        By the tracker since it was switched on: it takes the newest one, and never a backlog.
    truth : str
        Why the simulated microscope cannot show this machine; empty where it can, or is not used.
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
    activity: Activity = Activity.NONE
    calibrating: CalibrationStatus | None = None
    visiting: VisitStatus | None = None
    focusing: FocusStatus | None = None
    stacking: StackStatus | None = None
    stopped: str = ""
    planned: PlannedMove | None = None
    path: FloatArray | None = None
    tip: TipSeen = field(default_factory=TipSeen)
    cell: CellSeen = field(default_factory=CellSeen)
    measured: Measured | None = None
    targets: tuple[Target, ...] = ()
    nano_limits: FloatArray | None = None
    focus_axes: tuple[FocusAxis, ...] = ()
    drift: DriftSeen = field(default_factory=DriftSeen)
    background: bool = False
    frames_processed: int = 0
    frames_skipped: int = 0
    truth: str = ""
