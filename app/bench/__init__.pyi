from .bench_run import (
    run_bench as run_bench,
)
