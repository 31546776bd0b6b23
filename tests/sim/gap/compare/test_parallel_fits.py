"""Candidates tried in parallel."""

import sys
from pathlib import Path

import pytest

from rotemina.sim.gap.compare.diagnosis_progress import Account
from rotemina.sim.gap.compare.explanations import untouched
from rotemina.sim.gap.compare.parallel_fits import fitted, screened_beside
from rotemina.sim.gap.compare.ranking import Grade

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from short_records import LATE, LOOP, evidence


@pytest.fixture(scope="module")
def seen():
    return evidence(LATE)


def test_a_first_look_depends_on_the_candidates_alone(seen):
    begun, some = untouched(seen), [LATE, LOOP]
    costs = [
        [one.cost for one in screened_beside(seen, begun, order, Account("zn"), jobs, briefly=True)]
        for order, jobs in ((some, 1), (some, 2), (some[::-1], 2))
    ]
    assert costs[0] == costs[1] == costs[2][::-1]
    assert costs[0][0] < costs[0][1]


def test_the_true_cause_is_fitted_and_one_far_behind_is_given_up_but_told(seen):
    steps = []
    account = Account("zn", steps.append)
    best, behind = fitted(seen, [[LOOP], [LATE]], account, 1, untouched(seen))
    assert [one.id for one in best.causes] == [LATE.id]
    assert best.score < behind.score
    assert {one.grade for one in steps[-1].ranking.standings} == {Grade.UNSEEN}
