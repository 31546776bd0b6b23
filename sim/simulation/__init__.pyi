from .check_result import (
    CheckResult as CheckResult,
    EffectReport as EffectReport,
)
from .effect_check import (
    check_effect as check_effect,
)
from .loads_table import (
    LoadsTable as LoadsTable,
    open_loads_table as open_loads_table,
)
from .simulation import (
    SimulatedMachine as SimulatedMachine,
    needs_all_commands as needs_all_commands,
    simulate as simulate,
)
