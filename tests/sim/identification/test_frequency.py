"""Frequency responses against systems whose answer is known."""

import numpy as np
import pytest

from rotemina.sim.identification.errors import (
    ExcitationError,
    IdentificationError,
    SettingError,
    TooShortError,
)
from rotemina.sim.identification.experiment_signals import Signals, signals_of, siso
from rotemina.sim.identification.multisine import period_spectra, periodic_response
from rotemina.sim.identification.resonance import fit_resonance
from rotemina.sim.identification.welch import welch_response
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

PERIOD, RATE_HZ = 2048, 6400.0


def multisine(lines, seed=0, period=PERIOD):
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(lines))
    spectrum = np.zeros(period // 2 + 1, complex)
    spectrum[lines] = np.exp(1j * phases)
    return np.fft.irfft(spectrum, period) * period / 2 / np.sqrt(len(lines) / 2)


def held_response(axis, frequency_hz, rate_hz):
    """Exact response of a piezo axis to held commands, from command to position."""
    from scipy.signal import cont2discrete, freqz

    mass, damping, stiffness = axis.inertia
    top, bottom, _ = cont2discrete(([stiffness], [mass, damping, stiffness]), 1 / rate_hz, "zoh")
    return freqz(top.ravel(), bottom, frequency_hz, fs=rate_hz)[1]


def mirror_record(command, periods=2, **metadata):
    robot = load_robot("fsm")
    command = np.tile(command, periods)
    time_s = np.arange(len(command)) / RATE_HZ
    bare = Record.from_signals(time_s, {("m1", Tap.CMD): command}, {"m1": "m"}, metadata)
    answer = nominal_response(robot, bare).signal("m1", Tap.MEAS)
    signals = {("m1", Tap.CMD): command, ("m1", Tap.MEAS): answer}
    record = Record.from_signals(time_s, signals, {"m1": "m"}, metadata)
    return robot, signals_of(record, [("m1", Tap.CMD)], [("m1", Tap.MEAS)])


def test_a_multisine_gives_the_plant_s_exact_response():
    command = 1e-6 * multisine(np.arange(1, 960, 2))
    meta = {"history": "periodic", "period_samples": str(PERIOD)}
    robot, signals = mirror_record(command, **meta)
    found = periodic_response(signals).total
    exact = held_response(robot.axes["m1"], found.frequency_hz, RATE_HZ)
    assert len(found.frequency_hz) == 480
    np.testing.assert_allclose(found.response[:, 0, 0], exact, rtol=1e-7)
    assert relative_error(periodic_response(signals), signals) < 1e-7
    fitted = fit_resonance(
        found.frequency_hz, found.response[:, 0, 0], band_hz=(850, 1150), held_at_hz=RATE_HZ
    )
    assert fitted.frequency_hz == pytest.approx(1000.0, rel=2e-3)
    assert fitted.damping_ratio == pytest.approx(0.02, rel=0.03)
    assert fitted.gain == pytest.approx(1.0, rel=0.03)
    assert fitted.phase_rad == pytest.approx(0.0, abs=0.03)


def test_welch_finds_the_plant_s_response_within_its_own_deviation():
    command = 1e-6 * np.random.default_rng(5).standard_normal(120_000)
    robot, signals = mirror_record(command, periods=1)
    found = welch_response(signals, segment=4096)
    quiet = found.frequency_hz < 700
    exact = held_response(robot.axes["m1"], found.frequency_hz, RATE_HZ)
    error = np.abs(found.response[:, 0, 0] - exact)
    assert found.coherence[quiet].min() > 0.99
    assert np.sqrt(np.mean((error / found.deviation[:, 0, 0])[quiet] ** 2)) < 1.5
    assert np.median(error[quiet]) < 0.005


def test_welch_agrees_with_scipy_and_its_deviation_with_many_runs():
    from scipy.signal import csd, welch

    rng = np.random.default_rng(6)
    scores, inside = [], []
    for _ in range(12):
        driven, noise = rng.standard_normal((2, 20_000))
        answer = 2.0 * driven + noise
        found = welch_response(siso(driven, answer, 1000.0), segment=256)
        error = np.abs(found.response[:, 0, 0] - 2.0)
        scores.append(np.mean((error / found.deviation[:, 0, 0])[:-1] ** 2))
        inside.append(np.mean((error < found.confidence_radius(0.95)[:, 0, 0])[:-1]))
    settings = {"fs": 1000.0, "nperseg": 256, "window": "hann", "detrend": "constant"}
    cross, power = csd(driven, answer, **settings)[1], welch(driven, **settings)[1]
    np.testing.assert_allclose(found.response[:, 0, 0], (cross / power)[1:], rtol=1e-9)
    assert np.mean(scores) == pytest.approx(1.0, abs=0.1)
    assert np.mean(inside) == pytest.approx(0.95, abs=0.015)
    assert np.mean(found.coherence) == pytest.approx(0.8, abs=0.02)


def coupled(experiments, noise=0.0, seed=0, periods=3):
    """Two inputs, two outputs: ``y = G u`` with a matrix and one sample of delay."""
    rng = np.random.default_rng(seed)
    matrix, out = np.array([[1.0, 0.3], [-0.2, 2.0]]), []
    for number in range(experiments):
        lines = np.arange(1, 200)
        columns = [multisine(lines, seed + 10 * number + k, 512) for k in range(2)]
        driven = np.tile(np.column_stack(columns), (periods, 1))
        answer = np.roll(driven, 1, axis=0) @ matrix.T + noise * rng.standard_normal(driven.shape)
        names = ("a", "b"), ("c", "d")
        out.append(Signals(1000.0, driven, answer, *names, ("V", "V"), ("m", "m"), 512))
    return matrix, out


def exact_coupled(matrix, frequency_hz):
    return np.exp(-2j * np.pi * frequency_hz / 1000.0)[:, None, None] * matrix


@pytest.mark.parametrize("count", [2, 4])
def test_coupled_axes_are_told_apart_by_several_experiments(count):
    matrix, experiments = coupled(count)
    found = periodic_response(*experiments).total
    np.testing.assert_allclose(found.response, exact_coupled(matrix, found.frequency_hz), atol=1e-9)
    noisy = periodic_response(*coupled(count, noise=0.1)[1])
    gap = np.abs(noisy.total.response - exact_coupled(matrix, noisy.total.frequency_hz))
    assert np.mean((gap / noisy.noise_deviation) ** 2) == pytest.approx(
        2.0 if count == 2 else 1.0, abs=1.6 if count == 2 else 0.2
    )


def test_welch_separates_two_inputs_of_one_record():
    rng = np.random.default_rng(8)
    driven = rng.standard_normal((40_000, 2))
    matrix = np.array([[1.0, 0.3], [-0.2, 2.0]])
    answer = driven @ matrix.T
    signals = Signals(1000.0, driven, answer, ("a", "b"), ("c", "d"), ("", ""), ("", ""))
    found = welch_response(signals, segment=256)
    np.testing.assert_allclose(found.response, np.broadcast_to(matrix, (128, 2, 2)), atol=1e-9)
    np.testing.assert_allclose(found.coherence, 1.0)


def test_a_resonance_is_recovered_exactly_and_its_deviation_is_honest():
    f = np.linspace(80, 120, 81)
    rest = 0.3 - 0.1j
    exact = 2.0 * np.exp(-0.7j) * 1e4 / (1e4 - f**2 + 2j * 0.01 * 100 * f) + rest
    found = fit_resonance(f, exact, band_hz=(80, 120))
    assert found[:5] == pytest.approx((100.0, 0.01, 2.0, -0.7, rest), rel=1e-8)
    assert found.misfit < 1e-10
    rng, scores = np.random.default_rng(9), []
    for _ in range(60):
        noise = rng.standard_normal((2, len(f)))
        noisy = exact + (noise[0] + 1j * noise[1]) / np.sqrt(2)
        fit = fit_resonance(f, noisy, band_hz=(80, 120), deviation=np.ones(len(f)))
        scores.append((fit.frequency_hz - 100) / fit.frequency_deviation)
    assert np.std(scores) == pytest.approx(1.0, abs=0.3)


def test_what_cannot_tell_is_refused():
    wave = multisine(np.arange(1, 1024))
    full = siso(np.tile(wave, 2), np.tile(wave, 2), RATE_HZ, PERIOD)
    with pytest.raises(TooShortError, match="1 whole periods of 2048 samples"):
        periodic_response(siso(wave, wave, RATE_HZ, PERIOD))
    with pytest.raises(SettingError, match="a period of None samples"):
        periodic_response(siso(wave, wave, RATE_HZ))
    with pytest.raises(ExcitationError, match="as many experiments as there are inputs"):
        periodic_response(coupled(1)[1][0])
    levels = [siso(np.full(2 * PERIOD, k), full.outputs[:, 0], RATE_HZ, PERIOD) for k in (1.0, 2.0)]
    with pytest.raises(ExcitationError, match="on no line do all 1 move"):
        periodic_response(*levels)
    with pytest.raises(TooShortError, match="use shorter segments or longer records"):
        welch_response(full, segment=4096)
    with pytest.raises(IdentificationError, match=r"experiment 1: .* all must be equal"):
        welch_response(full, siso(wave, wave, 100.0), segment=64)
    with pytest.raises(ExcitationError, match="u: constant at 1"):
        welch_response(siso(np.ones(500), np.ones(500), 1.0), segment=64)
    f = np.linspace(1, 10, 50)
    with pytest.raises(ExcitationError, match="choose a band around a peak"):
        fit_resonance(f, 1 / (1 + 1j * f), band_hz=(1, 10))
    with pytest.raises(TooShortError, match="0 lines from 20 to 30 Hz"):
        fit_resonance(f, 1 / (1 + 1j * f), band_hz=(20, 30))


def relative_error(response, *experiments):
    """‖y − H u‖ / ‖y‖ without means; lines that the response lacks count as not predicted."""
    left, whole = [], []
    for spectra in map(period_spectra, experiments):
        whole.append(spectra.outputs[1:])
        rest = spectra.outputs.copy()
        driven = spectra.inputs[response.lines][:, :, None]
        rest[response.lines] -= (response.total.response @ driven)[:, :, 0]
        left.append(rest[1:])
    return np.linalg.norm(left) / np.linalg.norm(whole)


def mirror(real_dir, part, count):
    axes = ("m1", "m2", "m3")
    return [
        signals_of(
            read_record(real_dir / f"fsm_200mV_{part}_{number}.csv"),
            [(axis, Tap.U) for axis in axes],
            [(axis, Tap.MEAS) for axis in axes],
        )
        for number in range(count)
    ]


def test_the_real_mirror_is_a_coupled_linear_system_but_for_its_known_rest(real_dir):
    """3 × 3 from six train records: 4.4 % on the test records, far above the noise."""
    found = periodic_response(*mirror(real_dir, "train", 6))
    tests = mirror(real_dir, "test", 3)
    assert relative_error(found, *tests) == pytest.approx(0.044, abs=0.001)
    assert found.total.degrees == 3
    assert np.all(found.noise_rms < 0.01 * found.output_rms)
    assert np.all(found.distortion_rms > 4 * found.noise_rms)
    assert found.total.coherence.mean() > 0.99


def test_the_real_mirror_s_resonances_do_not_hang_on_the_band(real_dir):
    """One mode each, turned by the delay of the sampling; the nominal model says 1000 Hz."""
    linear = periodic_response(*mirror(real_dir, "train", 6)).total
    for axis, expected_hz in enumerate((995.4, 1319.5, 922.5)):
        for half_width in (20.0, 40.0):
            fit = fit_resonance(
                linear.frequency_hz,
                linear.response[:, axis, axis],
                band_hz=(expected_hz - half_width, expected_hz + half_width),
            )
            assert fit.frequency_hz == pytest.approx(expected_hz, abs=0.5)
            assert fit.misfit < 0.04
