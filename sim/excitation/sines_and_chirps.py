"""Excitations made of sines: sine, chirp and random-phase odd multisine.

Sine and chirp begin and end at their lowest point, where the speed is 0.
"""

from dataclasses import dataclass
from math import floor, gcd, log
from typing import ClassVar, Literal

import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation.axis_draft import AxisDraft, AxisSignal
from rotemina.sim.excitation.multisine import (
    choose_odd_lines,
    reduce_crest,
    rotate_to_quietest_start,
)
from rotemina.sim.excitation.quantity import Amount, check_count, check_positive
from rotemina.sim.messages import format_rounded, marked

WHOLE_PERIODS = marked("engine", "whole periods")
# A duration may be shorter than whole periods by this fraction of a period.
_PERIOD_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class SineExcitation:
    """A sine in whole periods: ``offset - amplitude·cos(2πft)``.

    ``duration_s`` is 3 periods by default. The amplitude is reduced to respect the limits of speed
    and acceleration. A ``periodic`` signal begins half a row after its lowest point and ends half a
    row before it; the record is then marked as periodic.
    """

    kind: ClassVar[str] = "sine"
    amplitude: Amount | None = None
    offset: Amount | None = None
    frequency_hz: float | None = None
    duration_s: float | None = None
    periodic: bool = False

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(frequency_hz=self.frequency_hz, duration_s=self.duration_s)
        requested_hz = self.frequency_hz or draft.compute_default_hz(self.amplitude)
        draft.check_frequency("frequency", requested_hz)
        cycles = max(1, round(requested_hz * (self.duration_s or 3.0 / requested_hz)))
        rows = draft.count_rows(cycles / requested_hz)
        frequency = cycles * draft.rate_hz / rows
        if self.frequency_hz is not None:
            draft.note_rounding("frequency", requested_hz, frequency, "Hz", WHOLE_PERIODS)
        # A periodic record begins and ends half a row from its lowest point, so that both ends are
        # equally close to rest.
        index = np.arange(rows) + 0.5 if self.periodic else np.arange(rows + 1)
        shape = -np.cos(2.0 * np.pi * (index * cycles % rows) / rows)
        offset = draft.choose_offset(self.offset)
        amplitude = draft.choose_amplitude(
            self.amplitude, offset, draft.compute_max_amplitudes(shape)
        )
        period = rows // gcd(rows, cycles) if self.periodic else None
        values = offset + amplitude * shape
        return draft.make_signal(values, period, frequency_hz=frequency, cycles=cycles)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChirpExcitation:
    """A sine whose frequency goes from ``low_hz`` to ``high_hz``, evenly in Hz or in octaves.

    Both frequencies are scaled by the same small factor, so that the chirp ends at rest after whole
    periods. The amplitude is constant. It is reduced to respect the limits of speed and
    acceleration.
    """

    kind: ClassVar[str] = "chirp"
    amplitude: Amount | None = None
    offset: Amount | None = None
    low_hz: float | None = None
    high_hz: float | None = None
    duration_s: float = 20.0
    spacing: Literal["log", "linear"] = "log"

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        check_positive(low_hz=self.low_hz, high_hz=self.high_hz, duration_s=self.duration_s)
        low, high = choose_band(draft, self.low_hz, self.high_hz)
        rows = draft.count_rows(self.duration_s)
        progress = np.arange(rows + 1) / rows
        phase = rows / draft.rate_hz * self._integrate_frequency(progress, low, high)
        if phase[-1] < 1.0:
            raise ExcitationRequestError(
                "axis {axis}: chirp from {low} Hz to {high} Hz has less than one period in "
                "{duration_s} s; lengthen it",
                axis=draft.axis,
                low=format_rounded(low, 6),
                high=format_rounded(high, 6),
                duration_s=format_rounded(self.duration_s, 6),
            )
        factor = floor(phase[-1] + _PERIOD_TOLERANCE) / phase[-1]
        if self.high_hz is not None:
            draft.note_rounding(
                marked("engine", "end of the band"), high, high * factor, "Hz", WHOLE_PERIODS
            )
        shape = -np.cos(2.0 * np.pi * factor * phase)
        offset = draft.choose_offset(self.offset)
        amplitude = draft.choose_amplitude(
            self.amplitude, offset, draft.compute_max_amplitudes(shape)
        )
        return draft.make_signal(
            offset + amplitude * shape,
            low_hz=low * factor,
            high_hz=high * factor,
            spacing=self.spacing,
            duration_s=rows / draft.rate_hz,
        )

    def _integrate_frequency(self, progress: FloatArray, low: float, high: float) -> FloatArray:
        """Return the integral (n,) of the frequency over ``progress`` (n,), from 0 to 1, in Hz."""
        if self.spacing == "linear" or low == high:
            return np.asarray(low * progress + 0.5 * (high - low) * progress**2)
        log_ratio = log(high / low)
        return np.asarray(low * np.expm1(log_ratio * progress) / log_ratio)


