from .bench import (
    DriverBench as DriverBench,
    make_bench as make_bench,
)
from .check import (
    CheckVerdict as CheckVerdict,
    DriverCheckResult as DriverCheckResult,
)
from .findings import (
    CheckNotApplicable as CheckNotApplicable,
    RequirementNotMet as RequirementNotMet,
    require_that as require_that,
)
from .suite import (
    CHECKS as CHECKS,
    find_checks as find_checks,
    run_checks as run_checks,
)
