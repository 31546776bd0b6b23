"""The result of a tuning and its TOML file, which records how the result was obtained."""

from collections.abc import Mapping
from dataclasses import asdict, replace
from importlib.metadata import version
from os import PathLike, fspath
from typing import Any, Literal

import numpy as np
import tomli_w
from pydantic import TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from rotemina.sim.errors import TuningError, describe_exception
from rotemina.sim.files import parse_toml, read_text, replace_file
from rotemina.sim.robot import FORBID_UNKNOWN
from rotemina.sim.tuning.pareto_front import FrontPoint, SecondObjective, find_knee
from rotemina.sim.tuning.search import SearchGeneration, SearchSettings, compute_objectives
from rotemina.sim.tuning.search_problem import TuningProblem

_MAX_FILE_BYTES = 4_000_000


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class TuningProvenance:
    """Program, robot and settings of a tuning.

    Attributes
    ----------
    program, robot : str
    effects : tuple of str
        Effects of the simulated axis.
    inverse : str
        Inverse in the feed-forward; empty if there is none.
    generations, done, population, seed : int
        Requested and completed generations, size of the population, and seed.
    against : SecondObjective
    peak_sensitivity, overshoot, spread : float
        Constraints, and the relative deviation of gain and resonance.
    """

    program: str
    robot: str
    effects: tuple[str, ...]
    inverse: str
    generations: int
    done: int
    population: int
    seed: int
    against: SecondObjective
    peak_sensitivity: float
    overshoot: float
    spread: float

    @property
    def is_complete(self) -> bool:
        """Whether the search ran to its end."""
        return self.done == self.generations


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class TuningResult:
    """A front of gains for one axis.

    Attributes
    ----------
    axis : str
    rate_hz : float
    delay : int
    recommended, chosen : int
        Indices of points, from 0.
    points : tuple of FrontPoint
        In order of rising tracking error.
    provenance : TuningProvenance
    """

    format: Literal["rotemina-tuning 1"] = "rotemina-tuning 1"
    axis: str
    rate_hz: float
    delay: int
    recommended: int
    chosen: int
    provenance: TuningProvenance
    points: tuple[FrontPoint, ...]

    @property
    def chosen_point(self) -> FrontPoint:
        """The chosen point."""
        return self.points[self.chosen]

    def with_choice(self, number: int) -> "TuningResult":
        """Return the tuning with another point chosen.

        Raises
        ------
        TuningError
            If there is no such point.
        """
        if not 0 <= number < len(self.points):
            raise TuningError(
                "point {number}: the front has points 0 to {count}; choose one",
                number=number,
                count=len(self.points) - 1,
            )
        return replace(self, chosen=number)


def make_tuning(
    problem: TuningProblem, settings: SearchSettings, last: SearchGeneration, *, inverse: str = ""
) -> TuningResult:
    """Return the result of a search that ended with the generation ``last``.

    The knee of the front is recommended and chosen.

    Raises
    ------
    TuningError
        If no point meets the constraints.
    """
    if not last.front:
        constraints = problem.constraints
        raise TuningError(
            "axis {axis}: after {done} generations no gains meet Ms ≤ {peak_sensitivity} "
            "and overshoot ≤ {overshoot} %; search longer, use a faster loop, or relax the "
            "limits",
            axis=problem.axis,
            done=last.done,
            peak_sensitivity=constraints.peak_sensitivity,
            overshoot=100.0 * constraints.overshoot,
        )
    objectives = np.array(
        [compute_objectives(point.figures, settings.against) for point in last.front]
    )
    knee = find_knee(objectives)
    provenance = TuningProvenance(
        program=f"rotemina {version('rotemina')}",
        robot=problem.robot.name,
        effects=tuple(str(effect) for effect in problem.loop.plant.effects),
        inverse=inverse,
        generations=settings.generations,
        done=last.done,
        population=settings.population,
        seed=settings.seed,
        against=settings.against,
        peak_sensitivity=problem.constraints.peak_sensitivity,
        overshoot=problem.constraints.overshoot,
        spread=problem.spread,
    )
    return TuningResult(
        axis=problem.axis,
        rate_hz=problem.rate_hz,
        delay=problem.delay,
        recommended=knee,
        chosen=knee,
        provenance=provenance,
        points=last.front,
    )


def to_document(tuning: TuningResult) -> dict[str, Any]:
    """Return a tuning as plain tables without empty entries."""
    document: dict[str, Any] = _drop_none(asdict(tuning))
    return document


def save_tuning(tuning: TuningResult, path: str | PathLike[str]) -> None:
    """Write a tuning as TOML, completely or not at all.

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    """
    with replace_file(path) as file:
        file.write(tomli_w.dumps(to_document(tuning)).encode("utf-8"))


def load_tuning(path: str | PathLike[str]) -> TuningResult:
    """Read a tuning from a file.

    Raises
    ------
    TuningError
        If the file is not valid. The message names file, key, value and bound.
    """
    name = fspath(path)
    table = parse_toml(read_text(path, TuningError, _MAX_FILE_BYTES), name, TuningError)
    try:
        tuning = TypeAdapter(TuningResult).validate_python(table)
    except ValidationError as error:
        first_error = error.errors()[0]
        key = ".".join(str(part) for part in first_error["loc"])
        raise TuningError(
            "{name}: {key} = {value}: {reason}",
            name=name,
            key=key,
            value=repr(first_error["input"]),
            reason=first_error["msg"],
        ) from error
    except ValueError as error:
        # The gains check their own values.
        raise TuningError("{name}: {error}", name=name, error=describe_exception(error)) from error
    last_index = len(tuning.points) - 1
    for key in ("recommended", "chosen"):
        if not 0 <= getattr(tuning, key) <= last_index:
            raise TuningError(
                "{name}: {key} = {value}: the file has points 0 to {last}",
                name=name,
                key=key,
                value=getattr(tuning, key),
                last=last_index,
            )
    return tuning


def _drop_none(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _drop_none(item) for key, item in value.items() if item is not None}
    if isinstance(value, list | tuple):
        return [_drop_none(item) for item in value]
    return str(value) if isinstance(value, SecondObjective) else value
