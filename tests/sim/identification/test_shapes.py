"""Step figures and hysteresis loops of systems whose figures are known."""

import numpy as np
import pytest

from rotemina.sim.identification.errors import ExcitationError, IdentificationError, TooShortError
from rotemina.sim.identification.loop_figures import amplitude_exponent, loops
from rotemina.sim.identification.step_figures import step_metrics
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap

TIME_S = np.arange(20_000) / 10_000.0


def step_record(command, answer, time_s=TIME_S):
    signals = {("x", Tap.CMD): command, ("x", Tap.MEAS): answer}
    return Record.from_signals(time_s, signals, {"x": "m"})


def second_order(since, damping=0.4, frequency_hz=8.0):
    root = 2 * np.pi * frequency_hz
    damped = root * np.sqrt(1 - damping**2)
    since = np.maximum(since, 0.0)
    swing = np.cos(damped * since) + damping * root / damped * np.sin(damped * since)
    return 1 - np.exp(-damping * root * since) * swing


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_figures_of_a_second_order_step_are_the_analytic_ones(sign):
    command = sign * 2e-6 * (TIME_S >= 0.5)
    answer = 1e-6 + sign * 1.8e-6 * second_order(TIME_S - 0.5)
    (step,) = step_metrics(step_record(command, answer), "x")
    root, damping = 2 * np.pi * 8.0, 0.4
    damped = root * np.sqrt(1 - damping**2)
    assert step.start_s == pytest.approx(0.5)
    assert step.gain == pytest.approx(0.9, rel=1e-6)
    assert step.error == pytest.approx(1e-6 - sign * 0.2e-6, rel=1e-6)
    overshoot = 100 * np.exp(-np.pi * damping / np.sqrt(1 - damping**2))
    assert step.overshoot_percent == pytest.approx(overshoot, rel=1e-4)
    assert step.peak_s == pytest.approx(np.pi / damped, abs=1e-4)
    fine = np.linspace(0, 1.5, 3_000_001)
    course = second_order(fine)
    times = [fine[np.argmax(course >= level)] for level in (0.1, 0.5, 0.9)]
    assert step.delay_s == pytest.approx(times[1], abs=2e-6)
    assert step.rise_s == pytest.approx(times[2] - times[0], abs=2e-6)
    for band, found in ((0.02, step.settling_2_s), (0.05, step.settling_5_s)):
        last = fine[np.flatnonzero(np.abs(course - 1) > band)[-1]]
        assert found == pytest.approx(last, abs=5e-6)


def test_every_step_of_a_staircase_is_found_at_any_sampling():
    time_s = np.sort(np.random.default_rng(0).uniform(0, 3, 3000))
    command = np.floor(time_s) * 1e-6
    lag = 0.03
    steps = 1e-6 * sum((time_s >= k) * (1 - np.exp(-(time_s - k) / lag)) for k in (1, 2))
    found = step_metrics(step_record(command, steps, time_s), "x")
    assert len(found) == 2
    for step in found:
        assert step.gain == pytest.approx(1.0, abs=1e-6)
        assert step.overshoot_percent == pytest.approx(0.0, abs=0.01)
        assert step.delay_s == pytest.approx(lag * np.log(2), abs=2e-3)
        assert step.settling_2_s == pytest.approx(lag * np.log(50), abs=2e-3)


def test_what_has_not_settled_is_not_said_to_have():
    command = 1.0 * (TIME_S >= 0.5)
    (step,) = step_metrics(step_record(command, command * (TIME_S - 0.5)), "x")
    assert step.settling_2_s is None
    (still,) = step_metrics(step_record(command, 0 * command), "x")
    assert (still.gain, still.delay_s, still.rise_s) == (0.0, None, None)


def test_steps_beside_a_short_hold_can_be_left_out():
    command = 1.0 * (TIME_S >= 0.5) + 1.0 * (TIME_S >= 0.52)
    record = step_record(command, command)
    assert [step.start_s for step in step_metrics(record, "x")] == pytest.approx([0.5, 0.52])
    assert step_metrics(record, "x")[0].noise_rms == 0.0
    with pytest.raises(ExcitationError, match=r"50 rows and 0\.1 s; record a staircase"):
        step_metrics(record, "x", shortest_hold_s=0.1)


def test_records_without_a_step_are_refused():
    wave = np.sin(TIME_S)
    with pytest.raises(ExcitationError, match="record a staircase"):
        step_metrics(step_record(wave, wave), "x")
    with pytest.raises(ExcitationError, match="record a staircase"):
        step_metrics(step_record(0 * wave, wave), "x")
    with pytest.raises(IdentificationError, match=r"no x.ref; it has x.cmd, x.meas"):
        step_metrics(step_record(wave, wave), "x", Tap.REF)


def play(driven, half_width):
    out, state = np.empty_like(driven), driven[0]
    for row, value in enumerate(driven):
        state = min(max(state, value - half_width), value + half_width)
        out[row] = state
    return out


