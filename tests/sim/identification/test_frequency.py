"""Frequency responses of systems whose exact response is known."""

import numpy as np
import pytest
from scipy.signal import cont2discrete, csd, freqz, welch

from rotemina.sim.errors import (
    IdentificationError,
    IdentificationSettingError,
    InsufficientExcitationError,
    TooShortError,
)
from rotemina.sim.identification import (
    ExperimentSignals,
    estimate_periodic_response,
    estimate_welch_response,
    fit_resonance,
    make_siso_signals,
    signals_from_record,
)
from rotemina.sim.identification.multisine import average_periods
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot_files import load_robot

PERIOD, RATE_HZ = 2048, 6400.0


def make_multisine(lines, seed=0, period=PERIOD):
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(lines))
    spectrum = np.zeros(period // 2 + 1, complex)
    spectrum[lines] = np.exp(1j * phases)
    return np.fft.irfft(spectrum, period) * period / 2 / np.sqrt(len(lines) / 2)


def test_a_multisine_gives_the_plant_s_exact_response():
    robot = load_robot("fsm")
    command = np.tile(1e-6 * make_multisine(np.arange(1, 960, 2)), 2)
    time_s = np.arange(len(command)) / RATE_HZ
    channels = {("m1", Tap.CMD): command}
    meta = {"history": "periodic", "period_samples": str(PERIOD)}
    commands = Record.from_signals(time_s, channels, {"m1": "m"}, meta)
    channels["m1", Tap.MEAS] = simulate_nominal_response(robot, commands).signal("m1", Tap.MEAS)
    record = Record.from_signals(time_s, channels, {"m1": "m"}, meta)
    signals = signals_from_record(record, [("m1", Tap.CMD)], [("m1", Tap.MEAS)])
    estimate = estimate_periodic_response(signals).total
    mass, damping, stiffness = robot.axes["m1"].inertia
    numerator, denominator, _ = cont2discrete(
        ([stiffness], [mass, damping, stiffness]), 1 / RATE_HZ, "zoh"
    )
    exact = freqz(numerator.ravel(), denominator, estimate.frequency_hz, fs=RATE_HZ)[1]
    assert len(estimate.frequency_hz) == 480
    np.testing.assert_allclose(estimate.response[:, 0, 0], exact, rtol=1e-7)
    assert compute_relative_error(estimate_periodic_response(signals), signals) < 1e-7
    resonance = fit_resonance(
        estimate.frequency_hz, estimate.response[:, 0, 0], band_hz=(850, 1150), held_at_hz=RATE_HZ
    )
    assert resonance.frequency_hz == pytest.approx(1000.0, rel=2e-3)
    assert resonance.damping_ratio == pytest.approx(0.02, rel=0.03)
    assert resonance.gain == pytest.approx(1.0, rel=0.03)
    assert resonance.phase_rad == pytest.approx(0.0, abs=0.03)


def test_welch_matches_scipy_and_its_deviation_matches_many_runs():
    rng = np.random.default_rng(6)
    scores, inside = [], []
    for _ in range(12):
        input_signal, noise = rng.standard_normal((2, 20_000))
        output_signal = 2.0 * input_signal + noise
        estimate = estimate_welch_response(
            make_siso_signals(input_signal, output_signal, 1000.0), segment=256
        )
        error = np.abs(estimate.response[:, 0, 0] - 2.0)
        scores.append(np.mean((error / estimate.deviation[:, 0, 0])[:-1] ** 2))
        inside.append(np.mean((error < estimate.confidence_radius(0.95)[:, 0, 0])[:-1]))
    settings = {"fs": 1000.0, "nperseg": 256, "window": "hann", "detrend": "constant"}
    cross, power = (
        csd(input_signal, output_signal, **settings)[1],
        welch(input_signal, **settings)[1],
    )
    np.testing.assert_allclose(estimate.response[:, 0, 0], (cross / power)[1:], rtol=1e-9)
    assert np.mean(scores) == pytest.approx(1.0, abs=0.1)
    assert np.mean(inside) == pytest.approx(0.95, abs=0.015)
    assert np.mean(estimate.coherence) == pytest.approx(0.8, abs=0.02)


def make_coupled_experiments(experiments, noise=0.0, seed=0, periods=3):
    """Return the matrix and the experiments of ``y = G u`` with one sample of delay."""
    rng = np.random.default_rng(seed)
    matrix, signals = np.array([[1.0, 0.3], [-0.2, 2.0]]), []
    for number in range(experiments):
        lines = np.arange(1, 200)
        columns = [make_multisine(lines, seed + 10 * number + k, 512) for k in range(2)]
        input_signal = np.tile(np.column_stack(columns), (periods, 1))
        output_signal = np.roll(input_signal, 1, axis=0) @ matrix.T + noise * rng.standard_normal(
            input_signal.shape
        )
        names = ("a", "b"), ("c", "d")
        signals.append(
            ExperimentSignals(
                1000.0, input_signal, output_signal, *names, ("V", "V"), ("m", "m"), 512
            )
        )
    return matrix, signals


def compute_coupled_response(matrix, frequency_hz):
    return np.exp(-2j * np.pi * frequency_hz / 1000.0)[:, None, None] * matrix


@pytest.mark.parametrize("count", [2, 4])
def test_several_experiments_separate_coupled_axes(count):
    matrix, experiments = make_coupled_experiments(count)
    estimate = estimate_periodic_response(*experiments).total
    np.testing.assert_allclose(
        estimate.response, compute_coupled_response(matrix, estimate.frequency_hz), atol=1e-9
    )
    noisy = estimate_periodic_response(*make_coupled_experiments(count, noise=0.1)[1])
    gap = np.abs(noisy.total.response - compute_coupled_response(matrix, noisy.total.frequency_hz))
    assert np.mean((gap / noisy.noise_deviation) ** 2) == pytest.approx(
        2.0 if count == 2 else 1.0, abs=1.6 if count == 2 else 0.2
    )


def test_welch_separates_two_inputs_of_one_record():
    rng = np.random.default_rng(8)
    input_signal = rng.standard_normal((40_000, 2))
    matrix = np.array([[1.0, 0.3], [-0.2, 2.0]])
    output_signal = input_signal @ matrix.T
    signals = ExperimentSignals(
        1000.0, input_signal, output_signal, ("a", "b"), ("c", "d"), ("", ""), ("", "")
    )
    estimate = estimate_welch_response(signals, segment=256)
    np.testing.assert_allclose(estimate.response, np.broadcast_to(matrix, (128, 2, 2)), atol=1e-9)
    np.testing.assert_allclose(estimate.coherence, 1.0)


def test_a_resonance_is_recovered_exactly_with_a_correct_deviation():
    f = np.linspace(80, 120, 81)
    residual_response = 0.3 - 0.1j
    exact = 2.0 * np.exp(-0.7j) * 1e4 / (1e4 - f**2 + 2j * 0.01 * 100 * f) + residual_response
    resonance = fit_resonance(f, exact, band_hz=(80, 120))
    assert resonance[:5] == pytest.approx((100.0, 0.01, 2.0, -0.7, residual_response), rel=1e-8)
    assert resonance.misfit < 1e-10
    rng, scores = np.random.default_rng(9), []
    for _ in range(60):
        noise = rng.standard_normal((2, len(f)))
        noisy = exact + (noise[0] + 1j * noise[1]) / np.sqrt(2)
        fit = fit_resonance(f, noisy, band_hz=(80, 120), deviation=np.ones(len(f)))
        scores.append((fit.frequency_hz - 100) / fit.frequency_deviation)
    assert np.std(scores) == pytest.approx(1.0, abs=0.3)


def test_insufficient_signals_are_refused():
    wave = make_multisine(np.arange(1, 1024))
    full = make_siso_signals(np.tile(wave, 2), np.tile(wave, 2), RATE_HZ, PERIOD)
    with pytest.raises(TooShortError, match="1 whole periods of 2048 samples"):
        estimate_periodic_response(make_siso_signals(wave, wave, RATE_HZ, PERIOD))
    with pytest.raises(IdentificationSettingError, match="a period of None samples"):
        estimate_periodic_response(make_siso_signals(wave, wave, RATE_HZ))
    with pytest.raises(
        InsufficientExcitationError, match="as many experiments as there are inputs"
    ):
        estimate_periodic_response(make_coupled_experiments(1)[1][0])
    levels = [
        make_siso_signals(np.full(2 * PERIOD, k), full.outputs[:, 0], RATE_HZ, PERIOD)
        for k in (1.0, 2.0)
    ]
    with pytest.raises(InsufficientExcitationError, match="on no line are all 1 excited"):
        estimate_periodic_response(*levels)
    with pytest.raises(TooShortError, match="use shorter segments or longer records"):
        estimate_welch_response(full, segment=4096)
    with pytest.raises(IdentificationError, match=r"experiment 1: .* all must be equal"):
        estimate_welch_response(full, make_siso_signals(wave, wave, 100.0), segment=64)
    with pytest.raises(InsufficientExcitationError, match="u: constant at 1"):
        estimate_welch_response(make_siso_signals(np.ones(500), np.ones(500), 1.0), segment=64)
    f = np.linspace(1, 10, 50)
    with pytest.raises(InsufficientExcitationError, match="choose a band around a peak"):
        fit_resonance(f, 1 / (1 + 1j * f), band_hz=(1, 10))
    with pytest.raises(TooShortError, match="0 lines from 20 to 30 Hz"):
        fit_resonance(f, 1 / (1 + 1j * f), band_hz=(20, 30))


def compute_relative_error(response, *experiments):
    """Return ‖y − H u‖ / ‖y‖ without means, with H = 0 at lines without a response."""
    residuals, outputs = [], []
    for spectra in map(average_periods, experiments):
        outputs.append(spectra.outputs[1:])
        residual = spectra.outputs.copy()
        input_signal = spectra.inputs[response.lines][:, :, None]
        residual[response.lines] -= (response.total.response @ input_signal)[:, :, 0]
        residuals.append(residual[1:])
    return np.linalg.norm(residuals) / np.linalg.norm(outputs)


def read_mirror_records(real_dir, part, count):
    axes = ("m1", "m2", "m3")
    return [
        signals_from_record(
            read_record(real_dir / f"fsm_200mV_{part}_{number}.csv"),
            [(axis, Tap.U) for axis in axes],
            [(axis, Tap.MEAS) for axis in axes],
        )
        for number in range(count)
    ]


@pytest.fixture(scope="module")
def mirror_estimate(real_dir):
    return estimate_periodic_response(*read_mirror_records(real_dir, "train", 6))


def test_the_real_mirror_is_a_coupled_linear_system_with_a_known_residual(
    mirror_estimate, real_dir
):
    """The 3 × 3 response from six training records has an error of 4.4 % on the test records."""
    estimate = mirror_estimate
    tests = read_mirror_records(real_dir, "test", 3)
    assert compute_relative_error(estimate, *tests) == pytest.approx(0.044, abs=0.001)
    assert estimate.total.degrees_of_freedom == 3
    assert np.all(estimate.noise_rms < 0.01 * estimate.output_rms)
    assert np.all(estimate.distortion_rms > 4 * estimate.noise_rms)
    assert estimate.total.coherence.mean() > 0.99


def test_the_resonances_of_the_real_mirror_do_not_depend_on_the_band(mirror_estimate):
    """Each axis has one mode, with a phase from the sampling delay (nominal model: 1000 Hz)."""
    linear = mirror_estimate.total
    for axis, expected_hz in enumerate((995.4, 1319.5, 922.5)):
        for half_width in (20.0, 40.0):
            fit = fit_resonance(
                linear.frequency_hz,
                linear.response[:, axis, axis],
                band_hz=(expected_hz - half_width, expected_hz + half_width),
            )
            assert fit.frequency_hz == pytest.approx(expected_hz, abs=0.5)
            assert fit.misfit < 0.04
