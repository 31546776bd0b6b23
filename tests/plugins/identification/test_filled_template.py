"""Texts that a file has in English, and the window in its own language."""

import pytest
from PySide6.QtCore import QTranslator

from rotemina.plugins.identification.filled_template import FilledTemplate, localized


class Loud(QTranslator):
    def translate(self, _context, text, _comment=None, _number=-1):
        return text.upper().replace("{N}", "{n}").replace("{WHAT}", "{what}")


@pytest.fixture
def loud(qapp):
    translator = Loud()
    qapp.installTranslator(translator)
    yield
    qapp.removeTranslator(translator)


def test_a_text_stays_english_until_it_is_shown(loud):
    text = FilledTemplate("{n} steps: {what}", n=3, what="rise")
    assert text == "3 steps: rise"
    assert localized(text) == "3 STEPS: RISE"
    assert localized("median") == "MEDIAN"
    assert localized("") == ""