def triangle(cycles, amplitude=1.0, rows=2000):
    phase = np.arange(cycles * rows + 1) / rows
    return -amplitude * (1 - 4 * np.abs((phase + 0.5) % 1 - 0.5))


def test_the_loop_of_an_ellipse_has_its_area_and_width():
    phase = 2 * np.pi * np.arange(3 * 4000 + 1) / 4000
    lag = 0.2
    found = loops(-np.cos(phase), -3.0 * np.cos(phase - lag))
    assert len(found) == 3
    for loop in found:
        assert loop.area == pytest.approx(np.pi * 3.0 * np.sin(lag), rel=1e-5)
        assert loop.width_mid == pytest.approx(6.0 * np.sin(lag), rel=1e-4)
        assert loop.amplitude == pytest.approx(1.0)
        assert loop.stroke == pytest.approx(6.0 * np.cos(lag), rel=1e-3)
    assert loops(-np.cos(phase), 3.0 * -np.cos(phase + lag))[0].area < 0


def test_the_loop_of_a_play_has_its_area_and_width():
    """Width 2r; a parallelogram of area 2r (2A − 2r)."""
    driven = triangle(3)
    for loop in loops(driven, play(driven, 0.1))[1:]:
        assert loop.input_width_mid == pytest.approx(0.2, abs=2e-3)
        assert loop.width_max == pytest.approx(0.2, abs=1e-9)
        assert loop.area == pytest.approx(0.2 * 1.8, rel=1e-3)
        assert loop.width_percent == pytest.approx(100 * 0.2 / 1.8, rel=1e-2)
        assert loop.saturation_low is None
        assert loop.saturation_high is None


def test_a_cycle_from_high_to_high_is_measured_alike():
    """Up from the middle, down and up again: the only whole cycle lies between the highs."""
    driven = np.interp(np.arange(4001), [0, 1000, 2500, 4000], [0.0, 1.0, -1.0, 1.0])
    (loop,) = loops(driven, np.clip(play(driven, 0.1), -0.7, 2.0))
    assert loop.rows == (1000, 4000)
    assert (loop.input_low, loop.input_high) == pytest.approx((-1.0, 1.0))
    assert loop.width_max == pytest.approx(0.2, abs=1e-9)
    assert loop.input_width_mid == pytest.approx(0.2, abs=5e-3)
    assert loop.area > 0
    assert loop.saturation_low == pytest.approx(-0.8, abs=0.02)
    assert loop.saturation_high is None


def test_a_clipped_output_shows_where_it_ends():
    driven = triangle(2)
    loop = loops(driven, np.clip(driven, -0.7, 0.6))[0]
    assert loop.saturation_high == pytest.approx(0.6, abs=0.02)
    assert loop.saturation_low == pytest.approx(-0.7, abs=0.02)
    assert loop.area == pytest.approx(0.0, abs=1e-9)


def test_width_grows_with_amplitude_as_the_law_says():
    sizes = (1.0, 1.4, 2.0, 2.8)
    driven = np.concatenate([triangle(1, size)[:-1] for size in sizes] + [[-2.8]])
    found = loops(driven, play(driven, 0.1))
    assert len(found) == 4
    assert amplitude_exponent(found) == pytest.approx(0.0, abs=0.02)
    phase = 2 * np.pi * np.arange(4001) / 4000
    lagging = [loops(-size * np.cos(phase), -size * np.cos(phase - 0.1)) for size in sizes]
    assert amplitude_exponent(sum(lagging, ())) == pytest.approx(1.0, abs=1e-6)
    rayleigh = [
        loops(size * -np.cos(phase), size * -np.cos(phase) - 0.1 * size**2 * np.sin(phase))
        for size in sizes
    ]
    assert amplitude_exponent(sum(rayleigh, ())) == pytest.approx(2.0, abs=1e-6)


def test_a_held_command_is_read_one_sample_later():
    driven = triangle(2, rows=100)
    answer = np.r_[driven[0], driven[:-1]]
    assert loops(driven, answer)[0].width_mid > 0.03
    assert loops(driven, answer, lag_samples=1)[0].width_mid == pytest.approx(0.0, abs=1e-12)


def test_loops_that_are_none_are_refused():
    with pytest.raises(ExcitationError, match="no whole cycle"):
        loops(np.arange(10.0), np.arange(10.0))
    with pytest.raises(ExcitationError, match="input: constant at 1"):
        loops(np.ones(10), np.arange(10.0))
    with pytest.raises(TooShortError, match="2 samples of input"):
        loops(np.ones(2), np.ones(2))
    driven = triangle(3)
    with pytest.raises(ExcitationError, match="record growing or decaying cycles"):
        amplitude_exponent(loops(driven, play(driven, 0.1)))


def test_the_real_stack_shows_its_hysteresis(real_dir):
    record = read_record(real_dir / "picma_train.csv")
    found = loops(record.signal("p", Tap.CMD), record.signal("p", Tap.MEAS))
    assert len(found) == 39
    widths = [loop.width_percent for loop in found]
    assert np.median(widths) == pytest.approx(23.3, abs=0.5)
    assert np.ptp(widths) < 1.0
