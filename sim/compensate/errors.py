"""Errors of the compensation."""

from rotemina.sim.errors import InputError


class CompensationError(InputError):
    """A record, a file or a request that no inverse can be made of, or that it cannot serve."""


class ConvergenceError(CompensationError):
    """A training that did not converge; the previous result is kept."""
