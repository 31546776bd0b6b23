from .bench_run import (
    run_bench as run_bench,
)
from .diagnosis_program import (
    OWN_PROGRAM as OWN_PROGRAM,
    ProgramRun as ProgramRun,
    parse_program as parse_program,
    run_program as run_program,
)
from .engine_comparison import (
    EngineAnswers as EngineAnswers,
    describe_answer as describe_answer,
    format_difference as format_difference,
    format_summary as format_summary,
)
