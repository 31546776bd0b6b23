"""Words of the diagnosis that the page shows: each is marked for translation."""

from rotemina.plugins.gap import words
from rotemina.sim.blind.table import ROWS
from rotemina.sim.gap.regimes import Regime
from rotemina.sim.gap.report import words as report


def test_every_word_of_the_diagnosis_is_marked_as_the_diagnosis_says_it():
    assert words.VERDICTS == report.VERDICTS
    assert words.AXIS_VERDICTS == report.AXIS_VERDICTS
    assert {regime: regime.value for regime in Regime} == words.REGIMES
    assert {text for text, _, _ in ROWS.values()} == set(words.FIGURES)


def test_an_effect_stands_within_a_sentence_as_its_language_writes_it():
    assert words.effect_title("creep") == "Creep"
    assert words.effect_word("creep") == "creep"
    assert words.within("Creep", "Kriechen") == "Kriechen"
    assert words.effect_title("of a plugin") == "of a plugin"


def test_the_answer_in_sentences_is_as_the_report_has_it(diagnosis, record):
    said = words.summary(diagnosis, [record])
    told = report.summary(diagnosis, [record])
    assert [text.replace("θx", "thx").replace("θy", "thy") for text in said] == told
