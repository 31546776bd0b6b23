"""Excitations made of sines: sine, chirp and random-phase odd multisine.

Sine and chirp begin and end at their lowest point, where the speed is 0.
"""

from dataclasses import dataclass
from math import floor, gcd, log
from typing import ClassVar, Literal

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.excitation.axis_draft import Draft, Signal
from rotemina.sim.excitation.multisine import odd_lines, quietest_start, reduced_crest
from rotemina.sim.excitation.quantity import Amount, ExcitationError, check_count, check_positive
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import rounded

WHOLE_PERIODS = marked("engine", "whole periods")
_ON_A_PERIOD = 1e-9  # periods: that many short of whole ones are whole


@dataclass(frozen=True, slots=True, kw_only=True)
class Sine:
    """``offset - amplitude·cos(2πft)``, in whole periods; ``duration_s`` is 3 periods if not given.

    The amplitude gives way to speed and acceleration. With ``periodic`` it begins half a row after
    its lowest point and ends half a row before it, and the record says so.
    """

    kind: ClassVar[str] = "sine"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    duration_s: float | None = None
    periodic: bool = False

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        asked = self.frequency_hz or draft.default_hz(self.amplitude)
        draft.check_frequency("frequency", asked)
        cycles = max(1, round(asked * (self.duration_s or 3.0 / asked)))
        rows = draft.rows(cycles / asked)
        frequency = cycles * draft.rate_hz / rows
        if self.frequency_hz is not None:
            draft.rounded("frequency", asked, frequency, "Hz", WHOLE_PERIODS)
        # Half a row off its lowest point at both ends, a periodic record is as near to rest there.
        index = np.arange(rows) + 0.5 if self.periodic else np.arange(rows + 1)
        shape = -np.cos(2.0 * np.pi * (index * cycles % rows) / rows)
        offset = draft.offset(self.offset)
        amplitude = draft.amplitude(self.amplitude, offset, draft.shape_amplitudes(shape))
        period = rows // gcd(rows, cycles) if self.periodic else None
        values = offset + amplitude * shape
        return draft.signal(values, period, frequency_hz=frequency, cycles=cycles)


@dataclass(frozen=True, slots=True, kw_only=True)
class Chirp:
    """A sine whose frequency goes from ``low_hz`` to ``high_hz``, evenly in Hz or in octaves.

    Both frequencies are scaled by the same small factor, so that it ends after whole periods, at
    rest. The amplitude is constant, and gives way to speed and acceleration.
    """

    kind: ClassVar[str] = "chirp"
    amplitude: Amount | None = None
    offset: Amount | None = None
    low_hz: float | None = None
    high_hz: float | None = None
    duration_s: float = 20.0
    spacing: Literal["log", "linear"] = "log"

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        check_positive(low_hz=self.low_hz, high_hz=self.high_hz, duration_s=self.duration_s)
        low, high = band(draft, self.low_hz, self.high_hz)
        rows = draft.rows(self.duration_s)
        share = np.arange(rows + 1) / rows
        phase = rows / draft.rate_hz * self._cycles(share, low, high)
        if phase[-1] < 1.0:
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: chirp from {low} Hz to {high} Hz has less than one period in "
                    "{duration_s} s; lengthen it",
                ).fill(
                    axis=draft.axis,
                    low=rounded(low, 6),
                    high=rounded(high, 6),
                    duration_s=rounded(self.duration_s, 6),
                )
            )
        factor = floor(phase[-1] + _ON_A_PERIOD) / phase[-1]
        if self.high_hz is not None:
            draft.rounded(
                marked("engine", "end of the band"), high, high * factor, "Hz", WHOLE_PERIODS
            )
        shape = -np.cos(2.0 * np.pi * factor * phase)
        offset = draft.offset(self.offset)
        amplitude = draft.amplitude(self.amplitude, offset, draft.shape_amplitudes(shape))
        return draft.signal(
            offset + amplitude * shape,
            low_hz=low * factor,
            high_hz=high * factor,
            spacing=self.spacing,
            duration_s=rows / draft.rate_hz,
        )

    def _cycles(self, share: FloatArray, low: float, high: float) -> FloatArray:
        """Return the integral of the frequency over the share (n,) of the duration, Hz."""
        if self.spacing == "linear" or low == high:
            return np.asarray(low * share + 0.5 * (high - low) * share**2)
        octaves = log(high / low)
        return np.asarray(low * np.expm1(octaves * share) / octaves)


