"""What the page calls verdicts, effects and regimes, in the language of the window.

The diagnosis says them in English: these tables mark its words for translation. What is not among
them, as a plugin's effect, is shown as the diagnosis says it. Effects and formulations are marked
where they are switched, in the context of the effects panel.
"""

from collections.abc import Sequence

from rotemina.app.shell.language import translate
from rotemina.plugins.gap import mark, tr
from rotemina.sim.gap.diagnosis import UNKNOWN
from rotemina.sim.gap.location.regimes import Regime
from rotemina.sim.gap.output.report.words import AXIS_VERDICTS as AXIS_VERDICTS
from rotemina.sim.gap.output.report.words import REGIMES, UNKNOWN_EFFECT, english_title
from rotemina.sim.gap.output.report.words import VERDICTS as VERDICTS
from rotemina.sim.messages import listed

# What is done now, as the line beside the bar of progress says it.
STAGES = {
    "reading": mark("reading"),
    "where": mark("where"),
    "screening": mark("screening"),
    "fitting": mark("fitting"),
    "deciding": mark("deciding"),
    "drawing": mark("drawing"),
}
# The figures of a blind test.
FIGURES = (
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
    """Return an effect's name for people; its id where it is not installed."""
    if effect_id == UNKNOWN:
        return tr(UNKNOWN_EFFECT)
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
    return tr(REGIMES[regime]) if regime in REGIMES else str(regime)


def stage_name(stage: str) -> str:
    """Return what is done now."""
    return tr(STAGES[stage]) if stage in STAGES else stage


def any_of(names: Sequence[str]) -> str:
    """Return names as a sentence lists them, of which one holds."""
    return listed(names, tr("or"))


def all_of(names: Sequence[str]) -> str:
    """Return names as a sentence lists them."""
    return listed(names, tr("and"))
