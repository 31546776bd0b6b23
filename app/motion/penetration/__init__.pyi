from .arming import (
    compute_start_targets as compute_start_targets,
    compute_travel_margin as compute_travel_margin,
    plan_session_thrust as plan_session_thrust,
)
from .cell_list import (
    CellList as CellList,
    CellOutcome as CellOutcome,
)
from .parameters import (
    MAX_TABLE_POINTS as MAX_TABLE_POINTS,
    PARAMETER_BOUNDS as PARAMETER_BOUNDS,
    CellDirection as CellDirection,
    InputShaping as InputShaping,
    PenetrationParameters as PenetrationParameters,
    ThrustShape as ThrustShape,
)
from .penetration import (
    PenetrationController as PenetrationController,
)
from .run_log import (
    PenetrationRun as PenetrationRun,
    PenetrationVerdict as PenetrationVerdict,
    RunLog as RunLog,
)
from .status import (
    RUNNING_PHASES as RUNNING_PHASES,
    PenetrationPhase as PenetrationPhase,
    PenetrationStatus as PenetrationStatus,
)
from .thrust import (
    ThrustPlan as ThrustPlan,
    ThrustTrace as ThrustTrace,
)
