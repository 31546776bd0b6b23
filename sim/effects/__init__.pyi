from . import starts as starts
from .attachment import (
    RESERVED_KEYS as RESERVED_KEYS,
    AttachedEffect as AttachedEffect,
    attach_effects as attach_effects,
    parse_effect as parse_effect,
)
from .backlash import (
    BACKLASH as BACKLASH,
)
from .contact import (
    CONTACT as CONTACT,
)
from .facts import (
    AxisProperties as AxisProperties,
)
from .formulation import (
    EVERY_KIND as EVERY_KIND,
    AddedStates as AddedStates,
    AxisChange as AxisChange,
    ClockSkew as ClockSkew,
    Effect as Effect,
    EffectParameter as EffectParameter,
    EffectStage as EffectStage,
    EffectTrait as EffectTrait,
    ForceFunction as ForceFunction,
    Formulation as Formulation,
    InputDelay as InputDelay,
    InputFunction as InputFunction,
    LinearPart as LinearPart,
    PositionFunction as PositionFunction,
    ReadingFunction as ReadingFunction,
    Values as Values,
)
from .identification import (
    AxisRecord as AxisRecord,
    EffectSignature as EffectSignature,
    IdentificationHints as IdentificationHints,
    Interval as Interval,
    RecordCoverage as RecordCoverage,
)
from .kinship import (
    EffectFamily as EffectFamily,
    EffectRelations as EffectRelations,
)
from .modes import (
    MODE_COUNT as MODE_COUNT,
)
from .registry import (
    is_built_in as is_built_in,
    list_effect_ids as list_effect_ids,
    load_all_effects as load_all_effects,
    load_effect as load_effect,
)
from .step import (
    call_step as call_step,
    compile_step_address as compile_step_address,
)
