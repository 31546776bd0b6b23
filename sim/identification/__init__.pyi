from .arx import (
    identify_arx as identify_arx,
)
from .experiment_signals import (
    ExperimentSignals as ExperimentSignals,
    find_uniform_rate as find_uniform_rate,
    make_siso_signals as make_siso_signals,
    signals_from_record as signals_from_record,
)
from .frequency_response import (
    FrequencyResponse as FrequencyResponse,
)
from .loop_figures import (
    HysteresisLoop as HysteresisLoop,
    fit_amplitude_exponent as fit_amplitude_exponent,
    measure_loops as measure_loops,
)
from .model import (
    IdentifiedModel as IdentifiedModel,
    ModelOrders as ModelOrders,
    simulate as simulate,
)
from .multisine import (
    estimate_periodic_response as estimate_periodic_response,
)
from .natural_modes import (
    MAX_MODE_NYQUIST_RATIO as MAX_MODE_NYQUIST_RATIO,
    NaturalMode as NaturalMode,
    find_natural_modes as find_natural_modes,
)
from .output_error import (
    identify_oe as identify_oe,
)
from .paper_transfer_functions import (
    interpret_model as interpret_model,
    load_published_models as load_published_models,
    to_transfer_function as to_transfer_function,
)
from .resonance import (
    FittedResonance as FittedResonance,
    fit_resonance as fit_resonance,
)
from .step_figures import (
    StepMetrics as StepMetrics,
    measure_steps as measure_steps,
)
from .vector_fitting import (
    InputOutputSpectra as InputOutputSpectra,
    fit_poles as fit_poles,
    pole_contributions as pole_contributions,
    reduce_poles as reduce_poles,
    relocate_poles as relocate_poles,
)
from .welch import (
    estimate_welch_response as estimate_welch_response,
)
