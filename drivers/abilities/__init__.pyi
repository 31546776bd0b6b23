from . import abilities as abilities
from .abilities import (
    DISPLAY_COLUMNS as DISPLAY_COLUMNS,
    DISPLAY_ROWS as DISPLAY_ROWS,
    MAX_LEASE_S as MAX_LEASE_S,
    VOLTAGE_SLEW_RANGES_PER_S as VOLTAGE_SLEW_RANGES_PER_S,
    AnalogInputs as AnalogInputs,
    AxisHomer as AxisHomer,
    FastCapturer as FastCapturer,
    LinkReporter as LinkReporter,
    ProfileRunner as ProfileRunner,
    TextDisplay as TextDisplay,
    TrajectoryPlayer as TrajectoryPlayer,
    VelocityMover as VelocityMover,
    VoltageOutput as VoltageOutput,
)
from .capture import (
    CapturedSamples as CapturedSamples,
    CaptureRates as CaptureRates,
)
from .model_abilities import (
    AxisRegulator as AxisRegulator,
    EffectCarrier as EffectCarrier,
    HysteresisCompensator as HysteresisCompensator,
    TruePositions as TruePositions,
)
from .parameters import (
    ParameterDifference as ParameterDifference,
    ParameterStore as ParameterStore,
)
from .profile import (
    MAX_SEGMENTS as MAX_SEGMENTS,
    MotionProfile as MotionProfile,
    ProfileSegment as ProfileSegment,
)
from .tool import (
    ToolOutput as ToolOutput,
)
