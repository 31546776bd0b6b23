"""One resonance fitted to a frequency response: frequency, damping, gain."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.identification.errors import ExcitationError, SettingError, TooShortError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

_LEAST_LINES = 4
_OVERDAMPED = 0.5**0.5  # damping ratio from which a mode shows no peak
_NARROWEST = 0.05  # half-width over the lines' spacing; below, a single line passes for a mode
_MOST_STEPS = 60
_CONVERGED = 1e-13


class Resonance(NamedTuple):
    """``H(ω) = gain e^(jφ) ω0² / (ω0² − ω² + 2jζω0ω) + rest`` within a band.

    ``phase_rad`` φ is what a delay or a lag has turned the mode by where it lies (about π: its sign
    is negative). ``gain`` ≥ 0 and the complex ``rest`` (what other modes add, constant over the
    band) in the unit of the response; each ``…_deviation`` is a standard deviation, from the
    residual or from the lines' own where those were given and say more; ``misfit`` = ‖H − model‖
    / ‖H‖, which is large where the band holds another mode.
    """

    frequency_hz: float
    damping_ratio: float
    gain: float
    phase_rad: float
    rest: complex
    frequency_deviation: float
    damping_deviation: float
    misfit: float


def fit_resonance(
    frequency_hz: FloatArray,
    response: ComplexArray,
    *,
    band_hz: tuple[float, float],
    deviation: FloatArray | None = None,
    held_at_hz: float | None = None,
) -> Resonance:
    """Fit a single mode to the lines of a band.

    A linear start (E. C. Levy, *IRE Trans. Autom. Control* 4 (1959) 37) is refined by
    Gauss–Newton on the weighted complex error (R. Pintelon, J. Schoukens, *System Identification:
    A Frequency Domain Approach*, 2nd ed., 2012, ch. 8).

    Parameters
    ----------
    frequency_hz, response : (k,) of one input and one output.
    band_hz : lowest and highest frequency used.
    deviation : (k,) standard deviation of each line; equal weights if left out.
    held_at_hz : rate of commands held between samples; the hold ``sinc(f/rate) e^(−jπf/rate)`` is
        then divided out (what folds back from above half the rate is not).

    Raises
    ------
    SettingError, TooShortError, ExcitationError
        If the band is empty or too narrow, or holds no resonance.
    """
    inside = (frequency_hz >= band_hz[0]) & (frequency_hz <= band_hz[1])
    if not 0.0 <= band_hz[0] < band_hz[1]:
        raise SettingError(
            message("engine", "resonance: band {band_hz} Hz; the lower end comes first").fill(
                band_hz=str(band_hz)
            )
        )
    if inside.sum() < _LEAST_LINES:
        raise TooShortError(
            message(
                "engine",
                "resonance: {count} lines from {low_hz} to {high_hz} Hz; at least {least_lines} "
                "are needed, widen the band or resolve it finer",
            ).fill(
                count=inside.sum(), low_hz=band_hz[0], high_hz=band_hz[1], least_lines=_LEAST_LINES
            )
        )
    line_hz, target = frequency_hz[inside], response[inside]
    if held_at_hz is not None:
        part = line_hz / held_at_hz
        target = target / (np.sinc(part) * np.exp(-1j * np.pi * part))
    weight = np.ones(len(line_hz))
    if deviation is not None:
        weight = 1.0 / np.maximum(deviation[inside], 1e-12 * float(np.abs(target).max()))
    return _fit(line_hz, target, weight, deviation is not None)


def _fit(line_hz: FloatArray, target: ComplexArray, weight: FloatArray, known: bool) -> Resonance:
    """Fit in units of the band's middle and of the largest response."""
    middle, size = float(line_hz.mean()), float(np.abs(target).max())
    if size == 0.0:
        raise ExcitationError(message("engine", "resonance: the response is zero over the band"))
    s, goal = line_hz / middle, target / size
    parameters = _start(s, goal)
    cost = np.inf
    for _ in range(_MOST_STEPS):
        model, jacobian = _model(s, parameters)
        error = _stacked(weight * (goal - model))
        now = float(error @ error)
        if now >= cost * (1.0 - _CONVERGED):
            break
        cost = now
        step, *_ = np.linalg.lstsq(_stacked(weight[:, None] * jacobian), error, rcond=None)
        change = np.asarray(step, dtype=np.float64)
        parameters = _limited(s, goal, weight, parameters, change)
    model, jacobian = _model(s, parameters)
    real = _stacked(weight[:, None] * jacobian)
    error = _stacked(weight * (goal - model))
    variance = float(error @ error) / max(len(error) - len(parameters), 1)
    if known:  # half of each line's variance on each of its parts; more where the fit is worse
        variance = max(variance, 1.0 / size**2 / 2.0)
    covariance = variance * np.linalg.pinv(real.T @ real)
    spread = np.sqrt(np.diag(covariance))
    root, damping = float(parameters[0]), float(parameters[1])
    gain = complex(parameters[2], parameters[3])
    seen = damping * root >= _NARROWEST * float(np.diff(s).max())
    if not (s[0] < root < s[-1] and seen and damping < _OVERDAMPED):
        raise ExcitationError(
            message(
                "engine",
                "resonance: the best fit lies at {frequency_hz} Hz with damping {damping}, no peak "
                "inside "
                "the band {low_hz} to {high_hz} Hz; choose a band around a peak",
            ).fill(
                frequency_hz=rounded(root * middle, 6),
                damping=rounded(damping, 3),
                low_hz=line_hz[0],
                high_hz=line_hz[-1],
            )
        )
    return Resonance(
        root * middle,
        damping,
        abs(gain) * size,
        float(np.angle(gain)),
        complex(parameters[4], parameters[5]) * size,
        float(spread[0]) * middle,
        float(spread[1]),
        float(np.linalg.norm(goal - model) / np.linalg.norm(goal)),
    )


