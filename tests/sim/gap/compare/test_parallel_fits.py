"""Candidates tried in parallel."""

import sys
from pathlib import Path

import pytest

from rotemina.sim.gap.compare import untouched
from rotemina.sim.gap.compare.parallel_fits import fitted, screened_beside
from rotemina.sim.gap.result import Account, Grade

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from short_records import DELAY, HYSTERESIS, make_evidence


@pytest.fixture(scope="module")
def evidence():
    return make_evidence(DELAY)


def test_screening_depends_only_on_the_candidates(evidence):
    start, candidates = untouched(evidence), [DELAY, HYSTERESIS]
    costs = [
        [
            result.cost
            for result in screened_beside(evidence, start, order, Account("zn"), jobs, briefly=True)
        ]
        for order, jobs in ((candidates, 1), (candidates, 2), (candidates[::-1], 2))
    ]
    assert costs[0] == costs[1] == costs[2][::-1]
    assert costs[0][0] < costs[0][1]


def test_the_true_cause_is_fitted_and_a_bad_one_is_abandoned_but_reported(evidence):
    steps = []
    account = Account("zn", steps.append)
    best, worse = fitted(evidence, [[HYSTERESIS], [DELAY]], account, 1, untouched(evidence))
    assert [cause.id for cause in best.causes] == [DELAY.id]
    assert best.score < worse.score
    assert {standing.grade for standing in steps[-1].ranking.standings} == {Grade.UNSEEN}
