"""The search: NSGA-II over the gains of one axis.

Individuals are ranked by fronts that none dominates, those on one front by how alone they stand
(Deb, Pratap, Agarwal and Meyarivan, IEEE Transactions on Evolutionary Computation 6 (2002)
182–197); those that break a constraint come behind all that break none.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.messages import message
from rotemina.sim.tuning.errors import TuningError
from rotemina.sim.tuning.objectives import SecondObjective
from rotemina.sim.tuning.pareto_front import Point
from rotemina.sim.tuning.performance_figures import Figures
from rotemina.sim.tuning.search_problem import VARIABLES, TuningProblem

_NEVER = 1e6  # an objective, and a broken constraint, of what cannot be simulated
# A search of the most generations and individuals takes days; one of more fills the memory.
_BOUNDS = {"generations": (1, 10_000), "population": (4, 10_000), "seed": (0, 2**32 - 1)}
Mapper = Callable[[Callable[[Gains], Figures], Iterable[Gains]], Iterable[Figures]]


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings:
    """How long and for what is searched.

    Attributes
    ----------
    generations, population, seed : int
    against : Against
    """

    generations: int = 50
    population: int = 60
    seed: int = 1
    against: SecondObjective = SecondObjective.EFFORT

    def __post_init__(self) -> None:
        for name, (least, most) in _BOUNDS.items():
            if not least <= getattr(self, name) <= most:
                raise TuningError(
                    message("engine", "{name} {value}: must be {least} to {most}").fill(
                        name=name, value=getattr(self, name), least=least, most=most
                    )
                )


@dataclass(frozen=True, slots=True)
class Generation:
    """The state after ``done`` of ``total`` generations.

    ``front`` holds the best points that break no constraint, by rising tracking error; empty where
    there is none yet.
    """

    done: int
    total: int
    front: tuple[Point, ...]

    @property
    def share(self) -> float:
        """Of the whole that is done."""
        return self.done / self.total


def generations(
    problem: TuningProblem, settings: SearchSettings, evaluate_all: Mapper = map
) -> Iterator[Generation]:
    """Search, and yield the state after each generation; ending the iteration ends the search.

    ``evaluate_all`` is ``map``, or one that works on several cores: figures depend on gains alone,
    so the search is the same.
    """
    # The library takes tenths of a second to load, for which no start of the window waits.
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.core.evaluator import Evaluator
    from pymoo.core.problem import Problem
    from pymoo.problems.static import StaticProblem

    space = Problem(n_var=len(VARIABLES), n_obj=2, n_ieq_constr=3, xl=0.0, xu=1.0)
    algorithm = NSGA2(pop_size=settings.population)
    algorithm.setup(space, termination=("n_gen", settings.generations), seed=settings.seed)
    known: dict[bytes, Point] = {}
    for done in range(1, settings.generations + 1):
        asked = algorithm.ask()
        shares = np.ascontiguousarray(asked.get("X"), dtype=np.float64)
        gains = [problem.gains_of(row) for row in shares]
        figures = list(evaluate_all(problem.evaluate, gains))
        known |= {
            row.tobytes(): Point(gains=own, figures=found)
            for row, own, found in zip(shares, gains, figures, strict=True)
        }
        scored = StaticProblem(
            space,
            F=np.array([objectives_of(one, settings.against) for one in figures]),
            G=np.array([_broken(one, problem) for one in figures]),
        )
        Evaluator().eval(scored, asked)
        algorithm.tell(infills=asked)
        yield Generation(done, settings.generations, _front(algorithm.opt, known, problem))


def objectives_of(figures: Figures, against: SecondObjective) -> tuple[float, float]:
    """Return the objectives to minimise."""
    second = figures.settling_s if against is SecondObjective.SETTLING else figures.effort
    return min(figures.tracking_rms, _NEVER), min(second, _NEVER)


def _broken(figures: Figures, problem: TuningProblem) -> FloatArray:
    """Return by how much each constraint is broken; none above zero is kept."""
    bounds = problem.constraints
    excess = (
        figures.peak_sensitivity / bounds.peak_sensitivity - 1.0,
        figures.overshoot - bounds.overshoot,
        figures.limited,
    )
    return np.minimum(np.array(excess, dtype=np.float64), _NEVER)


def _front(best: object, known: dict[bytes, Point], problem: TuningProblem) -> tuple[Point, ...]:
    """Return the points of the first front that break no constraint, without copies."""
    rows = np.ascontiguousarray(best.get("X"), dtype=np.float64)  # type: ignore[attr-defined]
    points = {row.tobytes(): known[row.tobytes()] for row in rows}.values()
    kept = [point for point in points if (_broken(point.figures, problem) <= 0.0).all()]
    return tuple(sorted(kept, key=lambda point: point.figures.tracking_rms))
