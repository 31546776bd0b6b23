from .line_budget import (
    BAUD_RATES as BAUD_RATES,
    LineCapacity as LineCapacity,
    compute_rates as compute_rates,
)
from .profile_upload import (
    UNITS_PER_STEP as UNITS_PER_STEP,
    evaluate_segments as evaluate_segments,
)
from .segment_window import (
    ROUNDING_STEPS as ROUNDING_STEPS,
)
