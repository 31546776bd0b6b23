"""Texts of a report in the language that it is written in."""

import pytest

from rotemina.sim.gap.diagnosis import UNKNOWN, Verdict
from rotemina.sim.gap.location.regimes import Regime
from rotemina.sim.gap.output.report.words import (
    AXIS_VERDICTS,
    REGIMES,
    VERDICTS,
    effect_title,
    english_title,
    said,
    worded,
)
from rotemina.sim.messages import Wording


class Loud(Wording):
    def text(self, _context, template):
        return template.upper()


def test_a_wording_holds_for_one_report():
    with worded(Loud()):
        assert said("one row") == "ONE ROW"
        assert effect_title("creep") == "CREEP"
    assert said("one row") == "one row"


def test_a_report_that_fails_leaves_no_wording_behind():
    with pytest.raises(ZeroDivisionError), worded(Loud()):
        raise ZeroDivisionError
    assert said("one row") == "one row"


def test_every_verdict_and_regime_has_a_text():
    assert set(VERDICTS) == set(AXIS_VERDICTS) == set(Verdict)
    assert set(REGIMES) == set(Regime)


def test_an_effect_that_is_not_installed_is_called_by_its_id():
    assert english_title("of_a_plugin") == "of_a_plugin"
    assert english_title(UNKNOWN) == effect_title(UNKNOWN) == "Unknown effect"