@dataclass(frozen=True, slots=True, kw_only=True)
class Multisine:
    """A sum of cosines at odd multiples of ``1/period_s``, random phases, reduced crest factor.

    Lines lie between ``low_hz`` and ``high_hz``. Of each ``detection`` consecutive odd lines one,
    drawn by lot, is left out (0: none): what comes back there is odd distortion, on even lines
    even distortion. Amplitudes go as ``f**slope``. The peak amplitude gives way to the limits.
    The record begins near an extremum. ``duration_s`` is 4 periods if not given.

    Source: Schoukens, Vaes and Pintelon, IEEE Control Systems 36 (3), 2016.
    """

    kind: ClassVar[str] = "multisine"
    amplitude: Amount | None = None
    offset: Amount | None = None
    low_hz: float | None = None
    high_hz: float | None = None
    period_s: float = 1.0
    duration_s: float | None = None
    detection: int = 4
    slope: float = 0.0
    periodic: bool = True

    def draw(self, draft: Draft) -> Signal:
        """Return the positions of an axis."""
        self._check()
        low, high = band(draft, self.low_hz, self.high_hz)
        rows = draft.rows(self.period_s)
        base_hz = draft.rate_hz / rows
        lines = self._lines(draft, low / base_hz, high / base_hz)
        one = self._period(draft, lines, rows)
        periods = max(1, round((self.duration_s or 4.0 * self.period_s) * base_hz))
        draft.rows(periods * rows / draft.rate_hz)
        offset = draft.offset(self.offset)
        shape = np.tile(one, periods)
        if not self.periodic:
            shape = np.append(shape, one[0])
        amplitude = draft.amplitude(self.amplitude, offset, draft.shape_amplitudes(shape))
        return draft.signal(
            offset + amplitude * shape,
            rows if self.periodic else None,
            period_s=rows / draft.rate_hz,
            periods=periods,
            lines=" ".join(str(line) for line in lines),
            slope=self.slope,
        )

    def _check(self) -> None:
        check_positive(
            low_hz=self.low_hz,
            high_hz=self.high_hz,
            period_s=self.period_s,
            duration_s=self.duration_s,
        )
        check_count(0, 1000, detection=self.detection)
        if self.detection == 1:
            raise ExcitationError(
                message("engine", "detection = 1: would leave out every line; use 0, or 2 or more")
            )
        if not abs(self.slope) <= 4.0:
            raise ExcitationError(
                message("engine", "slope = {slope}: must lie between -4 and 4").fill(
                    slope=rounded(self.slope, 6)
                )
            )

    def _lines(self, draft: Draft, low: float, high: float) -> IntArray:
        lines = odd_lines(low, high, self.detection, draft.rng)
        if len(lines) == 0:
            raise ExcitationError(
                message(
                    "engine",
                    "axis {axis}: no odd multiple of 1/period_s = {period_s} Hz lies in the band; "
                    "widen it or lengthen the period",
                ).fill(axis=draft.axis, period_s=rounded(1 / self.period_s, 6))
            )
        return lines

    def _period(self, draft: Draft, lines: IntArray, rows: int) -> FloatArray:
        """Return one period (rows,) with a peak of 1."""
        spectrum = np.zeros(rows // 2 + 1, dtype=np.complex128)
        size = (lines / lines[0]) ** self.slope
        spectrum[lines] = size * np.exp(1j * reduced_crest(lines, size, draft.rng))
        one = np.fft.irfft(spectrum, n=rows)
        return quietest_start(np.asarray(one / np.abs(one).max()))


def band(draft: Draft, low: float | None, high: float | None) -> tuple[float, float]:
    """Return the band of an excitation, Hz: by default from 1 Hz to where the axis can follow.

    Raises
    ------
    ExcitationError
        If it ends below its beginning, or beyond half the rate.
    """
    if high is None:
        high = draft.useful_hz() if low is None else max(draft.useful_hz(), low)
    low = min(1.0, high / 10.0) if low is None else low
    if low > high:
        raise ExcitationError(
            message(
                "engine", "axis {axis}: band from {low} Hz to {high} Hz ends below its beginning"
            ).fill(axis=draft.axis, low=rounded(low, 6), high=rounded(high, 6))
        )
    draft.check_frequency(marked("engine", "end of the band"), high)
    return low, high
