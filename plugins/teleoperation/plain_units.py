"""Scales and perceived dynamics as text beside a law."""

from math import degrees

from rotemina.app.motion.teleoperation.virtual_impedance import FeltDynamics
from rotemina.plugins.teleoperation import tr
from rotemina.sim.quantities import exact, rounded

_MM = 1e-3


def tilt_text(tilt_rad: float) -> str:
    """Return a change of orientation: ``"206 arcsec (1 mrad)"``."""
    return f"{rounded(3600.0 * degrees(tilt_rad), 3)} arcsec ({rounded(1e3 * tilt_rad, 3)} mrad)"


def position_text(scale: float, unit: str, what: str, stick_travel_m: float) -> str:
    """Return ``"1 mm of stick = 2 µm of tip"``.

    ``scale`` is what full deflection moves, in ``unit`` (m or rad); ``stick_travel_m`` is the way
    of the stick's tip from the middle to full deflection.
    """
    way = exact(scale * _MM / stick_travel_m, unit)
    return tr("1 mm of stick = {way} of {what}").format(way=way, what=what)


def way_text(scale: float, unit: str) -> str:
    """Return ``"full stick = 2 µm"``, for a way (m or rad) or a speed at full deflection."""
    return tr("full deflection = {way}").format(way=exact(scale, unit))


def rate_text(scale: float, unit: str) -> str:
    """Return ``"full stick = 0.5 mm/s"``, for a speed at full deflection."""
    return way_text(scale, f"{unit}/s")


def felt_text(felt: FeltDynamics, unit: str, factor: float = 1.0) -> str:
    """Return where full deflection leads, and how soon; ``factor`` is the law's scale."""
    after_s = f"{rounded(felt.time_constant_s, 3)} s"
    if felt.terminal_speed is not None:
        glide = tr("full deflection: {speed}, time constant {after}")
        speed = exact(factor * felt.terminal_speed, f"{unit}/s")
        return glide.format(speed=speed, after=after_s)
    swing = tr(
        "full deflection: {travel}, {hz:.3g} Hz, damping ratio {damping:.3g}, time constant {after}"
    )
    return swing.format(
        travel=exact(factor * (felt.travel or 0.0), unit),
        hz=felt.natural_frequency_hz,
        damping=felt.damping_ratio,
        after=after_s,
    )
