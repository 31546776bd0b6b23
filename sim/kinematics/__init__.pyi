from .aiming import (
    solve_free_pose as solve_free_pose,
)
from .chain import (
    JOINTS as JOINTS,
    NANO as NANO,
    TABLES as TABLES,
    KinematicChain as KinematicChain,
)
from .forward import (
    angle_between_tool_axes as angle_between_tool_axes,
    compute_tip_from_pivot as compute_tip_from_pivot,
    compute_tip_jacobian as compute_tip_jacobian,
    compute_tip_position as compute_tip_position,
    compute_tool_axis as compute_tool_axis,
)
from .inverse import (
    StageSplit as StageSplit,
    solve_nano as solve_nano,
    solve_tip as solve_tip,
)
from .keep_out import (
    MAX_SLOW_ZONE_SPEED_M_PER_S as MAX_SLOW_ZONE_SPEED_M_PER_S,
    SLOW_ZONE_HEIGHT_M as SLOW_ZONE_HEIGHT_M,
    KeepOutZone as KeepOutZone,
    TipExcess as TipExcess,
)
from .pivoting import (
    recentre as recentre,
)
from .workspace import (
    PositionBox as PositionBox,
    TipWorkspace as TipWorkspace,
)
