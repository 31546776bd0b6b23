"""Names of verdicts, effects and regimes in the UI language.

The diagnosis uses English names, which these tables mark for translation. A name that is not in the
tables, such as that of a plugin's effect, is shown untranslated. The names of effects and
formulations are translated in the context of the Effects panel.
"""

from collections.abc import Sequence

from rotemina.app.language import translate
from rotemina.plugins.gap import mark, tr
from rotemina.sim.gap.location import OperatingRegime
from rotemina.sim.gap.output import (
    AXIS_VERDICTS as AXIS_VERDICTS,
    REGIMES,
    ROBOT_VERDICTS as ROBOT_VERDICTS,
    UNKNOWN_EFFECT_TITLE,
    find_english_title,
)
from rotemina.sim.gap.result import UNKNOWN_EFFECT_ID
from rotemina.sim.messages import join_names

# Names of the steps of a diagnosis, as shown next to the progress bar.
STAGE_WORDS = {
    "reading": mark("reading"),
    "where": mark("where"),
    "screening": mark("screening"),
    "fitting": mark("fitting"),
    "deciding": mark("deciding"),
    "drawing": mark("drawing"),
}
# Names of the scores of a blind test.
FIGURE_NAMES = (
    mark("first cause correct, one effect"),
    mark("… where the gap is ≥ 5 floors"),
    mark("… where it is smaller"),
    mark("exactly one effect and no other"),
    mark("truth in the reported set"),
    mark("mean size of the set"),
    mark("exactly two effects"),
    mark("exactly three effects"),
    mark("false cause named"),
    mark("verdict: explained or partly"),
    mark("false alarms on healthy machines"),
    mark("unknown effects recognised"),
    mark("poor excitation recognised"),
    mark("… or exactly its cause named"),
    mark("gap closed on unseen data, median"),
    mark("gap closed, 10th percentile"),
    mark("expected calibration error"),
    mark("seconds per case, median"),
    mark("seconds per case, maximum"),
    mark("seconds per healthy case, median"),
)


def effect_title(effect_id: str) -> str:
    """Return the name of an effect, or its id if it is not installed."""
    if effect_id == UNKNOWN_EFFECT_ID:
        return tr(UNKNOWN_EFFECT_TITLE)
    return translate("effects", find_english_title(effect_id))


def effect_word(effect_id: str) -> str:
    """Return the name of an effect as written within a sentence."""
    return fit_in_sentence(find_english_title(effect_id), effect_title(effect_id))


def fit_in_sentence(english: str, translation: str) -> str:
    """Return a name as written within a sentence, that is, in lower case if it is English."""
    return translation.lower() if translation == english else translation


def formulation_name(name: str) -> str:
    """Return the name of a formulation."""
    return translate("effects", name.replace("_", " "))


def regime_name(regime: OperatingRegime) -> str:
    """Return the name of a regime."""
    return tr(REGIMES[regime]) if regime in REGIMES else str(regime)


def stage_name(stage: str) -> str:
    """Return the name of a step of the diagnosis."""
    return tr(STAGE_WORDS[stage]) if stage in STAGE_WORDS else stage


def join_with_or(names: Sequence[str]) -> str:
    """Join names into a list with "or" before the last one."""
    return join_names(names, tr("or"))


def join_with_and(names: Sequence[str]) -> str:
    """Join names into a list with "and" before the last one."""
    return join_names(names, tr("and"))
