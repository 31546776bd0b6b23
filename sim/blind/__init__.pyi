from . import mechanics as mechanics
from .case import (
    BlindCase as BlindCase,
    draw_case as draw_case,
)
from .confidence_intervals import (
    IntervalEstimate as IntervalEstimate,
)
from .figures_table import (
    FIGURE_ROWS as FIGURE_ROWS,
    REMAINDER_GROUP_TITLES as REMAINDER_GROUP_TITLES,
    draw_confusion as draw_confusion,
    format_figure as format_figure,
    format_page as format_page,
    format_plain_table as format_plain_table,
)
from .files import (
    draw_kinds as draw_kinds,
    write_case as write_case,
)
from .force import (
    ForceCase as ForceCase,
    draw_force_case as draw_force_case,
)
from .machine import (
    BlindMachine as BlindMachine,
    build_machine as build_machine,
)
from .part import (
    SignalStage as SignalStage,
    SimulationRun as SimulationRun,
)
from .scoring import (
    CaseOutcome as CaseOutcome,
    Cause as Cause,
    count_confusion as count_confusion,
    make_cause as make_cause,
    score as score,
    split_by_remainder as split_by_remainder,
)
from .sealing import (
    LabelSeal as LabelSeal,
    compute_digest as compute_digest,
    seal_label as seal_label,
)
