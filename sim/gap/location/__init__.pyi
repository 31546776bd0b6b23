from .bands import (
    find_band_edges as find_band_edges,
    is_evenly_sampled as is_evenly_sampled,
    split_into_bands as split_into_bands,
)
from .located_gap import (
    GapPortion as GapPortion,
    LocatedGap as LocatedGap,
    find_other_motion as find_other_motion,
    locate_gap as locate_gap,
)
from .regimes import (
    AxisTravel as AxisTravel,
    OperatingRegime as OperatingRegime,
    find_regimes as find_regimes,
)
from .residual_features import (
    ResidualProbe as ResidualProbe,
    apply_lag as apply_lag,
    probe_residual as probe_residual,
)
