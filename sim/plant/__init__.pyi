from . import kernel as kernel
from .assembly import (
    assemble as assemble,
)
from .coupled_groups import (
    compute_input_gain as compute_input_gain,
    compute_position_gain as compute_position_gain,
    find_coupled_axes as find_coupled_axes,
    make_groups as make_groups,
)
from .effect_switch import (
    transfer_state as transfer_state,
)
from .fine_rows import (
    compute_motion as compute_motion,
)
from .joint_loads import (
    JointLoads as JointLoads,
    RunningLoads as RunningLoads,
    compute_joint_loads as compute_joint_loads,
)
from .kernel import (
    KernelInputs as KernelInputs,
    KernelSamples as KernelSamples,
    KernelState as KernelState,
    KernelSteps as KernelSteps,
    run as run,
)
from .perturbation import (
    Perturbation as Perturbation,
)
from .plant import (
    Plant as Plant,
)
from .plant_arrays import (
    PlantTables as PlantTables,
)
from .random_draws import (
    RandomStreams as RandomStreams,
)
from .record_response import (
    ModelResponse as ModelResponse,
    check_axes as check_axes,
    make_run as make_run,
    simulate_nominal_response as simulate_nominal_response,
)
from .run_start import (
    estimate_start as estimate_start,
    find_steady_start as find_steady_start,
)
from .segment_steps import (
    make_steps as make_steps,
)
from .state import (
    ChainPoint as ChainPoint,
    PlantMotion as PlantMotion,
    PlantState as PlantState,
    RunCommands as RunCommands,
)
from .zero_order_hold import (
    MIN_TICK_S as MIN_TICK_S,
    compute_step_matrices as compute_step_matrices,
    cut_run as cut_run,
    make_ticks as make_ticks,
)
