from . import html_page as html_page
from .constant_offsets import (
    estimate_offsets as estimate_offsets,
)
from .digital_twin import (
    make_twin_text as make_twin_text,
    write_twin as write_twin,
)
from .document import (
    ExperimentFiles as ExperimentFiles,
    as_json as as_json,
    compute_shares as compute_shares,
)
from .document_reader import (
    read_document as read_document,
)
from .gap_by_band_and_regime import (
    GapHeatmap as GapHeatmap,
    make_heatmap as make_heatmap,
)
from .html_frame import (
    make_environment as make_environment,
)
from .html_page import (
    make_report_text as make_report_text,
)
from .prediction import (
    predict as predict,
)
from .report_words import (
    AXIS_VERDICTS as AXIS_VERDICTS,
    REGIMES as REGIMES,
    ROBOT_VERDICTS as ROBOT_VERDICTS,
    UNKNOWN_EFFECT_TITLE as UNKNOWN_EFFECT_TITLE,
    find_english_title as find_english_title,
    find_parameter_unit as find_parameter_unit,
    localize as localize,
    localize_effect_title as localize_effect_title,
    unit_of as unit_of,
    use_wording as use_wording,
)
from .summary import (
    make_summary_text as make_summary_text,
)
from .svg_pictures import (
    ColourRole as ColourRole,
    add_legend as add_legend,
    draw_picture as draw_picture,
)
from .traces import (
    GapTrace as GapTrace,
    compute_traces as compute_traces,
)
from .wording import (
    name_effect as name_effect,
    name_group as name_group,
    write_details as write_details,
    write_findings as write_findings,
)