def _start(s: FloatArray, goal: ComplexArray) -> FloatArray:
    """Return ω0, ζ, complex gain and rest of the linear fit ``H (a − s² + jbs) = c + r (…)``."""
    one, line = np.ones_like(goal), s.astype(np.complex128)
    # Last the rest times the denominator, its coefficients left free.
    columns = [-goal, -1j * s * goal, one, 1j * one, line, 1j * line, line**2, 1j * line**2]
    solution, *_ = np.linalg.lstsq(
        _stacked(np.column_stack(columns)), _stacked(-goal * s**2), rcond=None
    )
    root = float(np.sqrt(max(solution[0], float(s[0]) ** 2)))
    damping = abs(float(solution[1])) / (2.0 * root)
    peak = int(np.argmax(np.abs(goal)))
    if not s[0] < root < s[-1] or damping == 0.0:
        root, damping = float(s[peak]), 0.02
    shape = _shape(s, root, damping)
    parts = [shape, 1j * shape, one, 1j * one]
    linear, *_ = np.linalg.lstsq(_stacked(np.column_stack(parts)), _stacked(goal), rcond=None)
    return np.concatenate([[root, damping], linear])


def _shape(s: FloatArray, root: float, damping: float) -> ComplexArray:
    return np.asarray(root**2 / (root**2 - s**2 + 2j * damping * root * s), dtype=np.complex128)


def _model(s: FloatArray, parameters: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    """Return the model (k,) and its derivatives (k, 6)."""
    root, damping = parameters[:2]
    gain = parameters[2] + 1j * parameters[3]
    shape = _shape(s, root, damping)
    by_root = gain * (2.0 * shape / root - shape**2 / root**2 * (2.0 * root + 2j * damping * s))
    by_damping = -gain * shape**2 / root**2 * 2j * root * s
    one = np.ones_like(shape)
    model = gain * shape + parameters[4] + 1j * parameters[5]
    return model, np.column_stack([by_root, by_damping, shape, 1j * shape, one, 1j * one])


def _limited(
    s: FloatArray, goal: ComplexArray, weight: FloatArray, parameters: FloatArray, step: FloatArray
) -> FloatArray:
    """Halve a step until it lowers the error; return the old parameters if it never does."""

    def cost(at: FloatArray) -> float:
        return float(np.sum(np.abs(weight * (goal - _model(s, at)[0])) ** 2))

    before = cost(parameters)
    for _ in range(30):
        tried = parameters + step
        if tried[0] > 0.0 and tried[1] > 0.0 and cost(tried) < before:
            return tried
        step = 0.5 * step
    return parameters


def _stacked(values: ComplexArray) -> FloatArray:
    return np.concatenate([values.real, values.imag]).astype(np.float64)
