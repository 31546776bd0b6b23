"""The search for the gains of one axis by the genetic algorithm NSGA-II.

Individuals are ranked by non-dominated fronts, and within a front by their crowding distance (Deb,
Pratap, Agarwal and Meyarivan, IEEE Transactions on Evolutionary Computation 6 (2002) 182–197).
Individuals that violate a constraint rank behind all that violate none.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import TuningError
from rotemina.sim.feedback import ControllerGains
from rotemina.sim.tuning.pareto_front import FrontPoint, SecondObjective
from rotemina.sim.tuning.performance_figures import TuningFigures
from rotemina.sim.tuning.search_problem import VARIABLES, TuningProblem

# Objectives and excesses over constraints are limited to this value, which also stands for gains
# that cannot be simulated.
_MAX_OBJECTIVE = 1e6
# A search with the largest number of generations and the largest population takes days. A larger
# one would exhaust the memory.
_SETTING_BOUNDS = {"generations": (1, 10_000), "population": (4, 10_000), "seed": (0, 2**32 - 1)}
EvaluationMap = Callable[
    [Callable[[ControllerGains], TuningFigures], Iterable[ControllerGains]], Iterable[TuningFigures]
]


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings:
    """Extent and second objective of a search.

    Attributes
    ----------
    generations, population, seed : int
    against : SecondObjective
    """

    generations: int = 50
    population: int = 60
    seed: int = 1
    against: SecondObjective = SecondObjective.EFFORT

    def __post_init__(self) -> None:
        for name, (low, high) in _SETTING_BOUNDS.items():
            if not low <= getattr(self, name) <= high:
                raise TuningError(
                    "{name} {value}: must be {least} to {most}",
                    name=name,
                    value=getattr(self, name),
                    least=low,
                    most=high,
                )


@dataclass(frozen=True, slots=True)
class SearchGeneration:
    """State of a search after ``done`` of ``total`` generations.

    ``front`` contains the best points that violate no constraint, in order of rising tracking
    error. It is empty if there is no such point yet.
    """

    done: int
    total: int
    front: tuple[FrontPoint, ...]

    @property
    def completed_share(self) -> float:
        """Completed share of all generations."""
        return self.done / self.total


def run_search(
    problem: TuningProblem, settings: SearchSettings, evaluate_all: EvaluationMap = map
) -> Iterator[SearchGeneration]:
    """Search for gains and yield the state after each generation.

    The search stops when the caller stops iterating. ``evaluate_all`` is ``map`` or a parallel map.
    Figures depend only on the gains, so both give the same result.
    """
    # Imported here, because the library takes tenths of a second to load and would delay every
    # start of the program.
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.core.evaluator import Evaluator
    from pymoo.core.problem import Problem
    from pymoo.problems.static import StaticProblem

    space = Problem(n_var=len(VARIABLES), n_obj=2, n_ieq_constr=3, xl=0.0, xu=1.0)
    algorithm = NSGA2(pop_size=settings.population)
    algorithm.setup(space, termination=("n_gen", settings.generations), seed=settings.seed)
    evaluated_points: dict[bytes, FrontPoint] = {}
    for done in range(1, settings.generations + 1):
        individuals = algorithm.ask()
        shares = np.ascontiguousarray(individuals.get("X"), dtype=np.float64)
        gains = [problem.gains_of(row) for row in shares]
        figures = list(evaluate_all(problem.evaluate, gains))
        evaluated_points |= {
            row.tobytes(): FrontPoint(gains=row_gains, figures=row_figures)
            for row, row_gains, row_figures in zip(shares, gains, figures, strict=True)
        }
        scored = StaticProblem(
            space,
            F=np.array([compute_objectives(candidate, settings.against) for candidate in figures]),
            G=np.array([_compute_constraint_excess(candidate, problem) for candidate in figures]),
        )
        Evaluator().eval(scored, individuals)
        algorithm.tell(infills=individuals)
        yield SearchGeneration(
            done,
            settings.generations,
            _make_admissible_front(algorithm.opt, evaluated_points, problem),
        )


def compute_objectives(figures: TuningFigures, against: SecondObjective) -> tuple[float, float]:
    """Return the two objectives, which are to be minimised."""
    second = figures.settling_s if against is SecondObjective.SETTLING else figures.effort
    return min(figures.tracking_rms, _MAX_OBJECTIVE), min(second, _MAX_OBJECTIVE)


def _compute_constraint_excess(figures: TuningFigures, problem: TuningProblem) -> FloatArray:
    """Return the excess (3,) of each constraint, which is violated above zero."""
    constraints = problem.constraints
    excess = (
        figures.peak_sensitivity / constraints.peak_sensitivity - 1.0,
        figures.overshoot - constraints.overshoot,
        figures.limited,
    )
    return np.minimum(np.array(excess, dtype=np.float64), _MAX_OBJECTIVE)


def _make_admissible_front(
    best_individuals: object, evaluated_points: dict[bytes, FrontPoint], problem: TuningProblem
) -> tuple[FrontPoint, ...]:
    rows = np.ascontiguousarray(best_individuals.get("X"), dtype=np.float64)  # type: ignore[attr-defined]
    points = {row.tobytes(): evaluated_points[row.tobytes()] for row in rows}.values()
    admissible = [
        point
        for point in points
        if (_compute_constraint_excess(point.figures, problem) <= 0.0).all()
    ]
    return tuple(sorted(admissible, key=lambda point: point.figures.tracking_rms))
