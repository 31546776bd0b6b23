"""The search of gains for the panel; free of Qt."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from rotemina.sim.compensate.inverse import Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.robot.model import Robot
from rotemina.sim.tuning.search import Generation, SearchSettings, generations
from rotemina.sim.tuning.search_problem import TuningProblem
from rotemina.sim.tuning.tuning_result import Tuning, tuning_of

RATE_HZ = 5000.0


def problem_of(robot: Robot, axis: str, model: InverseModel | None) -> TuningProblem:
    """Return the problem of an axis, fed forward through an inverse or not.

    Raises
    ------
    TuningError, FeedbackError, EffectError
        If the axis cannot be tuned.
    """
    inverse = None if model is None else Inverse(model, 1.0 / RATE_HZ, preview=True)
    return TuningProblem(robot, axis, RATE_HZ, inverse=inverse)


def search(
    problem: TuningProblem,
    settings: SearchSettings,
    tell: Callable[[Generation], bool],
    inverse: str,
) -> Tuning:
    """Search until the end or until ``tell`` requests a stop; return the result.

    Raises
    ------
    TuningError
        If no gains keep the constraints.
    """
    last = None
    jobs = max((os.cpu_count() or 1) - 1, 1)  # one core stays free for the machine
    with ThreadPoolExecutor(jobs) as pool:
        for last in generations(problem, settings, pool.map):
            if not tell(last):
                break
    assert last is not None, "settings ask for one generation at least"
    return tuning_of(problem, settings, last, inverse=inverse)
