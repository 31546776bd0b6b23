from .axis_limits import (
    RANGE_SLACK_RATIO as RANGE_SLACK_RATIO,
    check_commands_fit_model as check_commands_fit_model,
    check_speeds as check_speeds,
    check_target as check_target,
    compute_reachable_range as compute_reachable_range,
    get_command_resolution as get_command_resolution,
    get_voltage_bounds as get_voltage_bounds,
    is_finite as is_finite,
    with_limits as with_limits,
)
from .checked_trajectory import (
    CheckedTrajectory as CheckedTrajectory,
    accept_trajectory as accept_trajectory,
)
from .first_trajectory import (
    make_example as make_example,
)
from .motion_envelope import (
    AxisMotion as AxisMotion,
    MotionEnvelope as MotionEnvelope,
)
from .prediction import (
    MAX_OVERSHOOT_RATIO as MAX_OVERSHOOT_RATIO,
)
from .schedule import (
    PlaybackSchedule as PlaybackSchedule,
)
from .section_and_repeat import (
    MAX_REPEATS as MAX_REPEATS,
    cut_and_repeat as cut_and_repeat,
)
from .setpoint_limits import (
    SetpointLimits as SetpointLimits,
)
from .speed_and_acceleration import (
    DEFAULT_SETPOINT_PERIOD_S as DEFAULT_SETPOINT_PERIOD_S,
)
from .trajectory_demands import (
    AxisDemands as AxisDemands,
    DryRun as DryRun,
    dry_run as dry_run,
    find_mode as find_mode,
    find_moved_axes as find_moved_axes,
)
from .trajectory_excesses import (
    RATE_SLACK_RATIO as RATE_SLACK_RATIO,
    LimitedQuantity as LimitedQuantity,
    LimitViolation as LimitViolation,
    check_trajectory as check_trajectory,
    commands_of as commands_of,
)
from .worn_machine_demo import (
    load_worn_effects as load_worn_effects,
    make_demonstration as make_demonstration,
)
