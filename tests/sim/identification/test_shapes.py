"""Figures of steps and hysteresis loops of systems with exact solutions."""

import numpy as np
import pytest

from rotemina.sim.errors import IdentificationError, InsufficientExcitationError, TooShortError
from rotemina.sim.identification import fit_amplitude_exponent, measure_loops, measure_steps
from rotemina.sim.records import Record, Tap, read_record

TIME_S = np.arange(20_000) / 10_000.0


def make_step_record(command, output_signal, time_s=TIME_S):
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): output_signal}
    return Record.from_signals(time_s, signals, {"x": "m"})


def compute_second_order_step(time_s, damping=0.4, frequency_hz=8.0):
    natural_rate = 2 * np.pi * frequency_hz
    damped_rate = natural_rate * np.sqrt(1 - damping**2)
    time_s = np.maximum(time_s, 0.0)
    swing = np.cos(damped_rate * time_s) + damping * natural_rate / damped_rate * np.sin(
        damped_rate * time_s
    )
    return 1 - np.exp(-damping * natural_rate * time_s) * swing


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_figures_of_a_second_order_step_match_the_analytic_ones(sign):
    command = sign * 2e-6 * (TIME_S >= 0.5)
    output_signal = 1e-6 + sign * 1.8e-6 * compute_second_order_step(TIME_S - 0.5)
    (step,) = measure_steps(make_step_record(command, output_signal), "x")
    natural_rate, damping = 2 * np.pi * 8.0, 0.4
    damped_rate = natural_rate * np.sqrt(1 - damping**2)
    assert step.start_s == pytest.approx(0.5)
    assert step.gain == pytest.approx(0.9, rel=1e-6)
    assert step.error == pytest.approx(1e-6 - sign * 0.2e-6, rel=1e-6)
    overshoot = 100 * np.exp(-np.pi * damping / np.sqrt(1 - damping**2))
    assert step.overshoot_percent == pytest.approx(overshoot, rel=1e-4)
    assert step.peak_s == pytest.approx(np.pi / damped_rate, abs=1e-4)
    fine_time_s = np.linspace(0, 1.5, 3_000_001)
    response = compute_second_order_step(fine_time_s)
    times = [fine_time_s[np.argmax(response >= level)] for level in (0.1, 0.5, 0.9)]
    assert step.delay_s == pytest.approx(times[1], abs=2e-6)
    assert step.rise_s == pytest.approx(times[2] - times[0], abs=2e-6)
    for band, settling_s in ((0.02, step.settling_2_s), (0.05, step.settling_5_s)):
        last_outside_s = fine_time_s[np.flatnonzero(np.abs(response - 1) > band)[-1]]
        assert settling_s == pytest.approx(last_outside_s, abs=5e-6)


def test_every_step_of_a_staircase_is_found_at_any_sampling():
    time_s = np.sort(np.random.default_rng(0).uniform(0, 3, 3000))
    command = np.floor(time_s) * 1e-6
    lag = 0.03
    output_signal = 1e-6 * sum((time_s >= k) * (1 - np.exp(-(time_s - k) / lag)) for k in (1, 2))
    steps = measure_steps(make_step_record(command, output_signal, time_s), "x")
    assert len(steps) == 2
    for step in steps:
        assert step.gain == pytest.approx(1.0, abs=1e-6)
        assert step.overshoot_percent == pytest.approx(0.0, abs=0.01)
        assert step.delay_s == pytest.approx(lag * np.log(2), abs=2e-3)
        assert step.settling_2_s == pytest.approx(lag * np.log(50), abs=2e-3)


def test_a_step_that_does_not_settle_has_no_settling_time():
    command = 1.0 * (TIME_S >= 0.5)
    (step,) = measure_steps(make_step_record(command, command * (TIME_S - 0.5)), "x")
    assert step.settling_2_s is None
    (constant_step,) = measure_steps(make_step_record(command, 0 * command), "x")
    assert (constant_step.gain, constant_step.delay_s, constant_step.rise_s) == (0.0, None, None)


def test_steps_next_to_a_short_hold_can_be_left_out():
    command = 1.0 * (TIME_S >= 0.5) + 1.0 * (TIME_S >= 0.52)
    record = make_step_record(command, command)
    assert [step.start_s for step in measure_steps(record, "x")] == pytest.approx([0.5, 0.52])
    assert measure_steps(record, "x")[0].noise_rms == 0.0
    with pytest.raises(
        InsufficientExcitationError, match=r"50 rows and 0\.1 s; record a staircase"
    ):
        measure_steps(record, "x", min_hold_s=0.1)


def test_records_without_a_step_are_refused():
    wave = np.sin(TIME_S)
    with pytest.raises(InsufficientExcitationError, match="record a staircase"):
        measure_steps(make_step_record(wave, wave), "x")
    with pytest.raises(InsufficientExcitationError, match="record a staircase"):
        measure_steps(make_step_record(0 * wave, wave), "x")
    with pytest.raises(IdentificationError, match=r"no x.ref; it has x.cmd, x.meas"):
        measure_steps(make_step_record(wave, wave), "x", Tap.REF)


def apply_play(input_signal, half_width):
    output, state = np.empty_like(input_signal), input_signal[0]
    for row, value in enumerate(input_signal):
        state = min(max(state, value - half_width), value + half_width)
        output[row] = state
    return output


