"""What is written over the picture: what it does not show, and where it is not to scale."""

from collections.abc import Collection, Iterable, Mapping

from rotemina.app.scene.scene import Command

_STEP_S = 0.5  # in which an age is told, so that not every frame tells another one


class Old:
    """Tells an age in steps, and only once it is old.

    Parameters
    ----------
    from_s : float
        Age, s, from which it is.
    """

    def __init__(self, from_s: float) -> None:
        self._from_s = from_s

    def told(self, age_s: float | None) -> float | None:
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
) -> Command:
    """Return the command that writes it, with the legend of the ghosts that are ``shown``."""
    warnings = [f"{ghost}: position unknown, not drawn" for ghost in sorted(unknown)]
    if age_s is not None:
        warnings.append(f"old: the last reading came in {age_s:.1f} s ago")
    if factor != 1.0:
        warnings.append(
            f"thx, thy, zn drawn {factor:g} × too large from mid-range; "
            "the tip is not where it is drawn"
        )
    return {
        "type": "note",
        "shown": sorted(shown),
        "colours": dict(colours),
        "warnings": warnings,
        "old": age_s is not None,
    }
