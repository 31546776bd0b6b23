from . import regulated_plant as regulated_plant
from .axis_loop import (
    AxisLoop as AxisLoop,
    LoopTraces as LoopTraces,
)
from .controller import (
    SampledController as SampledController,
)
from .feed_forward import (
    FeedForward as FeedForward,
    SampledInverse as SampledInverse,
)
from .gains import (
    ControllerGains as ControllerGains,
    NotchFilter as NotchFilter,
)
from .reference_lead import (
    compute_lead_taps as compute_lead_taps,
)
from .regulation import (
    AxisRegulation as AxisRegulation,
)
from .stability import (
    MAX_PEAK_SENSITIVITY as MAX_PEAK_SENSITIVITY,
    LoopAnalysis as LoopAnalysis,
    check_stability as check_stability,
    compute_sensitivity_peak as compute_sensitivity_peak,
)
from .tolerance_spread import (
    DEFAULT_SPREAD as DEFAULT_SPREAD,
    make_spread_loops as make_spread_loops,
)
