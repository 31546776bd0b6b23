from .answer_exports import (
    AnswerExports as AnswerExports,
)
from .diagnosis_answer import (
    DiagnosisAnswer as DiagnosisAnswer,
)
from .headline_view import (
    LARGE_HEIGHT_PX as LARGE_HEIGHT_PX,
    SMALL_HEIGHT_PX as SMALL_HEIGHT_PX,
)
from .model_switch import (
    ModelSwitch as ModelSwitch,
    describe_worse_axes as describe_worse_axes,
    find_candidate_model as find_candidate_model,
)
from .result_section import (
    ResultSection as ResultSection,
    explain_no_cause as explain_no_cause,
)
from .unseen_motion import (
    UnseenMotion as UnseenMotion,
)
from .unseen_motion_reduction import (
    UnseenMotionResult as UnseenMotionResult,
)
from .words import (
    effect_title as effect_title,
    effect_word as effect_word,
    stage_name as stage_name,
)
