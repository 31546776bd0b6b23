from . import model as model, plate as plate
from .model import (
    VOLTAGE_SLACK_RATIO as VOLTAGE_SLACK_RATIO,
    Axis as Axis,
    AxisCoupling as AxisCoupling,
    AxisEffect as AxisEffect,
    CascadeController as CascadeController,
    ForceAxis as ForceAxis,
    InertiaMatrices as InertiaMatrices,
    KeepOut as KeepOut,
    PiezoAxis as PiezoAxis,
    ReferenceSensor as ReferenceSensor,
    Robot as Robot,
    RobotMicroscope as RobotMicroscope,
    RobotTool as RobotTool,
    StepperAxis as StepperAxis,
    assemble_inertia_matrices as assemble_inertia_matrices,
)
from .numbers import (
    FORBID_UNKNOWN as FORBID_UNKNOWN,
    Count as Count,
    Number as Number,
    Positive as Positive,
)
from .plate import (
    PinJoint as PinJoint,
    Plate as Plate,
    PlateCutout as PlateCutout,
    PlatePin as PlatePin,
)
from .plate_geometry import (
    CutoutRing as CutoutRing,
    find_plate_problems as find_plate_problems,
    make_rings as make_rings,
)
