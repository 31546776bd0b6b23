from .axis_draft import (
    DEFAULT_AMPLITUDE_SHARE as DEFAULT_AMPLITUDE_SHARE,
    compute_natural_frequency as compute_natural_frequency,
)
from .generator import (
    EXCITATION_KINDS as EXCITATION_KINDS,
    Excitation as Excitation,
    ExcitationKind as ExcitationKind,
    choose_default_rate as choose_default_rate,
    excite as excite,
)
from .moves import (
    compute_shortest_duration as compute_shortest_duration,
    compute_shortest_quintic as compute_shortest_quintic,
    count_rows as count_rows,
    make_quintic as make_quintic,
    make_trapezoid as make_trapezoid,
)
from .quantity import (
    Amount as Amount,
    CapabilityShare as CapabilityShare,
    StatedAmount as StatedAmount,
    parse_amount as parse_amount,
    parse_axis_amount as parse_axis_amount,
)
from .sines_and_chirps import (
    ChirpExcitation as ChirpExcitation,
    MultisineExcitation as MultisineExcitation,
    SineExcitation as SineExcitation,
)
from .staircase_steps_prbs import (
    StaircaseExcitation as StaircaseExcitation,
    StepsExcitation as StepsExcitation,
)
from .triangles_and_sweeps import (
    DecayingTriangleExcitation as DecayingTriangleExcitation,
    SweepsExcitation as SweepsExcitation,
    TriangleExcitation as TriangleExcitation,
)
