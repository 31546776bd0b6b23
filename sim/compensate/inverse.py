"""An inverse in operation: the command for a desired position, sample by sample.

    inverse = Inverse(model, sample_s=1e-3)
    command = inverse.step(desired)      # one sample; never waits, about a microsecond
    commands = inverse.run(desired)      # (n,) samples, the same numbers

The command is a position in SI (what a record calls ``cmd``); a piezo's amplifier is given it over
the axis' gain. What lies beyond what the inverse saw is clamped, and said.
"""

from enum import IntFlag
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.compensate import kernel
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.kernel import Numbers
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact

_SLACK = 1e-9  # share of the span by which a position may lie outside unnoticed
_REST = 1e-3  # share of the span by which a command at rest may be missed at the ends
_HALVINGS = 50


class Exceedance(IntFlag):
    """In what a sample went beyond what an inverse saw or the machine can do; 0: in nothing.

    LOW, HIGH: the desired position, which was clamped. FAST: its speed, which was not. COMMAND: the
    machine's range, at which the command was clamped.
    """

    LOW = kernel.BELOW
    HIGH = kernel.ABOVE
    FAST = kernel.FAST
    COMMAND = kernel.COMMAND


class Inverse:
    """An inverse model in use at one sampling rate.

    It begins at rest at the first desired position, long after a monotone rise to it from the low
    end of the range, and begins so again after :meth:`reset`.

    Parameters
    ----------
    model : InverseModel
    sample_s : time from sample to sample, s.
    preview : bool
        Whether what is asked is what is desired ``model.lag_s`` ahead; the stage that makes up for
        the lag by extrapolation is then left out.

    Attributes
    ----------
    beyond : Exceedance
        In what the last sample, or the last run, went beyond.

    Raises
    ------
    CompensationError
        If ``sample_s`` is not a finite time above 0.
    """

    def __init__(self, model: InverseModel, sample_s: float, *, preview: bool = False) -> None:
        if not (np.isfinite(sample_s) and sample_s > 0.0):
            raise CompensationError(
                message(
                    "engine",
                    "inverse of axis {axis}: sample_s = {sample_s} s: must be finite, above 0",
                ).fill(axis=model.axis, sample_s=sample_s)
            )
        self.model = model
        self.sample_s = sample_s
        self.beyond = Exceedance(0)
        self._numbers = numbers_of(model, sample_s, preview=preview)
        self._state = np.zeros(kernel.FIXED + len(model.creep_times_s) + len(model.radii))

    @property
    def state(self) -> FloatArray:
        """A copy of the memory; setting it continues from there."""
        return self._state.copy()

    @state.setter
    def state(self, state: FloatArray) -> None:
        if np.shape(state) != self._state.shape or not np.isfinite(state).all():
            raise CompensationError(
                message(
                    "engine",
                    "inverse of axis {axis}: a state of shape {shape} with finite numbers "
                    "must have shape {state_shape}; use a state of this inverse",
                ).fill(
                    axis=self.model.axis,
                    shape=str(np.shape(state)),
                    state_shape=str(self._state.shape),
                )
            )
        self._state[:] = state

    def reset(self) -> Self:
        """Forget everything; the next sample begins at rest. Return the inverse itself."""
        self._state[:] = 0.0
        self.beyond = Exceedance(0)
        return self

    def step(self, desired: float) -> float:
        """Return the command for the next sample's desired position, both m or rad.

        A desired position that is not finite is a fault of the caller and gives NaN; nothing is
        remembered of it.
        """
        if not np.isfinite(desired):
            return float("nan")
        command, said = kernel.advance(self._numbers, self._state, desired)
        self.beyond = Exceedance(said)
        return float(command)

    def run(self, desired: FloatArray) -> FloatArray:
        """Return the commands (n,) for the next n desired positions (n,).

        Raises
        ------
        CompensationError
            If one is not finite.
        """
        return self.run_and_tell(desired)[0]

    def run_and_tell(self, desired: FloatArray) -> tuple[FloatArray, IntArray]:
        """Return the commands (n,), and in what each (n,) of them goes beyond."""
        desired = np.ascontiguousarray(desired, dtype=np.float64)
        if desired.ndim != 1 or not np.isfinite(desired).all():
            raise CompensationError(
                message(
                    "engine",
                    "inverse of axis {axis}: desired positions of shape {shape} must be one column "
                    "of finite numbers",
                ).fill(axis=self.model.axis, shape=str(desired.shape))
            )
        command = np.empty_like(desired)
        said = kernel.advance_all(self._numbers, self._state, desired, command)
        self.beyond = Exceedance(int(np.bitwise_or.reduce(said)) if len(said) else 0)
        return command, said

    def check(self, desired: FloatArray) -> None:
        """Refuse desired positions (n,) of which one lies beyond what the inverse saw.

        Raises
        ------
        CompensationError
            With the axis, the sample, the value and the bound.
        """
        low, high = self.model.desired_range
        slack = _SLACK * self.model.span
        outside = ~((desired >= low - slack) & (desired <= high + slack))
        if outside.any():
            at = int(np.argmax(outside))
            raise CompensationError(
                message(
                    "engine",
                    "inverse of axis {axis}: desired position {desired} at sample {at} lies "
                    "outside {low} to {high}, which the inverse was trained on; stay inside, or "
                    "train it on a wider record",
                ).fill(
                    axis=self.model.axis,
                    desired=exact(desired[at], self.model.unit),
                    at=at,
                    low=exact(low, self.model.unit, size=high),
                    high=exact(high, self.model.unit),
                )
            )


