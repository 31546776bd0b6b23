"""Even and odd non-linear distortion on the lines that a multisine leaves out."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray, IntArray
from rotemina.sim.identification.errors import ExcitationError
from rotemina.sim.identification.frequency_response import EXCITED_ABOVE
from rotemina.sim.identification.multisine import PeriodSpectra, period_spectra
from rotemina.sim.identification.signals import Signals, check_moving
from rotemina.sim.messages import message


@dataclass(frozen=True, slots=True, eq=False)
class DistortionLines:
    """Lines of one parity: what the output holds there, and the noise.

    Attributes
    ----------
    frequency_hz : (k,)
    amplitude : (k,) complex peak amplitude, less the linear answer to what the input holds there.
    noise_deviation : (k,) standard deviation of the complex amplitude by noise.
    """

    frequency_hz: FloatArray
    amplitude: ComplexArray
    noise_deviation: FloatArray

    @property
    def rms(self) -> float:
        """Root mean square over time of all these lines together, noise included."""
        return float(np.sqrt(np.sum(np.abs(self.amplitude) ** 2) / 2.0))

    @property
    def noise_rms(self) -> float:
        """Expected root mean square of noise on these lines."""
        return float(np.sqrt(np.sum(self.noise_deviation**2) / 2.0))

    @property
    def power_over_noise(self) -> float | None:
        """Power over that of noise; about 1 without distortion, None without lines or noise."""
        return (self.rms / self.noise_rms) ** 2 if self.noise_rms > 0 else None


@dataclass(frozen=True, slots=True, eq=False)
class Distortion:
    """The content of an output on excited lines, and on even and odd lines that are not excited.

    ``excited_hz`` (k,) and ``excited_amplitude`` (k,) complex; ``base_line`` is the line of which
    all excited ones are multiples; parities are those of the multiple. ``linear_rms`` is the output
    on the excited lines.
    """

    excited_hz: FloatArray
    excited_amplitude: ComplexArray
    base_line: int
    even: DistortionLines
    odd: DistortionLines

    @property
    def linear_rms(self) -> float:
        """Root mean square of the output on the excited lines."""
        return float(np.sqrt(np.sum(np.abs(self.excited_amplitude) ** 2) / 2.0))

    @property
    def even_percent(self) -> float:
        """Even distortion over the excited lines' output, rms, %."""
        return 100.0 * self.even.rms / self.linear_rms

    @property
    def odd_percent(self) -> float:
        """Odd distortion over the excited lines' output, rms, %."""
        return 100.0 * self.odd.rms / self.linear_rms


def distortion(
    signals: Signals,
    *,
    excited_above: float = EXCITED_ABOVE,
    skip_periods: int = 0,
    highest_hz: float | None = None,
) -> Distortion:
    """Split the output of a sparse multisine (or a sine) by the parity of its lines.

    A linear system answers only on the excited lines. If those are odd multiples of one line, a
    characteristic of even order shows on even lines, one of odd order on the odd lines left out.
    The input's own content there is subtracted through the response interpolated between its
    excited neighbours. Source: R. Pintelon, J. Schoukens, *System Identification: A Frequency
    Domain Approach*, 2nd ed., 2012, section 4.3.

    Parameters
    ----------
    signals : one input, one output, periodic; two periods or more.
    excited_above : of the largest input amplitude, from which a line counts as excited.
    skip_periods : at the beginning, for transients.
    highest_hz : of the lines looked at; all up to half the rate if left out.

    Raises
    ------
    ExcitationError
        If every line is excited, or the input does not move.
    """
    driven, _ = signals.single()
    check_moving(driven, signals.input_names[0])
    spectra = period_spectra(signals, skip_periods)
    size = np.abs(spectra.inputs[1:, 0])
    excited = 1 + np.flatnonzero(size >= excited_above * size.max())
    base = int(np.gcd.reduce(excited))
    spacing_hz = signals.rate_hz / spectra.period_samples
    highest = (spectra.period_samples - 1) // 2
    if highest_hz is not None:
        highest = min(highest, int(np.floor(highest_hz / spacing_hz + 1e-9)))
    multiples = np.setdiff1d(np.arange(base, highest + 1, base), excited)
    if len(multiples) == 0:
        raise ExcitationError(
            message(
                "engine",
                "distortion: all {count} lines are excited, none is left to show it; use a "
                "multisine of odd lines with some left out",
            ).fill(count=len(excited))
        )
    even, odd = (
        _lines(spectra, excited, multiples[multiples // base % 2 == parity], spacing_hz)
        for parity in (0, 1)
    )
    return Distortion(
        excited.astype(np.float64) * spacing_hz, spectra.outputs[excited, 0], base, even, odd
    )


def _lines(
    spectra: PeriodSpectra, excited: IntArray, lines: IntArray, spacing_hz: float
) -> DistortionLines:
    response = spectra.outputs[excited, 0] / spectra.inputs[excited, 0]
    near = np.interp(lines, excited, response.real) + 1j * np.interp(lines, excited, response.imag)
    return DistortionLines(
        lines.astype(np.float64) * spacing_hz,
        spectra.outputs[lines, 0] - near * spectra.inputs[lines, 0],
        np.sqrt(spectra.noise[lines, 0]),
    )
