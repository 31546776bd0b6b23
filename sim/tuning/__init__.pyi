from .pareto_front import (
    FrontPoint as FrontPoint,
    SecondObjective as SecondObjective,
)
from .search import (
    SearchGeneration as SearchGeneration,
    SearchSettings as SearchSettings,
    compute_objectives as compute_objectives,
    run_search as run_search,
)
from .search_problem import (
    DEFAULT_SHARES as DEFAULT_SHARES,
    ScenarioEvaluation as ScenarioEvaluation,
    TuningProblem as TuningProblem,
    gains_from_shares as gains_from_shares,
    max_gain_amounts as max_gain_amounts,
    with_gain_amounts as with_gain_amounts,
)
from .tuning_result import (
    TuningResult as TuningResult,
    load_tuning as load_tuning,
    make_tuning as make_tuning,
    save_tuning as save_tuning,
    to_document as to_document,
)
