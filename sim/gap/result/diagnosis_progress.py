"""How far a diagnosis has come."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from rotemina.sim.errors import describe_exception
from rotemina.sim.gap.result.diagnosis import FailedStep
from rotemina.sim.gap.result.ranking import Grade, Ranking, Standings
from rotemina.sim.robot import AxisEffect

_STEPS = {"screening": 0.0, "fitting": 0.3, "deciding": 0.9}


@dataclass(frozen=True, slots=True)
class Progress:
    """A step of a diagnosis.

    Attributes
    ----------
    stage : str
        What is done now: "where", "screening", "fitting", "selecting", "deciding".
    axis : str, optional
    candidate : str, optional
        The effect that is tried.
    share : float
        Of the whole that is done, 0 to 1, never falling.
    ranking : Ranking, optional
        How the candidates of the axis stand so far.
    """

    stage: str
    axis: str | None
    candidate: str | None
    share: float
    ranking: Ranking | None = None


Listener = Callable[[Progress], None]
"""Is told of every step; what it raises ends the diagnosis."""


def unheard(_progress: Progress) -> None:
    """Listen to nothing."""


class Account:
    """Reports the progress of the examination of an axis to a listener.

    The examination is ``share`` of the whole diagnosis, starting at ``begin``.
    """

    def __init__(
        self, axis: str, listener: Listener = unheard, begin: float = 0.0, share: float = 1.0
    ) -> None:
        self._axis, self._listener = axis, listener
        self._begin, self._share = begin, share
        self._standings = Standings(axis)
        self._latest = Progress("screening", axis, None, begin)
        self._failed: set[FailedStep] = set()

    def heartbeat(self) -> None:
        """Tell the last step again, from any thread, so that a listener can end the work."""
        self._listener(self._latest)

    def tell(self, stage: str, candidate: str | None) -> None:
        """Tell of a step."""
        done = max(self._latest.share, self._begin + self._share * _STEPS[stage])
        self._latest = Progress(stage, self._axis, candidate, done, self._latest.ranking)
        self.heartbeat()

    @property
    def failed(self) -> tuple[FailedStep, ...]:
        """The candidates whose computation failed, in an order that depends only on the input."""
        return tuple(sorted(self._failed))

    def note_failure(self, effects: Sequence[AxisEffect], error: Exception) -> None:
        """Note that the computation with these effects failed; call it from any thread."""
        names = tuple(effect.id for effect in effects)
        self._failed.add(FailedStep(self._axis, names, describe_exception(error)))

    def begin(self, whole: float) -> None:
        """Let candidates be tried, from now on, on a gap of this mean square over the floor."""
        self._standings.begin(whole)

    def tried(self, causes: Sequence[AxisEffect], left: float, grade: Grade) -> None:
        """Tell what causes leave, mean square over the floor."""
        self._standings.add(causes, left, grade)
        self._latest = replace(self._latest, ranking=self._standings.ranking())
        self.heartbeat()