@dataclass(frozen=True, slots=True, kw_only=True)
class MultisineExcitation:
    """A sum of cosines at odd multiples of ``1/period_s``, with a low crest factor.

    The phases are random. The lines lie between ``low_hz`` and ``high_hz``. One random line is
    omitted from each ``detection`` consecutive odd lines (0: none). A response at an omitted odd
    line reveals odd distortion, and a response at an even line reveals even distortion. The
    amplitudes are proportional to ``f**slope``. The peak amplitude is reduced to respect the
    limits. The record begins near an extremum. ``duration_s`` is 4 periods by default.

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

    def draw(self, draft: AxisDraft) -> AxisSignal:
        """Return the positions of an axis."""
        self._check()
        low, high = choose_band(draft, self.low_hz, self.high_hz)
        rows = draft.count_rows(self.period_s)
        base_hz = draft.rate_hz / rows
        lines = self._choose_lines(draft, low / base_hz, high / base_hz)
        period = self._make_period(draft, lines, rows)
        periods = max(1, round((self.duration_s or 4.0 * self.period_s) * base_hz))
        draft.count_rows(periods * rows / draft.rate_hz)
        offset = draft.choose_offset(self.offset)
        shape = np.tile(period, periods)
        if not self.periodic:
            shape = np.append(shape, period[0])
        amplitude = draft.choose_amplitude(
            self.amplitude, offset, draft.compute_max_amplitudes(shape)
        )
        return draft.make_signal(
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
            raise ExcitationRequestError(
                "detection = 1: would leave out every line; use 0, or 2 or more"
            )
        if not abs(self.slope) <= 4.0:
            raise ExcitationRequestError(
                "slope = {slope}: must lie between -4 and 4", slope=format_rounded(self.slope, 6)
            )

    def _choose_lines(self, draft: AxisDraft, low: float, high: float) -> IntArray:
        lines = choose_odd_lines(low, high, self.detection, draft.rng)
        if len(lines) == 0:
            raise ExcitationRequestError(
                "axis {axis}: no odd multiple of 1/period_s = {period_s} Hz lies in the band; "
                "widen it or lengthen the period",
                axis=draft.axis,
                period_s=format_rounded(1 / self.period_s, 6),
            )
        return lines

    def _make_period(self, draft: AxisDraft, lines: IntArray, rows: int) -> FloatArray:
        """Return one period (rows,) with a peak of 1."""
        spectrum = np.zeros(rows // 2 + 1, dtype=np.complex128)
        amplitudes = (lines / lines[0]) ** self.slope
        spectrum[lines] = amplitudes * np.exp(1j * reduce_crest(lines, amplitudes, draft.rng))
        period = np.fft.irfft(spectrum, n=rows)
        return rotate_to_quietest_start(np.asarray(period / np.abs(period).max()))


def choose_band(draft: AxisDraft, low: float | None, high: float | None) -> tuple[float, float]:
    """Return the band of an excitation, Hz; by default from 1 Hz to the highest useful frequency.

    Raises
    ------
    ExcitationRequestError
        If ``high`` is below ``low``, or is not below half the rate.
    """
    if high is None:
        high = draft.compute_useful_hz() if low is None else max(draft.compute_useful_hz(), low)
    low = min(1.0, high / 10.0) if low is None else low
    if low > high:
        raise ExcitationRequestError(
            "axis {axis}: band from {low} Hz to {high} Hz ends below its beginning",
            axis=draft.axis,
            low=format_rounded(low, 6),
            high=format_rounded(high, 6),
        )
    draft.check_frequency(marked("engine", "end of the band"), high)
    return low, high
