from .conditioning import (
    make_conditioning_sweep as make_conditioning_sweep,
)
from .excitation import (
    make_excitation as make_excitation,
)
from .file import (
    InverseProvenance as InverseProvenance,
    InverseSource as InverseSource,
    read_trained as read_trained,
    write_trained as write_trained,
)
from .held_setpoint_inverse import (
    SetpointInverse as SetpointInverse,
)
from .inverse import (
    Inverse as Inverse,
    InverseExceedance as InverseExceedance,
    find_rest as find_rest,
)
from .inverse_parameters import (
    InverseKind as InverseKind,
    InverseModel as InverseModel,
)
from .judgement import (
    KIND_NAMES as KIND_NAMES,
    InverseResidual as InverseResidual,
    compute_residual as compute_residual,
)
from .prandtl_ishlinskii import (
    compute_stops as compute_stops,
)
from .samples import (
    TrainingSamples as TrainingSamples,
    read_samples as read_samples,
)
from .training import (
    TrainingResult as TrainingResult,
    train as train,
)
from .trajectory import (
    compensate_trajectory as compensate_trajectory,
    sample_at_ticks as sample_at_ticks,
)
