"""Texts about the scale and the perceived dynamics of a control law."""

from math import degrees

from rotemina.app.motion.teleoperation import PerceivedDynamics
from rotemina.plugins.teleoperation import tr
from rotemina.sim.messages import format_rounded
from rotemina.sim.units import format_exact

_M_PER_MM = 1e-3


def format_tilt(tilt_rad: float) -> str:
    """Return an angle such as ``"206 arcsec (1 mrad)"``."""
    arcsec, mrad = 3600.0 * degrees(tilt_rad), 1e3 * tilt_rad
    return f"{format_rounded(arcsec, 3)} arcsec ({format_rounded(mrad, 3)} mrad)"


def format_position_scale(scale: float, unit: str, moving_part: str, stick_travel_m: float) -> str:
    """Return a text such as ``"1 mm of stick = 2 µm of tip"``.

    ``scale`` is the motion at full deflection in ``unit`` (m or rad). ``stick_travel_m`` is the
    travel of the tip of the stick from the centre to full deflection.
    """
    distance = format_exact(scale * _M_PER_MM / stick_travel_m, unit)
    return tr("1 mm of stick = {way} of {what}").format(way=distance, what=moving_part)


def format_full_deflection(scale: float, unit: str) -> str:
    """Return a text such as ``"full deflection = 2 µm"``, for a distance (m, rad) or a speed."""
    return tr("full deflection = {way}").format(way=format_exact(scale, unit))


def format_rate_scale(scale: float, unit: str) -> str:
    """Return e.g. ``"full deflection = 0.5 mm/s"`` for a speed in ``unit`` per second."""
    return format_full_deflection(scale, f"{unit}/s")


def describe_dynamics(dynamics: PerceivedDynamics, unit: str, factor: float = 1.0) -> str:
    """Return travel or speed at full deflection, and the time constant.

    ``factor`` scales travel and speed.
    """
    time_constant_text = f"{format_rounded(dynamics.time_constant_s, 3)} s"
    if dynamics.terminal_speed is not None:
        speed_template = tr("full deflection: {speed}, time constant {after}")
        speed = format_exact(factor * dynamics.terminal_speed, f"{unit}/s")
        return speed_template.format(speed=speed, after=time_constant_text)
    travel_template = tr(
        "full deflection: {travel}, {hz:.3g} Hz, damping ratio {damping:.3g}, time constant {after}"
    )
    return travel_template.format(
        travel=format_exact(factor * (dynamics.travel or 0.0), unit),
        hz=dynamics.natural_frequency_hz,
        damping=dynamics.damping_ratio,
        after=time_constant_text,
    )
