from .hidden_machine import (
    HiddenCause as HiddenCause,
    HiddenEffects as HiddenEffects,
    HiddenMachineSimulator as HiddenMachineSimulator,
    draw_hidden_effects as draw_hidden_effects,
    is_diagnosis_right as is_diagnosis_right,
)
from .resumable_run import (
    CaseShard as CaseShard,
)
from .self_test import (
    run_self_test as run_self_test,
)
