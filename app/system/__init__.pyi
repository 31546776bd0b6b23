from .line_rate import (
    check_line_rate as check_line_rate,
)
from .machine_check import (
    FindingState as FindingState,
    run_checks as run_checks,
)
from .system_check import (
    describe_missing as describe_missing,
    find_missing_libraries as find_missing_libraries,
    find_platform as find_platform,
)
