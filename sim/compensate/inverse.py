"""An inverse in operation: the command for a desired position, sample by sample.

    inverse = Inverse(model, sample_s=1e-3)
    command = inverse.step(desired)      # one sample; never waits, about a microsecond
    commands = inverse.run(desired)      # (n,) samples, with identical results

The command is a position in SI units (called ``cmd`` in a record); a piezo's amplifier receives it
divided by the gain of the axis. Inputs beyond the training range are clamped and reported.
"""

from enum import IntFlag
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.kernel import KernelParameters
from rotemina.sim.errors import CompensationError
from rotemina.sim.units import format_exact

# A position may lie outside the range by this share of the span.
_SLACK_SHARE = 1e-9
# At rest, a command may exceed the commands at the two ends of the desired range by this share of
# the span.
_REST_TOLERANCE_SHARE = 1e-3
_BISECTION_STEPS = 50


class InverseExceedance(IntFlag):
    """Limits of the inverse or the machine that a sample exceeds; 0 for none.

    LOW, HIGH: training range of the desired position, which was clamped. FAST: highest speed of the
    training; the input is used unchanged. COMMAND: range of the machine, at which the command was
    clamped.
    """

    LOW = kernel.LOW
    HIGH = kernel.HIGH
    FAST = kernel.FAST
    COMMAND = kernel.COMMAND


class Inverse:
    """An inverse model in use at one sampling rate.

    It starts at rest at the first desired position, as if the axis had risen there monotonically
    from the low end of the range and all creep had decayed. It starts in the same way after
    :meth:`reset`.

    Parameters
    ----------
    model : InverseModel
    sample_s : interval of the samples, s.
    preview : bool
        Whether the inputs are the positions desired ``model.lag_s`` later. Then the stage that
        compensates the lag by extrapolation is left out.

    Attributes
    ----------
    exceedance : InverseExceedance
        Limits that the last sample or the last run exceeded.

    Raises
    ------
    CompensationError
        If ``sample_s`` is not a finite time above 0.
    """

    def __init__(self, model: InverseModel, sample_s: float, *, preview: bool = False) -> None:
        if not (np.isfinite(sample_s) and sample_s > 0.0):
            raise CompensationError(
                "inverse of axis {axis}: sample_s = {sample_s} s: must be finite, above 0",
                axis=model.axis,
                sample_s=sample_s,
            )
        self.model = model
        self.sample_s = sample_s
        self.exceedance = InverseExceedance(0)
        self._parameters = make_kernel_parameters(model, sample_s, preview=preview)
        self._state = np.zeros(
            kernel.FIXED_STATE_COUNT + len(model.creep_times_s) + len(model.radii)
        )

    @property
    def state(self) -> FloatArray:
        """A copy of the state. Assigning such a copy resumes from it."""
        return self._state.copy()

    @state.setter
    def state(self, state: FloatArray) -> None:
        if np.shape(state) != self._state.shape or not np.isfinite(state).all():
            raise CompensationError(
                "inverse of axis {axis}: a state of shape {shape} was given; it must have "
                "shape {state_shape} and only finite values; use a state of this inverse",
                axis=self.model.axis,
                shape=str(np.shape(state)),
                state_shape=str(self._state.shape),
            )
        self._state[:] = state

    def reset(self) -> Self:
        """Erase the state, so that the next sample starts at rest, and return this inverse."""
        self._state[:] = 0.0
        self.exceedance = InverseExceedance(0)
        return self

    def step(self, desired: float) -> float:
        """Return the command for the next sample's desired position, both m or rad.

        A desired position that is not finite is an error of the caller. It gives NaN and does not
        change the state.
        """
        if not np.isfinite(desired):
            return float("nan")
        command, flags = kernel.advance(self._parameters, self._state, desired)
        self.exceedance = InverseExceedance(flags)
        return float(command)

    def run(self, desired: FloatArray) -> FloatArray:
        """Return the commands (n,) for the next n desired positions (n,).

        Raises
        ------
        CompensationError
            If one of them is not finite.
        """
        return self.run_with_exceedances(desired)[0]

    def run_with_exceedances(self, desired: FloatArray) -> tuple[FloatArray, IntArray]:
        """Return the commands (n,), and the limits (n,) that each of them exceeds."""
        desired = np.ascontiguousarray(desired, dtype=np.float64)
        if desired.ndim != 1 or not np.isfinite(desired).all():
            raise CompensationError(
                "inverse of axis {axis}: desired positions of shape {shape} must be one column "
                "of finite numbers",
                axis=self.model.axis,
                shape=str(desired.shape),
            )
        command = np.empty_like(desired)
        flags = kernel.advance_all(self._parameters, self._state, desired, command)
        self.exceedance = InverseExceedance(int(np.bitwise_or.reduce(flags)) if len(flags) else 0)
        return command, flags

    def check_range(self, desired: FloatArray) -> None:
        """Raise an error if a desired position (n,) is outside the training range.

        Raises
        ------
        CompensationError
            If one is outside. The message names the axis, the sample, the value and the bound.
        """
        low, high = self.model.desired_range
        slack = _SLACK_SHARE * self.model.span
        outside = ~((desired >= low - slack) & (desired <= high + slack))
        if outside.any():
            row = int(np.argmax(outside))
            raise CompensationError(
                "inverse of axis {axis}: desired position {desired} at sample {at} lies "
                "outside {low} to {high}, which the inverse was trained on; stay inside, or "
                "train it on a wider record",
                axis=self.model.axis,
                desired=format_exact(desired[row], self.model.unit),
                at=row,
                low=format_exact(low, self.model.unit, size=high),
                high=format_exact(high, self.model.unit),
            )


