from .backlash import (
    WIDTH_TO_PLAY_RATIO as WIDTH_TO_PLAY_RATIO,
    OneSidedApproach as OneSidedApproach,
    find_measured_backlash as find_measured_backlash,
)
from .compensation import (
    NamedInverse as NamedInverse,
    check_inverse_fits as check_inverse_fits,
    make_compensated_trajectory as make_compensated_trajectory,
)
from .heartbeat import (
    BEAT_PERIOD_S as BEAT_PERIOD_S,
)
from .range_settings import (
    load_ranges as load_ranges,
    store_ranges as store_ranges,
)
from .regulation import (
    NamedRegulation as NamedRegulation,
    make_regulation as make_regulation,
)
from .saved_positions import (
    HOME as HOME,
    LOAD as LOAD,
    MAX_NAME_LENGTH as MAX_NAME_LENGTH,
    WORK as WORK,
    SavedPositions as SavedPositions,
)
from .session import (
    MotionSession as MotionSession,
)
