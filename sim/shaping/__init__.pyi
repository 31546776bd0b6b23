from .cubic_segments import (
    fit_cubics as fit_cubics,
)
from .feed_forward import (
    apply_lead as apply_lead,
    invert_axis as invert_axis,
)
from .impulses import (
    apply_shaper as apply_shaper,
    make_zero_vibration_shaper as make_zero_vibration_shaper,
)
from .move_shape import (
    MoveShape as MoveShape,
)
from .moves import (
    MotionLimits as MotionLimits,
    interpolate_table as interpolate_table,
    make_minimum_jerk as make_minimum_jerk,
    make_s_curve as make_s_curve,
    make_shortest_minimum_jerk as make_shortest_minimum_jerk,
)
