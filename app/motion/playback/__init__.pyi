from .compared_run import (
    ComparedRun as ComparedRun,
    compare_run_again as compare_run_again,
    compare_with_model as compare_with_model,
    find_worst_axis as find_worst_axis,
)
from .offline_playback import (
    play_offline as play_offline,
)
from .playback import (
    PAUSE_REASON as PAUSE_REASON,
    Playback as Playback,
    PlaybackPhase as PlaybackPhase,
    PlaybackState as PlaybackState,
)
from .resuming import (
    PlaybackResumption as PlaybackResumption,
    ResumeStep as ResumeStep,
)
from .retiming import (
    MAX_SPEED_RATIO as MAX_SPEED_RATIO,
    MIN_SPEED_RATIO as MIN_SPEED_RATIO,
)
