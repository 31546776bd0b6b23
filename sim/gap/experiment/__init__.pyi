from .experiment_files import (
    ExperimentRecords as ExperimentRecords,
    is_experiment_file as is_experiment_file,
    make_experiment_records as make_experiment_records,
)
from .next_experiment import (
    describe_test as describe_test,
    suggest_experiments as suggest_experiments,
)
from .visible_effects import (
    MIN_VISIBLE_FLOORS as MIN_VISIBLE_FLOORS,
    AxisVisibility as AxisVisibility,
    EffectVisibility as EffectVisibility,
    find_visible_effects as find_visible_effects,
)
