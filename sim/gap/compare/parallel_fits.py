"""Look at, or fit, many candidate explanations in parallel.

Results come in the order of the candidates, so they depend only on the input.
"""

from collections.abc import Callable, Sequence
from contextlib import closing
from functools import partial
from typing import TypeVar

from joblib import Parallel, delayed

from rotemina.sim.gap.compare.explanations import MOST_STEPS, Explanation, beside, explanation
from rotemina.sim.gap.compare.screening import Screened, screen
from rotemina.sim.gap.fit import (
    Evidence,
    Fit,
    finished,
    sketched,
)
from rotemina.sim.gap.result import Account, Grade
from rotemina.sim.robot import AxisEffect

_SKETCHED = 3  # steps after which attempts are compared
_BEHIND = 3.0  # times the cost of the best, from which an attempt is given up

_Result = TypeVar("_Result")


def screened_beside(
    evidence: Evidence,
    begun: Explanation,
    some: Sequence[AxisEffect],
    account: Account,
    jobs: int,
    *,
    briefly: bool,
) -> list[Screened]:
    """Take a first look at each cause of ``some``, added to the explanation ``begun``."""

    def told(number: int, one: Screened) -> None:
        account.tried([*begun.causes, some[number]], one.cost, Grade.LOOK)

    return _each(
        [partial(screen, evidence, begun.fit, one, briefly=briefly) for one in some], jobs, told
    )


def fitted(
    evidence: Evidence,
    attempts: Sequence[Sequence[AxisEffect]],
    account: Account,
    jobs: int,
    begun: Explanation,
) -> list[Explanation]:
    """Fit sets of causes; give up those that are far behind after a few steps.

    The model's own parameters start from their values in ``begun``.
    """
    number = len(attempts[0])

    def told(_: int, one: Fit) -> None:
        account.tried(one.effects[:number], one.cost, Grade.FIT)

    sketches = _each(
        [
            partial(sketched, evidence, beside(evidence, causes, begun), most_steps=_SKETCHED)
            for causes in attempts
        ],
        jobs,
        told,
    )
    least = min(one.cost for one in sketches)
    ahead = [one for one in sketches if one.cost <= _BEHIND * least]
    done = _each(
        [
            partial(finished, evidence, one, most_steps=MOST_STEPS - _SKETCHED, attempt=True)
            for one in ahead
        ],
        jobs,
        told,
    )
    behind = [one for one in sketches if one.cost > _BEHIND * least]
    found = []
    for one in (*done, *behind):
        found.append(explanation(evidence, number, one))
        account.tried(found[-1].causes, found[-1].score, Grade.UNSEEN)
    return found


def _each(
    tasks: Sequence[Callable[[], _Result]], jobs: int, told: Callable[[int, _Result], None]
) -> list[_Result]:
    """Return the results of tasks in their order; ``told`` hears of each as soon as it is there."""
    done: dict[int, _Result] = {}
    results = Parallel(n_jobs=jobs, prefer="threads", return_as="generator_unordered")(
        delayed(_numbered)(number, task) for number, task in enumerate(tasks)
    )
    with closing(results):  # also where a listener has heard enough
        for number, result in results:
            done[number] = result
            told(number, result)
    return [done[number] for number in range(len(tasks))]


def _numbered(number: int, task: Callable[[], _Result]) -> tuple[int, _Result]:
    return number, task()