def make_triangle(cycles, amplitude=1.0, rows=2000):
    phase = np.arange(cycles * rows + 1) / rows
    return -amplitude * (1 - 4 * np.abs((phase + 0.5) % 1 - 0.5))


def test_the_loop_of_an_ellipse_has_the_exact_area_and_width():
    phase = 2 * np.pi * np.arange(3 * 4000 + 1) / 4000
    lag = 0.2
    loops = measure_loops(-np.cos(phase), -3.0 * np.cos(phase - lag))
    assert len(loops) == 3
    for loop in loops:
        assert loop.area == pytest.approx(np.pi * 3.0 * np.sin(lag), rel=1e-5)
        assert loop.width_mid == pytest.approx(6.0 * np.sin(lag), rel=1e-4)
        assert loop.amplitude == pytest.approx(1.0)
        assert loop.stroke == pytest.approx(6.0 * np.cos(lag), rel=1e-3)
    assert measure_loops(-np.cos(phase), 3.0 * -np.cos(phase + lag))[0].area < 0


def test_the_loop_of_a_play_has_the_exact_area_and_width():
    """The loop is a parallelogram of width 2r and area 2r (2A − 2r)."""
    input_signal = make_triangle(3)
    for loop in measure_loops(input_signal, apply_play(input_signal, 0.1))[1:]:
        assert loop.input_width_mid == pytest.approx(0.2, abs=2e-3)
        assert loop.width_max == pytest.approx(0.2, abs=1e-9)
        assert loop.area == pytest.approx(0.2 * 1.8, rel=1e-3)
        assert loop.width_percent == pytest.approx(100 * 0.2 / 1.8, rel=1e-2)
        assert loop.saturation_low is None
        assert loop.saturation_high is None


def test_a_cycle_between_two_maxima_is_measured():
    """The only whole cycle of a record that starts mid-range lies between its two maxima."""
    input_signal = np.interp(np.arange(4001), [0, 1000, 2500, 4000], [0.0, 1.0, -1.0, 1.0])
    (loop,) = measure_loops(input_signal, np.clip(apply_play(input_signal, 0.1), -0.7, 2.0))
    assert loop.rows == (1000, 4000)
    assert (loop.input_low, loop.input_high) == pytest.approx((-1.0, 1.0))
    assert loop.width_max == pytest.approx(0.2, abs=1e-9)
    assert loop.input_width_mid == pytest.approx(0.2, abs=5e-3)
    assert loop.area > 0
    assert loop.saturation_low == pytest.approx(-0.8, abs=0.02)
    assert loop.saturation_high is None


def test_saturation_of_a_clipped_output_is_found():
    input_signal = make_triangle(2)
    loop = measure_loops(input_signal, np.clip(input_signal, -0.7, 0.6))[0]
    assert loop.saturation_high == pytest.approx(0.6, abs=0.02)
    assert loop.saturation_low == pytest.approx(-0.7, abs=0.02)
    assert loop.area == pytest.approx(0.0, abs=1e-9)


def test_the_exponent_of_the_width_over_amplitude_is_found():
    sizes = (1.0, 1.4, 2.0, 2.8)
    input_signal = np.concatenate([make_triangle(1, size)[:-1] for size in sizes] + [[-2.8]])
    loops = measure_loops(input_signal, apply_play(input_signal, 0.1))
    assert len(loops) == 4
    assert fit_amplitude_exponent(loops) == pytest.approx(0.0, abs=0.02)
    phase = 2 * np.pi * np.arange(4001) / 4000
    lagging = [measure_loops(-size * np.cos(phase), -size * np.cos(phase - 0.1)) for size in sizes]
    assert fit_amplitude_exponent(sum(lagging, ())) == pytest.approx(1.0, abs=1e-6)
    rayleigh = [
        measure_loops(size * -np.cos(phase), size * -np.cos(phase) - 0.1 * size**2 * np.sin(phase))
        for size in sizes
    ]
    assert fit_amplitude_exponent(sum(rayleigh, ())) == pytest.approx(2.0, abs=1e-6)


def test_the_lag_of_a_held_command_is_corrected():
    input_signal = make_triangle(2, rows=100)
    output_signal = np.r_[input_signal[0], input_signal[:-1]]
    assert measure_loops(input_signal, output_signal)[0].width_mid > 0.03
    assert measure_loops(input_signal, output_signal, lag_samples=1)[0].width_mid == pytest.approx(
        0.0, abs=1e-12
    )


def test_records_without_loops_are_refused():
    with pytest.raises(InsufficientExcitationError, match="no whole cycle"):
        measure_loops(np.arange(10.0), np.arange(10.0))
    with pytest.raises(InsufficientExcitationError, match="input: constant at 1"):
        measure_loops(np.ones(10), np.arange(10.0))
    with pytest.raises(TooShortError, match="2 samples of input"):
        measure_loops(np.ones(2), np.ones(2))
    input_signal = make_triangle(3)
    with pytest.raises(InsufficientExcitationError, match="record growing or decaying cycles"):
        fit_amplitude_exponent(measure_loops(input_signal, apply_play(input_signal, 0.1)))


def test_the_real_stack_has_its_known_hysteresis(real_dir):
    record = read_record(real_dir / "picma_train.csv")
    loops = measure_loops(record.signal("p", Tap.CMD), record.signal("p", Tap.MEAS))
    assert len(loops) == 39
    widths = [loop.width_percent for loop in loops]
    assert np.median(widths) == pytest.approx(23.3, abs=0.5)
    assert np.ptp(widths) < 1.0
