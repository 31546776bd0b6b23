"""Texts of the diagnosis that the page shows: all of them can be translated."""

import re

from PySide6.QtCore import QTranslator

from rotemina.app.cli.terminal import load_wording
from rotemina.app.language import WindowWording
from rotemina.plugins.gap.answer import words
from rotemina.sim.blind import FIGURE_ROWS
from rotemina.sim.gap.location import OperatingRegime
from rotemina.sim.gap.output import (
    make_report_text,
    make_summary_text,
    name_effect,
    report_words as report,
    wording,
)
from rotemina.sim.gap.output.report_texts import PAGE_TEXTS
from rotemina.sim.messages import (
    AxisName,
    FieldList,
    message,
)
from rotemina.sim.units import format_quantity


def test_translatable_names_match_those_of_the_diagnosis():
    assert {regime: regime.value for regime in OperatingRegime} == report.REGIMES
    assert {text for text, _, _ in FIGURE_ROWS.values()} == set(words.FIGURE_NAMES)


class UpperCaseTranslator(QTranslator):
    """A language that writes everything in capital letters, except for the fields."""

    def translate(self, _context, text, _comment=None, _number=-1):
        parts = re.split(r"(\{\w+\})", text)
        return "".join(part if part.startswith("{") else part.upper() for part in parts)


def test_a_message_is_translated_together_with_its_fields(qapp):
    hold_message = message("gap", "{name} of {moved} while {held} is held")
    test = hold_message.fill(
        name=message("gap", "chirp"), moved=AxisName("zn"), held=format_quantity(5e-6, "m")
    )
    effects = FieldList(
        (name_effect("creep", None), name_effect("cross_coupling", "thy")), one_of_them=True
    )
    instruction = message("gap", "play {test} to tell {effects}").fill(test=test, effects=effects)
    translator = UpperCaseTranslator()
    qapp.installTranslator(translator)
    try:
        text = WindowWording().format_message(instruction)
    finally:
        qapp.removeTranslator(translator)
    assert text == "PLAY CHIRP OF Z nano WHILE 5 µm IS HELD TO TELL CREEP OR CROSS COUPLING FROM θy"


def test_effect_names_in_a_sentence_follow_the_case_of_the_language():
    assert words.effect_title("creep") == "Creep"
    assert words.effect_word("creep") == "creep"
    assert words.fit_in_sentence("Creep", "Kriechen") == "Kriechen"
    assert words.effect_title("of a plugin") == "of a plugin"


def test_the_window_and_the_report_use_the_same_sentences(diagnosis, record):
    summary = wording.write_summary(diagnosis, [record])
    window_texts = [WindowWording().format_message(message) for message in summary]
    assert [text.replace("θx", "thx").replace("θy", "thy") for text in window_texts] == [
        *map(str, summary)
    ]


def test_summary_and_report_are_written_in_german(diagnosis, record):
    german = load_wording("de")
    english_lines, german_lines = (
        make_summary_text(diagnosis, [record], language).splitlines() for language in (None, german)
    )
    untranslated_starts = ("width =", "The rest depends on time.")  # content of this answer
    unchanged_lines = [
        line
        for line in english_lines
        if line in german_lines and not line.lstrip().startswith(untranslated_starts)
    ]
    assert unchanged_lines == []
    assert any("Hysterese" in line and "0,91" in line for line in german_lines)
    page = make_report_text(diagnosis, [record], wording=german)
    assert '<html lang="de">' in page
    long_texts = [text for text in PAGE_TEXTS if len(text) > 40 and "{" not in text]
    assert [text for text in long_texts if text in page] == []
