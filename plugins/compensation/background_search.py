"""Search for loop gains. This module does not use Qt."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from rotemina.sim.compensate import Inverse, InverseModel
from rotemina.sim.robot import Robot
from rotemina.sim.tuning import (
    SearchGeneration,
    SearchSettings,
    TuningProblem,
    TuningResult,
    make_tuning,
    run_search,
)

LOOP_RATE_HZ = 5000.0


def make_problem(robot: Robot, axis: str, model: InverseModel | None) -> TuningProblem:
    """Return the tuning problem of an axis.

    ``model`` is the inverse model for the feed-forward, or None for a loop without it.

    Raises
    ------
    TuningError, FeedbackError, EffectError
        If the axis cannot be tuned.
    """
    inverse = None if model is None else Inverse(model, 1.0 / LOOP_RATE_HZ, preview=True)
    return TuningProblem(robot, axis, LOOP_RATE_HZ, inverse=inverse)


def search_gains(
    problem: TuningProblem,
    settings: SearchSettings,
    report: Callable[[SearchGeneration], bool],
    inverse: str,
) -> TuningResult:
    """Return the result of a search.

    It runs to the last generation, or until ``report``, called after each one, returns False.

    Raises
    ------
    TuningError
        If no gains meet the constraints.
    """
    latest = None
    # One core stays free for the control of the machine.
    thread_count = max((os.cpu_count() or 1) - 1, 1)
    with ThreadPoolExecutor(thread_count) as pool:
        for latest in run_search(problem, settings, pool.map):
            if not report(latest):
                break
    assert latest is not None, "the settings require at least one generation"
    return make_tuning(problem, settings, latest, inverse=inverse)
