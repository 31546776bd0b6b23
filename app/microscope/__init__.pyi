from .calibration_file import (
    MICRO as MICRO,
    NANO as NANO,
    StageCalibration as StageCalibration,
)
from .calibration_run import (
    StageCalibrationPhase as StageCalibrationPhase,
    StageCalibrationStatus as StageCalibrationStatus,
)
from .click_corrections import (
    VisitState as VisitState,
    VisitStatus as VisitStatus,
)
from .focus_run import (
    FocusStatus as FocusStatus,
    MicroscopeRunState as MicroscopeRunState,
)
from .measurements import (
    compute_tip_xy as compute_tip_xy,
)
from .microscope import (
    Microscope as Microscope,
)
from .recorded_reference import (
    make_reference_record as make_reference_record,
)
from .stack_run import (
    StackStatus as StackStatus,
)
from .status import (
    DriftStatus as DriftStatus,
    FocusAxis as FocusAxis,
    MeasuredLine as MeasuredLine,
    MicroscopeActivity as MicroscopeActivity,
    MicroscopeStatus as MicroscopeStatus,
    ScaleSource as ScaleSource,
    TipState as TipState,
    TipStatus as TipStatus,
)
from .targets import (
    MarkedTarget as MarkedTarget,
)
