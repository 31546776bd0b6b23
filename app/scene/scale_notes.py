"""Text over the picture: what is not drawn, and what is not to scale."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from rotemina.app.scene.scene import Command

_STEP_S = 0.5  # in which an age is told, so that not every frame tells another one


@dataclass(frozen=True, slots=True)
class Words:
    """The texts of the notes, in the viewer's language; fields in braces are filled.

    Attributes
    ----------
    model, real : str
        The ghosts.
    unknown, old, enlarged : str
        A ghost that is not drawn, readings that are old, motion that is not to scale.
    silent, quiet : str
        The viewer's own: no connection to the program, and one by which nothing comes.
    """

    model: str = "model"
    real: str = "real"
    unknown: str = "{ghost}: position unknown, not drawn"
    old: str = "old: the last reading came in {age_s:.1f} s ago"
    enlarged: str = (
        "thx, thy, zn drawn {factor:g} × too large from mid-range; the tip is not where it is drawn"
    )
    silent: str = "The program does not answer: the drawing is out of date."
    quiet: str = "No data from the program: the drawing is out of date."


class Old:
    """An age in steps, reported only when old.

    Parameters
    ----------
    from_s : float
        Age, s, from which it is.
    """

    def __init__(self, from_s: float) -> None:
        self._from_s = from_s

    def shown(self, age_s: float | None) -> float | None:
        """Return the age, s, in steps; None of what is new."""
        if age_s is None or age_s <= self._from_s:
            return None
        return age_s // _STEP_S * _STEP_S


def note(
    shown: Collection[str],
    unknown: Iterable[str],
    age_s: float | None,
    factor: float,
    colours: Mapping[str, str],
    words: Words,
) -> Command:
    """Return the command that writes it, with the legend of the ghosts that are ``shown``."""
    warnings = [words.unknown.format(ghost=getattr(words, ghost)) for ghost in sorted(unknown)]
    if age_s is not None:
        warnings.append(words.old.format(age_s=age_s))
    if factor != 1.0:
        warnings.append(words.enlarged.format(factor=factor))
    return {
        "type": "note",
        "shown": sorted(shown),
        "colours": dict(colours),
        "words": {one: getattr(words, one) for one in ("model", "real", "silent", "quiet")},
        "warnings": warnings,
        "old": age_s is not None,
    }
