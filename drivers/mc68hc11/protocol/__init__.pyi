from . import board_messages as board_messages, host_messages as host_messages
from .axes import (
    BoardAxis as BoardAxis,
    make_board_axes as make_board_axes,
)
from .board_messages import (
    AXIS_BYTES as AXIS_BYTES,
    AxisDescription as AxisDescription,
    BoardIdentity as BoardIdentity,
    BoardKind as BoardKind,
    BoardRates as BoardRates,
    CaptureSamples as CaptureSamples,
    FrameDone as FrameDone,
    FrameRefused as FrameRefused,
    OperatorInputs as OperatorInputs,
    ParameterValue as ParameterValue,
    Telemetry as Telemetry,
)
from .framing import (
    BROADCAST_ADDRESS as BROADCAST_ADDRESS,
    MAX_FRAME_BYTES as MAX_FRAME_BYTES,
    MAX_PAYLOAD_BYTES as MAX_PAYLOAD_BYTES,
    RESYNC_BYTES as RESYNC_BYTES,
    STOP_BYTES as STOP_BYTES,
    STOP_FRAME as STOP_FRAME,
    FrameDecoder as FrameDecoder,
    SerialFrame as SerialFrame,
    encode_frame as encode_frame,
)
from .host_messages import (
    AbortProfile as AbortProfile,
    ArmProfile as ArmProfile,
    AskKind as AskKind,
    AxisDifferences as AxisDifferences,
    BeginCapture as BeginCapture,
    BeginProfile as BeginProfile,
    BeginStream as BeginStream,
    ClearFault as ClearFault,
    DescribeAxis as DescribeAxis,
    HomeAxes as HomeAxes,
    IdentifyBoard as IdentifyBoard,
    LoadSegments as LoadSegments,
    MoveTo as MoveTo,
    MoveVelocity as MoveVelocity,
    PollBoard as PollBoard,
    QuadraticSegment as QuadraticSegment,
    ReadParameter as ReadParameter,
    RequestRates as RequestRates,
    SetTelemetry as SetTelemetry,
    SetVoltage as SetVoltage,
    SetWatchdog as SetWatchdog,
    ShowText as ShowText,
    StopBoard as StopBoard,
    StreamSegment as StreamSegment,
    TriggerProfile as TriggerProfile,
    WriteParameter as WriteParameter,
)
from .messages import (
    unpack_message as unpack_message,
)
from .parameters import (
    MAX_CONVERTER_CODE as MAX_CONVERTER_CODE,
    PARAMETERS_PER_AXIS as PARAMETERS_PER_AXIS,
    compute_fingerprint as compute_fingerprint,
    describe_parameter as describe_parameter,
    make_parameters as make_parameters,
)
from .payload import (
    WireMessage as WireMessage,
)
from .protocol_codes import (
    AXES_PER_BOARD as AXES_PER_BOARD,
    LCD_COLUMNS as LCD_COLUMNS,
    LCD_ROWS as LCD_ROWS,
    MAX_PROFILE_SEGMENTS as MAX_PROFILE_SEGMENTS,
    PROTOCOL_VERSION as PROTOCOL_VERSION,
    QUEUE_SEGMENTS as QUEUE_SEGMENTS,
    VIRTUAL_KIND as VIRTUAL_KIND,
    BoardAbility as BoardAbility,
    BoardFault as BoardFault,
    BoardState as BoardState,
    RefusalReason as RefusalReason,
)
