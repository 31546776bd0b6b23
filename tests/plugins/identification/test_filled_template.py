"""Texts that are English in a file, and translated in the window."""

import pytest
from PySide6.QtCore import QTranslator

from rotemina.plugins.identification.findings import FilledTemplate, translate_text


class UpperCaseTranslator(QTranslator):
    def translate(self, _context, text, _comment=None, _number=-1):
        return text.upper().replace("{N}", "{n}").replace("{WHAT}", "{what}")


@pytest.fixture
def upper_case_language(qapp):
    translator = UpperCaseTranslator()
    qapp.installTranslator(translator)
    yield
    qapp.removeTranslator(translator)


def test_a_text_stays_english_until_it_is_shown(upper_case_language):
    text = FilledTemplate("{n} steps: {what}", n=3, what="rise")
    assert text == "3 steps: rise"
    assert translate_text(text) == "3 STEPS: RISE"
    assert translate_text("median") == "MEDIAN"
    assert translate_text("") == ""
