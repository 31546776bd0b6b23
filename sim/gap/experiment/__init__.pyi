from .experiment_files import (
    ExperimentRecords as ExperimentRecords,
    is_experiment_file as is_experiment_file,
    make_experiment_records as make_experiment_records,
)
from .next_experiment import (
    suggest_experiments as suggest_experiments,
)
