from .playback_notes import (
    MAX_LABEL_LENGTH as MAX_LABEL_LENGTH,
    PlaybackNotes as PlaybackNotes,
    RunLabels as RunLabels,
    to_one_line as to_one_line,
)
from .recorder import (
    PlaybackRecorder as PlaybackRecorder,
    RunModelOutputs as RunModelOutputs,
)
from .state import (
    NOT_CONNECTED as NOT_CONNECTED,
    PROGRAM as PROGRAM,
    STOP_AND_LOCK_REASON as STOP_AND_LOCK_REASON,
    AlarmRaised as AlarmRaised,
    CommandRefused as CommandRefused,
    ConnectionState as ConnectionState,
    EventCallback as EventCallback,
    FaultRaised as FaultRaised,
    ModelChanged as ModelChanged,
    PlaybackFinished as PlaybackFinished,
    SessionEvent as SessionEvent,
    SessionPhase as SessionPhase,
    SessionState as SessionState,
    StateChanged as StateChanged,
    StopRequest as StopRequest,
    StopRequested as StopRequested,
    find_lock_reason as find_lock_reason,
)
from .stop_send_latency import (
    StopLatency as StopLatency,
)
