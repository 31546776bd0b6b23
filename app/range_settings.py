"""Narrowed axis ranges, stored between starts for one robot file by its fingerprint."""

import json

from rotemina.app.motion.model_in_use import fingerprint
from rotemina.app.motion.ranges import Ranges
from rotemina.app.settings import Settings
from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

_DIGITS = 16  # of the fingerprint


def kept_ranges(settings: Settings, robot: Robot) -> dict[str, tuple[float, float]]:
    """Return the ranges, m or rad, that were kept for this very robot file.

    Raises
    ------
    InputError
        If what was kept is no such thing.
    """
    key = _key(robot)
    text = settings.get(key, "")
    if not text:
        return {}
    try:
        return {str(axis): (float(low), float(high)) for axis, (low, high) in _items(text)}
    except (ValueError, TypeError, AttributeError) as error:
        raise InputError(
            message("engine", "preference {key} = {text}: {error}").fill(
                key=key, text=repr(text), error=reason_of(error)
            )
        ) from error


def keep_ranges(settings: Settings, robot: Robot, ranges: Ranges) -> None:
    """Keep the ranges that are in use now."""
    settings.set(_key(robot), json.dumps({axis: list(ends) for axis, ends in ranges.items()}))


def _items(text: str) -> list[tuple[str, list[float]]]:
    return list(json.loads(text).items())


def _key(robot: Robot) -> str:
    return f"ranges.{fingerprint(robot)[:_DIGITS]}"
