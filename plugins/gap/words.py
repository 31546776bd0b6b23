"""What the page calls verdicts, effects and regimes, in the language of the window.

The diagnosis says them in English: these tables mark its words for translation. What is not among
them, as a plugin's effect, is shown as the diagnosis says it. Effects and formulations are marked
where they are switched, in the context of the effects panel.
"""

from collections.abc import Sequence

from rotemina.app.shell.language import marked, translate
from rotemina.sim.gap.diagnosis import UNKNOWN
from rotemina.sim.gap.regimes import Regime
from rotemina.sim.gap.report.words import (
    AXIS_VERDICTS as AXIS_VERDICTS,
)
from rotemina.sim.gap.report.words import (
    REGIMES,
    UNKNOWN_EFFECT,
    english_title,
)
from rotemina.sim.gap.report.words import (
    VERDICTS as VERDICTS,
)
from rotemina.sim.messages import listed

# What is done now, as the line beside the bar of progress says it.
STAGES = {
    "reading": marked("gap", "reading"),
    "where": marked("gap", "where"),
    "screening": marked("gap", "screening"),
    "fitting": marked("gap", "fitting"),
    "deciding": marked("gap", "deciding"),
    "drawing": marked("gap", "drawing"),
}
# The figures of a blind test.
FIGURES = (
    marked("gap", "first cause correct, one effect"),
    marked("gap", "… where the gap is ≥ 5 floors"),
    marked("gap", "… where it is smaller"),
    marked("gap", "exactly one effect and no other"),
    marked("gap", "truth in the reported set"),
    marked("gap", "mean size of the set"),
    marked("gap", "exactly two effects"),
    marked("gap", "exactly three effects"),
    marked("gap", "false cause named"),
    marked("gap", "verdict: explained or partly"),
    marked("gap", "healthy machines blamed"),
    marked("gap", "unknown effects recognised"),
    marked("gap", "poor excitation recognised"),
    marked("gap", "gap closed on unseen data, median"),
    marked("gap", "gap closed, 10th percentile"),
    marked("gap", "expected calibration error"),
    marked("gap", "seconds per case, median"),
    marked("gap", "seconds per case, maximum"),
    marked("gap", "seconds per healthy case, median"),
)


def effect_title(effect_id: str) -> str:
    """Return an effect's name for people; its id where it is not installed."""
    if effect_id == UNKNOWN:
        return translate("gap", UNKNOWN_EFFECT)
    return translate("effects", english_title(effect_id))


def effect_word(effect_id: str) -> str:
    """Return an effect's name as it stands within a sentence."""
    return within(english_title(effect_id), effect_title(effect_id))


def within(english: str, shown: str) -> str:
    """Return a text as it stands within a sentence: an English one without its capital letters."""
    return shown.lower() if shown == english else shown


def formulation_name(name: str) -> str:
    """Return what a formulation is called."""
    return translate("effects", name.replace("_", " "))


def regime_name(regime: Regime) -> str:
    """Return what an axis does in a regime."""
    return translate("gap", REGIMES[regime]) if regime in REGIMES else str(regime)


def stage_name(stage: str) -> str:
    """Return what is done now."""
    return translate("gap", STAGES[stage]) if stage in STAGES else stage


def any_of(names: Sequence[str]) -> str:
    """Return names as a sentence lists them, of which one holds."""
    return listed(names, translate("gap", "or"))


def all_of(names: Sequence[str]) -> str:
    """Return names as a sentence lists them."""
    return listed(names, translate("gap", "and"))
