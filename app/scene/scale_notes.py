"""Notes over the picture about ghosts that are not drawn, outdated or not to scale."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from rotemina.app.scene.scene import SceneCommand

# The age is rounded down to steps of this size, so that the note does not change with every frame.
_AGE_STEP_S = 0.5


@dataclass(frozen=True, slots=True)
class SceneTexts:
    """The texts of the notes in the language of the program, with fields in braces.

    Attributes
    ----------
    model, real : str
        Names of the ghosts.
    unknown, old, enlarged : str
        Notes about a ghost that is not drawn, about old readings, and about motion that is not to
        scale.
    silent, quiet : str
        Notes for a browser without a connection to the program, and for a browser that is connected
        but receives no data.
    """

    model: str = "model"
    real: str = "real"
    unknown: str = "{ghost}: position unknown, not drawn"
    old: str = "outdated: the last reading is {age_s:.1f} s old"
    enlarged: str = (
        "thx, thy, zn drawn {factor:g} × too large from mid-range; the tip is not where it is drawn"
    )
    silent: str = "The program does not answer: the drawing is out of date."
    quiet: str = "No data from the program: the drawing is out of date."


class ReadingAge:
    """Rounds the age of a reading if the reading is old.

    Parameters
    ----------
    max_age_s : float
        A reading older than this, s, counts as old.
    """

    def __init__(self, max_age_s: float) -> None:
        self._max_age_s = max_age_s

    def round_if_old(self, age_s: float | None) -> float | None:
        """Return the rounded age, s, or None if the reading is not old."""
        if age_s is None or age_s <= self._max_age_s:
            return None
        return age_s // _AGE_STEP_S * _AGE_STEP_S


def make_note(
    shown: Collection[str],
    unknown: Iterable[str],
    age_s: float | None,
    factor: float,
    colours: Mapping[str, str],
    words: SceneTexts,
) -> SceneCommand:
    """Return the command that writes the notes, and the legend of the ghosts in ``shown``.

    ``unknown`` contains the ghosts that are not drawn because their position is unknown. ``age_s``
    is None if the readings are not old. ``factor`` is the exaggeration of the nano stage.
    """
    warnings = [words.unknown.format(ghost=getattr(words, ghost)) for ghost in sorted(unknown)]
    if age_s is not None:
        warnings.append(words.old.format(age_s=age_s))
    if factor != 1.0:
        warnings.append(words.enlarged.format(factor=factor))
    return {
        "type": "note",
        "shown": sorted(shown),
        "colours": dict(colours),
        "words": {key: getattr(words, key) for key in ("model", "real", "silent", "quiet")},
        "warnings": warnings,
        "old": age_s is not None,
    }
