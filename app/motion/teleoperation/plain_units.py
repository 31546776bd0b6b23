"""Scales and felt dynamics in words: what an operator reads beside a law."""

from math import degrees

from rotemina.app.motion.teleoperation.virtual_impedance import FeltDynamics
from rotemina.sim.trajectory.wording import readable

_MM = 1e-3


def position_text(scale: float, unit: str, what: str, stick_travel_m: float) -> str:
    """Return ``"1 mm of stick = 2 µm of tip"``.

    ``scale`` is what full deflection moves, in ``unit`` (m or rad); ``stick_travel_m`` is the way
    of the stick's tip from the middle to full deflection.
    """
    return f"1 mm of stick = {readable(scale * _MM / stick_travel_m, unit)} of {what}"


def rate_text(scale: float, unit: str) -> str:
    """Return ``"full stick = 0.5 mm/s"``, for a speed at full deflection."""
    return f"full stick = {readable(scale, f'{unit}/s')}"


def felt_text(felt: FeltDynamics, unit: str, factor: float = 1.0) -> str:
    """Return where full deflection leads, and how soon; ``factor`` is the law's scale."""
    after = f"time constant {felt.time_constant_s:.3g} s"
    if felt.terminal_speed is not None:
        return f"full stick ends at {readable(factor * felt.terminal_speed, f'{unit}/s')}, {after}"
    travel = readable(factor * (felt.travel or 0.0), unit)
    return (
        f"full stick ends {travel} away: {felt.natural_frequency_hz:.3g} Hz, damping ratio "
        f"{felt.damping_ratio:.3g}, {after}"
    )


def tilt_text(tilt_rad: float) -> str:
    """Return a change of orientation: ``"206 arcsec (1 mrad)"``."""
    return f"{3600.0 * degrees(tilt_rad):.3g} arcsec ({1e3 * tilt_rad:.3g} mrad)"
