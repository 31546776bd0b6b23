"""Axis ranges that users have narrowed; they are stored by the fingerprint of the robot file."""

import json

from rotemina.app.motion.limits import Ranges
from rotemina.app.motion.model import compute_fingerprint
from rotemina.app.settings import UserSettings
from rotemina.sim.errors import InputError, describe_exception
from rotemina.sim.robot import Robot

_FINGERPRINT_DIGITS = 16


def load_ranges(settings: UserSettings, robot: Robot) -> dict[str, tuple[float, float]]:
    """Return the ranges, m or rad, that were stored for exactly this robot file.

    Raises
    ------
    InputError
        If the stored text cannot be parsed.
    """
    key = _make_key(robot)
    text = settings.get(key, "")
    if not text:
        return {}
    try:
        return {str(axis): (float(low), float(high)) for axis, (low, high) in _parse_items(text)}
    except (ValueError, TypeError, AttributeError) as error:
        raise InputError(
            "preference {key} = {text}: {error}",
            key=key,
            text=repr(text),
            error=describe_exception(error),
        ) from error


def store_ranges(settings: UserSettings, robot: Robot, ranges: Ranges) -> None:
    """Store the ranges in use for the next start."""
    settings.set(_make_key(robot), json.dumps({axis: list(ends) for axis, ends in ranges.items()}))


def _parse_items(text: str) -> list[tuple[str, list[float]]]:
    return list(json.loads(text).items())


def _make_key(robot: Robot) -> str:
    return f"ranges.{compute_fingerprint(robot)[:_FINGERPRINT_DIGITS]}"
