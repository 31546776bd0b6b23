from .background import (
    BackgroundJob as BackgroundJob,
    BackgroundWorker as BackgroundWorker,
    ReportProgress as ReportProgress,
)
from .gap_words import (
    LIVE_GAP_WINDOW_S as LIVE_GAP_WINDOW_S,
    RUN_GAP_LABEL as RUN_GAP_LABEL,
    format_gap_details as format_gap_details,
    format_gap_size as format_gap_size,
    format_live_gap as format_live_gap,
    format_run_gap as format_run_gap,
    format_run_gaps as format_run_gaps,
)
from .help_topics import (
    NoticeMessage as NoticeMessage,
    find_help_page as find_help_page,
    find_module_page as find_module_page,
    find_panel_page as find_panel_page,
    get_message_page as get_message_page,
)
from .job_runner import (
    JobRunner as JobRunner,
)
from .loaded_trajectory import (
    TrajectoryPlan as TrajectoryPlan,
)
from .notice_poster import (
    Level as Level,
    NoticePoster as NoticePoster,
)
from .operator_requests import (
    OfferedPort as OfferedPort,
    OperatorRequests as OperatorRequests,
    is_answering as is_answering,
    is_reported_moving as is_reported_moving,
)
from .playback_controller import (
    NOT_PLAYED as NOT_PLAYED,
)
from .progress_line import (
    StatusProgressLine as StatusProgressLine,
    WorkProgress as WorkProgress,
)
from .record_library import (
    measure_free_bytes as measure_free_bytes,
)
from .requests_at_rest import (
    PendingConfirmation as PendingConfirmation,
    WaitingRequest as WaitingRequest,
)
from .state_words import (
    PhaseLabel as PhaseLabel,
    StateTone as StateTone,
    capitalise as capitalise,
    describe_motion as describe_motion,
    describe_moved as describe_moved,
    describe_movers as describe_movers,
    set_tone as set_tone,
)
from .steady_meaning import (
    ButtonMeaning as ButtonMeaning,
)
from .window_state import (
    StateRemedy as StateRemedy,
    WindowSnapshot as WindowSnapshot,
    describe_state as describe_state,
)
from .workbench import (
    FRAME_MS as FRAME_MS,
    ComparedRun as ComparedRun,
    Workbench as Workbench,
)
