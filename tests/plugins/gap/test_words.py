"""Words of the diagnosis that the page shows: each is marked for translation."""

import re

from PySide6.QtCore import QTranslator

from rotemina.app.cli.language import wording as wording_in
from rotemina.app.shell.engine_words import WindowWording
from rotemina.plugins.gap import words
from rotemina.sim.blind.figures_table import ROWS
from rotemina.sim.gap.location.regimes import Regime
from rotemina.sim.gap.output import wording
from rotemina.sim.gap.output.report import words as report
from rotemina.sim.gap.output.report.page import report_text
from rotemina.sim.gap.output.report.texts import TEXTS
from rotemina.sim.gap.output.summary import summary
from rotemina.sim.gap.output.wording import effect_on
from rotemina.sim.messages import AxisName, Listed, message
from rotemina.sim.quantities import amount


def test_every_word_of_the_diagnosis_is_marked_as_the_diagnosis_says_it():
    assert {regime: regime.value for regime in Regime} == report.REGIMES
    assert {text for text, _, _ in ROWS.values()} == set(words.FIGURES)


class Loud(QTranslator):
    """A language in which all is written in capital letters but what stands in fields."""

    def translate(self, _context, text, _comment=None, _number=-1):
        parts = re.split(r"(\{\w+\})", text)
        return "".join(part if part.startswith("{") else part.upper() for part in parts)


def test_all_of_a_message_is_translated_and_what_stands_in_it(qapp):
    held = message("gap", "{name} of {moved} while {held} is held")
    test = held.fill(name=message("gap", "chirp"), moved=AxisName("zn"), held=amount(5e-6, "m"))
    effects = Listed(
        (effect_on("creep", None), effect_on("cross_coupling", "thy")), one_of_them=True
    )
    said = message("gap", "play {test} to tell {effects}").fill(test=test, effects=effects)
    translator = Loud()
    qapp.installTranslator(translator)
    try:
        shown = WindowWording().of(said)
    finally:
        qapp.removeTranslator(translator)
    assert (
        shown == "PLAY CHIRP OF Z nano WHILE 5 µm IS HELD TO TELL CREEP OR CROSS COUPLING FROM θy"
    )


def test_an_effect_stands_within_a_sentence_as_its_language_writes_it():
    assert words.effect_title("creep") == "Creep"
    assert words.effect_word("creep") == "creep"
    assert words.within("Creep", "Kriechen") == "Kriechen"
    assert words.effect_title("of a plugin") == "of a plugin"


def test_the_window_says_the_answer_as_the_report_does_with_its_own_names(diagnosis, record):
    found = wording.summary(diagnosis, [record])
    said = [WindowWording().of(message) for message in found]
    assert [text.replace("θx", "thx").replace("θy", "thy") for text in said] == [*map(str, found)]


def test_summary_and_report_are_german_where_german_is_chosen(diagnosis, record):
    german = wording_in("de")
    english, shown = (summary(diagnosis, [record], one).splitlines() for one in (None, german))
    own = ("width =", "The rest depends on time.")  # of this answer alone: no text of ours
    same = [one for one in english if one in shown and not one.lstrip().startswith(own)]
    assert same == []
    assert any("Hysterese" in line and "0,91" in line for line in shown)
    page = report_text(diagnosis, [record], wording=german)
    assert '<html lang="de">' in page
    long = [text for text in TEXTS if len(text) > 40 and "{" not in text]
    assert [text for text in long if text in page] == []
