from .export import (
    write_vtu as write_vtu,
)
from .mesh import (
    DEFAULT_DIVISIONS as DEFAULT_DIVISIONS,
    PlateMesh as PlateMesh,
)
from .modes import (
    PlateModes as PlateModes,
    compute_eigenmodes as compute_eigenmodes,
)
from .pin import (
    pin_length as pin_length,
)
from .plate_report import (
    AGREEMENT_TOLERANCE_RATIO as AGREEMENT_TOLERANCE_RATIO,
    entry_text as entry_text,
    mode_lines as mode_lines,
    mode_name as mode_name,
    plate_lines as plate_lines,
    ramp_lines as ramp_lines,
    range_lines as range_lines,
)
from .quasi_static_ramp import (
    DEFAULT_DURATION_S as DEFAULT_DURATION_S,
    DEFAULT_STEPS as DEFAULT_STEPS,
    RampResponse as RampResponse,
    make_ramp_path as make_ramp_path,
    move_bottom as move_bottom,
)
from .robot_entries import (
    apply_plate as apply_plate,
    compare_with_shipped_robot as compare_with_shipped_robot,
)
from .statics import (
    UnitSolutions as UnitSolutions,
    clamp_plate as clamp_plate,
    solve_unit_motions as solve_unit_motions,
)
from .stress import (
    StressPoint as StressPoint,
    YieldSafety as YieldSafety,
    deflection as deflection,
    find_min_safety as find_min_safety,
    motion_ranges as motion_ranges,
    principal_stresses as principal_stresses,
    safety_at as safety_at,
    surface_stress as surface_stress,
    von_mises as von_mises,
)