def resting_at(model: InverseModel, sample_s: float, command: float) -> tuple[Inverse, float]:
    """Return an inverse at rest that asks for ``command``, and the position desired there.

    Raises
    ------
    CompensationError
        If it asks for that nowhere in what it saw.
    """
    inverse = Inverse(model, sample_s)

    def off(desired: float) -> float:
        return inverse.reset().step(desired) - command

    (low, high), slack = model.desired_range, _REST * model.span
    ends = off(low), off(high)
    if not (ends[0] <= slack and ends[1] >= -slack):
        raise CompensationError(
            message(
                "engine",
                "inverse of axis {axis}: the command is {command}, but the inverse covers "
                "{low} to {high}: move the axis there first, or train with a wider record",
            ).fill(
                axis=model.axis,
                command=exact(command, model.unit, size=ends[1] + command),
                low=exact(ends[0] + command, model.unit, size=ends[1] + command),
                high=exact(ends[1] + command, model.unit),
            )
        )
    for _ in range(_HALVINGS):  # grows with the position; to the last bit of a share
        middle = 0.5 * (low + high)
        low, high = (middle, high) if off(middle) < 0.0 else (low, middle)
    desired = 0.5 * (low + high)
    inverse.reset().step(desired)
    return inverse, desired


def numbers_of(model: InverseModel, sample_s: float, *, preview: bool = False) -> Numbers:
    """Return what the kernel needs of a model at one sampling rate."""
    lag = 0.0 if preview else model.lag_at(sample_s)
    # Differences to the back, of second order: 3/2, −2, 1/2 of ẏ; 1, −2, 1 of ÿ.
    slope, bow = lag / (2.0 * sample_s), (0.5 * lag**2 + model.mode_s2) / sample_s**2
    premises = model.premises
    taps = (1.0 + 3.0 * slope + bow, -4.0 * slope - 2.0 * bow, slope + bow)
    shares = (model.origin, model.command_origin, model.span)
    ranges = (*model.desired_range, *model.command_range)
    moved = -np.expm1(-sample_s / model.creep_times_s)
    return Numbers(
        fixed=np.array([*shares, *ranges, model.speed * sample_s, *taps]),
        creep=np.stack([moved, model.creep_weights]),
        bend=np.stack([np.concatenate([[model.bend_offset], model.bend_at]), model.bend]),
        plays=np.stack([model.radii, model.initial]),
        premise=np.array(premises.plays, dtype=np.int64),
        memberships=np.stack([premises.centres, premises.widths]),
        consequents=np.array(model.consequents),
    )
