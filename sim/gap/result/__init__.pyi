from .diagnosis import (
    CORRECTING_VERDICTS as CORRECTING_VERDICTS,
    UNKNOWN_EFFECT_ID as UNKNOWN_EFFECT_ID,
    AxisDiagnosis as AxisDiagnosis,
    DerivedFigure as DerivedFigure,
    Diagnosis as Diagnosis,
    FailedStep as FailedStep,
    FittedParameter as FittedParameter,
    GapCause as GapCause,
    GapRemainder as GapRemainder,
    GapShrinkage as GapShrinkage,
    GapVerdict as GapVerdict,
    Interval as Interval,
    ModelOffset as ModelOffset,
    RankedCandidate as RankedCandidate,
    ShrinkageStep as ShrinkageStep,
    SuggestedExperiment as SuggestedExperiment,
    SuspectedEffect as SuspectedEffect,
)
from .diagnosis_progress import (
    Account as Account,
    Listener as Listener,
    Progress as Progress,
    unheard as unheard,
)
from .ranking import (
    Grade as Grade,
    Ranking as Ranking,
    Standing as Standing,
    closed as closed,
)
