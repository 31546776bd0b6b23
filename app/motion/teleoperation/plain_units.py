"""A change of orientation in units that an operator knows."""

from math import degrees

from rotemina.sim.quantities import rounded


def tilt_text(tilt_rad: float) -> str:
    """Return a change of orientation: ``"206 arcsec (1 mrad)"``."""
    return f"{rounded(3600.0 * degrees(tilt_rad), 3)} arcsec ({rounded(1e3 * tilt_rad, 3)} mrad)"