def find_rest(model: InverseModel, sample_s: float, command: float) -> tuple[Inverse, float]:
    """Return an inverse at rest that yields ``command``, and the desired position there.

    Raises
    ------
    CompensationError
        If no position in the training range yields that command.
    """
    inverse = Inverse(model, sample_s)

    def compute_deviation(desired: float) -> float:
        return inverse.reset().step(desired) - command

    (low, high), slack = model.desired_range, _REST_TOLERANCE_SHARE * model.span
    end_deviations = compute_deviation(low), compute_deviation(high)
    if not (end_deviations[0] <= slack and end_deviations[1] >= -slack):
        raise CompensationError(
            "inverse of axis {axis}: the command is {command}, but the inverse covers "
            "{low} to {high}: move the axis there first, or train with a wider record",
            axis=model.axis,
            command=format_exact(command, model.unit, size=end_deviations[1] + command),
            low=format_exact(
                end_deviations[0] + command, model.unit, size=end_deviations[1] + command
            ),
            high=format_exact(end_deviations[1] + command, model.unit),
        )
    # The command increases with the position, so bisection finds the position to the accuracy of a
    # float.
    for _ in range(_BISECTION_STEPS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if compute_deviation(middle) < 0.0 else (low, middle)
    desired = 0.5 * (low + high)
    inverse.reset().step(desired)
    return inverse, desired


def make_kernel_parameters(
    model: InverseModel, sample_s: float, *, preview: bool = False
) -> KernelParameters:
    """Return the kernel parameters of a model at one sampling rate."""
    lag_s = 0.0 if preview else model.lag_at(sample_s)
    # Backward differences over three samples: 3/2, −2, 1/2 for ẏ and 1, −2, 1 for ÿ.
    slope, curvature = lag_s / (2.0 * sample_s), (0.5 * lag_s**2 + model.mode_s2) / sample_s**2
    premises = model.premises
    taps = (1.0 + 3.0 * slope + curvature, -4.0 * slope - 2.0 * curvature, slope + curvature)
    normalisation = (model.origin, model.command_origin, model.span)
    ranges = (*model.desired_range, *model.command_range)
    creep_step_fractions = -np.expm1(-sample_s / model.creep_times_s)
    return KernelParameters(
        fixed=np.array([*normalisation, *ranges, model.speed * sample_s, *taps]),
        creep=np.stack([creep_step_fractions, model.creep_weights]),
        bend=np.stack([np.concatenate([[model.bend_offset], model.bend_at]), model.bend]),
        plays=np.stack([model.radii, model.initial]),
        premise=np.array(premises.plays, dtype=np.int64),
        memberships=np.stack([premises.centres, premises.widths]),
        consequents=np.array(model.consequents),
    )
