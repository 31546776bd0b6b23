"""Texts of a report in the language that it is written in."""

import pytest

from rotemina.sim.gap.location import OperatingRegime
from rotemina.sim.gap.output import (
    AXIS_VERDICTS,
    REGIMES,
    ROBOT_VERDICTS,
    find_english_title,
    localize_effect_title,
    use_wording,
)
from rotemina.sim.gap.output.report_words import localize_text
from rotemina.sim.gap.result import UNKNOWN_EFFECT_ID, GapVerdict
from rotemina.sim.messages import MessageWording


class UpperCaseWording(MessageWording):
    def localize_text(self, _context, template):
        return template.upper()


def test_a_wording_applies_to_one_report_even_if_it_fails():
    with use_wording(UpperCaseWording()):
        assert localize_text("one row") == "ONE ROW"
        assert localize_effect_title("creep") == "CREEP"
    assert localize_text("one row") == "one row"
    with pytest.raises(ZeroDivisionError), use_wording(UpperCaseWording()):
        raise ZeroDivisionError
    assert localize_text("one row") == "one row"


def test_every_verdict_and_regime_has_a_text():
    assert set(ROBOT_VERDICTS) == set(AXIS_VERDICTS) == set(GapVerdict)
    assert set(REGIMES) == set(OperatingRegime)


def test_an_effect_that_is_not_installed_is_named_by_its_id():
    assert find_english_title("of_a_plugin") == "of_a_plugin"
    assert (
        find_english_title(UNKNOWN_EFFECT_ID)
        == localize_effect_title(UNKNOWN_EFFECT_ID)
        == "Unknown effect"
    )
