from .guard import (
    Guard as Guard,
    PathSegment as PathSegment,
    TipPath as TipPath,
)
from .position_envelope import (
    PositionEnvelope as PositionEnvelope,
)
from .ranges import (
    Range as Range,
    Ranges as Ranges,
    check_narrower_range as check_narrower_range,
    check_rows as check_rows,
    is_outside as is_outside,
)
