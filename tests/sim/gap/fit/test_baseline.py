"""The model's own parameters, re-tuned from none on."""

import sys
from pathlib import Path

import pytest

from rotemina.sim.gap.fit.baseline import baseline, is_own

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from short_records import GAIN, LATE, evidence


def test_the_re_tuning_begins_with_the_model_as_it_is():
    seen = evidence(GAIN)
    assert baseline(seen)
    assert seen.residual(baseline(seen)) == pytest.approx(seen.residual(()), abs=1e-9)


def test_a_gain_is_one_of_the_models_own_parameters_and_a_delay_is_none():
    seen = evidence()
    assert is_own(seen, GAIN)
    assert not is_own(seen, LATE)
