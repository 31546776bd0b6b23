"""The result of a tuning, and its file: a small TOML that says how it came about."""

from collections.abc import Mapping
from dataclasses import asdict, replace
from importlib.metadata import version
from os import PathLike, fspath
from typing import Any, Literal

import numpy as np
import tomli_w
from pydantic import TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from rotemina.sim.errors import reason_of
from rotemina.sim.input_files import parse_toml, read_text
from rotemina.sim.messages import message
from rotemina.sim.robot.numbers import FORBID_UNKNOWN
from rotemina.sim.tuning.errors import TuningError
from rotemina.sim.tuning.objectives import SecondObjective
from rotemina.sim.tuning.pareto_front import Point, knee_of
from rotemina.sim.tuning.search import Generation, SearchSettings, objectives_of
from rotemina.sim.tuning.search_problem import TuningProblem
from rotemina.sim.whole_files import replaced

_MOST_BYTES = 4_000_000


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Provenance:
    """How a tuning came about.

    Attributes
    ----------
    program, robot : str
    effects : tuple of str
        Those that acted on the simulated axis.
    inverse : str
        Of the feed-forward; empty without.
    generations, done, population, seed : int
        How many were requested, and done.
    against : Against
    peak_sensitivity, overshoot, spread : float
        Constraints, and by how much gain and resonance were off.
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
    def whole(self) -> bool:
        """Whether the search was not stopped before its end."""
        return self.done == self.generations


@dataclass(frozen=True, slots=True, kw_only=True, config=FORBID_UNKNOWN)
class Tuning:
    """A front of gains for one axis.

    Attributes
    ----------
    axis : str
    rate_hz : float
    delay : int
    recommended, chosen : int
        Numbers of points, from 0.
    points : tuple of Point
        By rising tracking error.
    provenance : Provenance
    """

    format: Literal["rotemina-tuning 1"] = "rotemina-tuning 1"
    axis: str
    rate_hz: float
    delay: int
    recommended: int
    chosen: int
    provenance: Provenance
    points: tuple[Point, ...]

    @property
    def best(self) -> Point:
        """The chosen point."""
        return self.points[self.chosen]

    def choosing(self, number: int) -> "Tuning":
        """Return it with another point chosen.

        Raises
        ------
        TuningError
            If there is no such point.
        """
        if not 0 <= number < len(self.points):
            raise TuningError(
                message(
                    "engine", "point {number}: the front has points 0 to {count}; choose one"
                ).fill(number=number, count=len(self.points) - 1)
            )
        return replace(self, chosen=number)


def tuning_of(
    problem: TuningProblem, settings: SearchSettings, last: Generation, *, inverse: str = ""
) -> Tuning:
    """Return the result of a search that came as far as ``last``; the knee is recommended.

    Raises
    ------
    TuningError
        If no point keeps the constraints.
    """
    if not last.front:
        bounds = problem.constraints
        raise TuningError(
            message(
                "engine",
                "axis {axis}: after {done} generations no gains keep Ms ≤ {peak_sensitivity} "
                "and overshoot ≤ {overshoot} %; search longer, use a faster loop, or permit "
                "more",
            ).fill(
                axis=problem.axis,
                done=last.done,
                peak_sensitivity=bounds.peak_sensitivity,
                overshoot=100.0 * bounds.overshoot,
            )
        )
    objectives = np.array([objectives_of(one.figures, settings.against) for one in last.front])
    knee = knee_of(objectives)
    provenance = Provenance(
        program=f"rotemina {version('rotemina')}",
        robot=problem.robot.name,
        effects=tuple(str(one) for one in problem.loop.plant.effects),
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
    return Tuning(
        axis=problem.axis,
        rate_hz=problem.rate_hz,
        delay=problem.delay,
        recommended=knee,
        chosen=knee,
        provenance=provenance,
        points=last.front,
    )


def document_of(tuning: Tuning) -> dict[str, Any]:
    """Return a tuning as plain tables, those that say nothing left out."""
    found: dict[str, Any] = _without_none(asdict(tuning))
    return found


def save_tuning(tuning: Tuning, path: str | PathLike[str]) -> None:
    """Write a tuning as TOML, completely or not at all.

    Raises
    ------
    FileWriteError
        If nothing can be written there.
    """
    with replaced(path) as file:
        file.write(tomli_w.dumps(document_of(tuning)).encode("utf-8"))


def load_tuning(path: str | PathLike[str]) -> Tuning:
    """Read a tuning.

    Raises
    ------
    TuningError
        With file, key, value and bound.
    """
    name = fspath(path)
    table = parse_toml(read_text(path, TuningError, _MOST_BYTES), name, TuningError)
    try:
        found = TypeAdapter(Tuning).validate_python(table)
    except ValidationError as error:
        first = error.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        raise TuningError(
            message("engine", "{name}: {key} = {value}: {reason}").fill(
                name=name, key=key, value=repr(first["input"]), reason=first["msg"]
            )
        ) from error
    except ValueError as error:  # of the gains' own checks
        raise TuningError(
            message("engine", "{name}: {error}").fill(name=name, error=reason_of(error))
        ) from error
    last = len(found.points) - 1
    for key in ("recommended", "chosen"):
        if not 0 <= getattr(found, key) <= last:
            raise TuningError(
                message("engine", "{name}: {key} = {value}: the file has points 0 to {last}").fill(
                    name=name, key=key, value=getattr(found, key), last=last
                )
            )
    return found


def _without_none(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _without_none(own) for key, own in value.items() if own is not None}
    if isinstance(value, list | tuple):
        return [_without_none(own) for own in value]
    return str(value) if isinstance(value, SecondObjective) else value
