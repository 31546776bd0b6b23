"""Charts of a diagnosis."""

from dataclasses import replace

import pytest

from rotemina.sim.gap.output.charts import draw_ranking, draw_waterfall
from rotemina.sim.gap.result import RankedCandidate

NAN = float("nan")
HYSTERESIS = RankedCandidate("hysteresis", None, None, 0.9, 1.2, (1.0, 1.5))
UNSIMULATED = RankedCandidate("creep", None, None, 0.1, NAN, (NAN, NAN))


def test_a_candidate_that_could_not_be_simulated_is_not_drawn():
    chart = draw_ranking([HYSTERESIS, UNSIMULATED])
    assert "Hysteresis" in chart
    assert "Creep" not in chart
    assert draw_ranking([UNSIMULATED]) is None
    assert draw_ranking([]) is None


@pytest.mark.parametrize("ceiling", [None, NAN, 4.4e-7])
def test_the_waterfall_shows_each_step_and_the_ceiling_if_it_is_known(diagnosis, ceiling):
    shrinkage = replace(diagnosis.axes["thx"].shrinkage[0], ceiling=ceiling)
    chart = draw_waterfall(shrinkage, "rad")
    assert "original model 33 µrad, re-tuned 32 µrad" in chart
    assert "noise floor" in chart
    assert ("black-box model" in chart) is (ceiling == 4.4e-7)
