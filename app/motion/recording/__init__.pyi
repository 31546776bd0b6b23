from . import exporting as exporting, recovery as recovery
from .arrow_tables import (
    find_axis_units as find_axis_units,
    load_arrow as load_arrow,
)
from .backlog import (
    RecordedEvent as RecordedEvent,
)
from .exporting import (
    make_record as make_record,
    make_trajectory as make_trajectory,
)
from .recording_reader import (
    Recording as Recording,
)
from .recovery import (
    RECORDING_SUFFIX as RECORDING_SUFFIX,
    UNFINISHED_SUFFIX as UNFINISHED_SUFFIX,
    find_unfinished as find_unfinished,
    is_being_recorded as is_being_recorded,
    recover_recording as recover_recording,
)
from .replay import (
    Replay as Replay,
)
from .replay_pace import (
    REPLAY_SPEEDS as REPLAY_SPEEDS,
    PacedReplay as PacedReplay,
)
from .session_recorder import (
    SessionRecorder as SessionRecorder,
)
