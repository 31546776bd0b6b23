"""Re-tuning of the parameters of the model."""

import sys
from pathlib import Path

import pytest

from rotemina.sim.gap.fit import baseline, is_own

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from short_records import DELAY, GAIN, make_evidence


def test_the_re_tuning_starts_from_the_unchanged_model():
    evidence = make_evidence(GAIN)
    assert baseline(evidence)
    assert evidence.residual(baseline(evidence)) == pytest.approx(evidence.residual(()), abs=1e-9)


def test_a_gain_is_a_parameter_of_the_model_and_a_delay_is_not():
    evidence = make_evidence()
    assert is_own(evidence, GAIN)
    assert not is_own(evidence, DELAY)
