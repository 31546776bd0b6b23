"""What each view says of records whose truth is known, and what it refuses in words."""

import numpy as np
import pytest

from rotemina.plugins.identification.findings import answered
from rotemina.plugins.identification.frequency import frequency_findings
from rotemina.plugins.identification.hysteresis_loop import loop_findings
from rotemina.plugins.identification.low_order_fit import model_findings
from rotemina.plugins.identification.staircase import step_findings
from rotemina.plugins.identification.views import LOOKS, View
from rotemina.sim.records.record import Record, Tap

EVERY_LOOK = pytest.mark.parametrize("look", list(LOOKS.values()), ids=lambda look: look.__name__)
# The health card is one of cmd to meas, whatever pair is shown.
EVERY_PAIR_LOOK = pytest.mark.parametrize(
    "look",
    [look for view, look in LOOKS.items() if view is not View.HEALTH],
    ids=lambda look: look.__name__,
)
FREQUENCY_HZ, DAMPING = 1000.0, 0.02


def figure(findings, name):
    """The first number of a figure in the sheet."""
    return float(next(row for row in findings.rows if row[0] == name)[1].split()[0])


def column(findings, heading):
    return np.array(next(c.values for c in findings.columns if c.heading.startswith(heading)))


def plain(command, meas, rate_hz=1000.0, time_s=None):
    time_s = np.arange(len(command)) / rate_hz if time_s is None else time_s
    signals = {("m1", Tap.CMD): command, ("m1", Tap.MEAS): meas}
    return Record.from_signals(time_s, signals, {"m1": "m"})


# --- frequency response ---------------------------------------------------------------------------


def test_welch_shows_the_resonance_and_the_model_agrees(ask, noise_record):
    findings = frequency_findings(ask(noise_record, averages=4))
    assert figure(findings, "resonance") == pytest.approx(FREQUENCY_HZ, rel=1e-3)
    assert figure(findings, "damping ratio") == pytest.approx(DAMPING, rel=0.05)
    off = np.abs(column(findings, "magnitude") - column(findings, "model magnitude"))
    assert np.mean(off < column(findings, "radius")) > 0.9
    inside = column(findings, "frequency") < 3000
    ratio = column(findings, "magnitude") / column(findings, "model magnitude")
    np.testing.assert_allclose(ratio[inside], 1.0, atol=0.02)
    assert [picture.title for picture in findings.pictures] == [
        "|meas/cmd| [1]",
        "phase [°]",
        "coherence",
    ]


def test_the_response_of_a_voltage_has_a_unit(ask, noise_record):
    findings = frequency_findings(ask(noise_record, drive=Tap.U))
    assert findings.pictures[0].title.startswith("|meas/u| [µm/V]")
    assert figure(findings, "gain, lowest line") == pytest.approx(2.7, rel=0.01)


def test_a_periodic_record_is_averaged_over_its_periods(ask, record_of):
    period, lines = 1280, np.arange(1, 200, 2)
    rows = np.arange(4 * period)
    phases = np.random.default_rng(5).uniform(0, 2 * np.pi, len(lines))
    command = 1e-8 * np.cos(2 * np.pi * np.outer(rows, lines) / period + phases).sum(axis=1)
    record = record_of(command, history="periodic", period_samples=str(period))
    findings = frequency_findings(ask(record))
    rows = dict(findings.rows)
    assert rows["estimator"] == "multisine"
    assert rows["averages"] == "4 periods of 1280"
    assert rows["lines"] == str(len(lines))
    np.testing.assert_allclose(column(findings, "frequency"), 10.0 * lines)
    assert figure(findings, "resonance") == pytest.approx(FREQUENCY_HZ, rel=1e-3)
    assert figure(findings, "damping ratio") == pytest.approx(DAMPING, rel=0.02)


def test_a_slow_input_says_that_nothing_is_known_above_it(ask, record_of):
    time_s = np.arange(12_800) / 12_800
    findings = frequency_findings(ask(record_of(1e-6 * np.sin(2 * np.pi * 5 * time_s))))
    assert any("excites only" in text for text in findings.notices)


def test_noise_that_hides_the_answer_is_told_by_coherence(ask, record_of):
    command = 1e-9 * np.random.default_rng(3).uniform(-1.0, 1.0, 8192)
    findings = frequency_findings(ask(record_of(command, noise_m=1e-7)))
    assert any("coherence is below 0.8" in text for text in findings.notices)


def test_a_record_that_the_model_cannot_follow_is_still_measured(ask, noise_record):
    kept = {("m1", tap): noise_record.signal("m1", tap) for tap in (Tap.U, Tap.MEAS)}
    record = Record.from_signals(noise_record.time_s, kept, {"m1": "m"})
    findings = frequency_findings(ask(record, drive=Tap.U))
    assert figure(findings, "resonance") == pytest.approx(FREQUENCY_HZ, rel=2e-3)
    assert any(text.startswith("The nominal model is not shown: ") for text in findings.notices)
    assert not any(c.heading.startswith("model") for c in findings.columns)


# --- loop -----------------------------------------------------------------------------------------


def test_a_backlash_shows_its_play_and_area(ask):
    play = 1e-6
    command = 10e-6 * np.sin(2 * np.pi * np.arange(6001) / 1000.0)
    meas, at = np.empty_like(command), 0.0
    for row, value in enumerate(command):
        meas[row] = at  # read just before the command of its row acts
        at = min(max(at, value - play / 2), value + play / 2)
    findings = loop_findings(ask(plain(command, meas)))
    assert figure(findings, "largest width") == pytest.approx(1.0, rel=0.02)
    assert figure(findings, "backlash width") == pytest.approx(1.0, rel=0.02)
    # A band of 1 µm between two sides that move by 20 − 1 µm.
    assert figure(findings, "area") == pytest.approx(19.0, rel=0.02)
    assert findings.columns[2].heading == "largest width [µm]"
    assert findings.notices == ()


def test_fast_cycles_are_no_hysteresis(ask, noise_record):
    assert any("Drive slower" in text for text in loop_findings(ask(noise_record)).notices)


def test_only_as_many_cycles_are_measured_as_take_a_second(ask):
    command = np.random.default_rng(0).standard_normal(60_000)
    findings = loop_findings(ask(plain(command, command)))
    assert 100 < figure(findings, "cycles") <= 1000  # lopsided ones are left out
    assert any("of 60000 rows, with 1000 reversals" in text for text in findings.notices)


def test_without_a_whole_cycle_the_curve_is_drawn_and_the_reason_given(ask):
    ramp = np.linspace(0.0, 1e-5, 500)
    findings = loop_findings(ask(plain(ramp, ramp)))
    assert findings.pictures
    assert "no whole cycle" in findings.notices[0]


def test_the_models_loop_stands_beside_the_machines(ask, record_of):
    command = 1e-6 * np.sin(2 * np.pi * np.arange(3 * 12_800 + 1) / 12_800)
    found = record_of(command)
    wide = 0.1e-6 * np.sign(np.gradient(command))
    signals = {("m1", Tap.CMD): command, ("m1", Tap.MEAS): found.signal("m1", Tap.MEAS) - wide}
    findings = loop_findings(ask(Record.from_signals(found.time_s, signals, {"m1": "m"})))
    rows = {row[0]: row for row in findings.rows}
    assert findings.head[1:3] == ("median", "model")
    assert figure(findings, "width at mid-range") == pytest.approx(200.0, rel=0.02)
    assert abs(float(rows["width at mid-range"][2].split()[0])) < 2.0
    assert [curve.name for curve in findings.pictures[0].curves] == ["model", "measured"]


# --- steps ----------------------------------------------------------------------------------------


def test_steps_show_overshoot_rise_and_gain(ask, stairs_record):
    findings = step_findings(ask(stairs_record))
    rate, ringing = 2 * np.pi * FREQUENCY_HZ, np.sqrt(1.0 - DAMPING**2)
    since_s = np.arange(100) / 12_800  # the rows may miss the peak itself
    swing = np.cos(ringing * rate * since_s) + DAMPING / ringing * np.sin(ringing * rate * since_s)
    overshoot = -100.0 * np.min(np.exp(-DAMPING * rate * since_s) * swing)
    assert figure(findings, "steps") == 9
    assert figure(findings, "overshoot") == pytest.approx(overshoot, abs=0.2)
    assert figure(findings, "static gain") == pytest.approx(1.0, abs=1e-3)
    # About a sixth of a period of 1 ms from 10 % to 90 %.
    assert figure(findings, "rise 10–90 %") == pytest.approx(0.172, rel=0.05)
    settled_ms = 1e3 * np.log(1 / 0.02) / (2 * np.pi * FREQUENCY_HZ * DAMPING)
    assert figure(findings, "settling to 2 %") == pytest.approx(settled_ms, rel=0.05)


def test_the_models_steps_stand_beside_the_machines(ask, stairs_record):
    slow = Record.from_signals(
        stairs_record.time_s,
        {
            ("m1", Tap.CMD): stairs_record.signal("m1", Tap.CMD),
            ("m1", Tap.MEAS): 0.9 * stairs_record.signal("m1", Tap.MEAS),
        },
        {"m1": "m"},
    )
    findings = step_findings(ask(slow))
    gain = next(row for row in findings.rows if row[0] == "static gain")
    assert [float(text) for text in gain[1:3]] == pytest.approx([0.9, 1.0], abs=1e-3)
    assert "model" in [curve.name for curve in findings.pictures[1].curves]


def test_levels_that_are_reached_by_a_ramp_are_steps(ask):
    """Five rows from level to level: the answer that follows a row later rises for four of them."""
    levels = np.repeat([0.0, 1e-6, 0.0], 200)
    command = np.convolve(np.pad(levels, (4, 0)), np.full(5, 0.2), "valid")
    meas = np.concatenate([command[:1], command[:-1]])
    findings = step_findings(ask(plain(command, meas)))
    assert figure(findings, "steps") == 2
    assert figure(findings, "rise 10–90 %") == pytest.approx(4.0)
    assert figure(findings, "delay to 50 %") == pytest.approx(2.5)
    assert "takes up to 5 ms" in findings.notices[0]


def test_a_wave_is_no_ramp(ask):
    command = 1e-6 * np.sin(2 * np.pi * np.arange(2000) / 100)
    findings = step_findings(ask(plain(command, command)))
    assert "holds no jump" in findings.notices[0]


def test_a_record_without_steps_says_so(ask, noise_record):
    findings = answered(step_findings, ask(noise_record))
    assert "holds no jump" in findings.notices[0]
    assert findings.rows == ()
    assert findings.pictures


def test_steps_within_the_noise_are_told(ask, record_of):
    record = record_of(1e-9 * (np.arange(12_800) // 1280 % 2), noise_m=5e-10)
    notices = step_findings(ask(record)).notices
    assert any("smaller than 10 times the noise" in text for text in notices)
    assert any("settling to 2 %" in text for text in notices)


# --- fitted model ---------------------------------------------------------------------------------


def test_the_models_fit_stands_beside_the_machines(ask, record_of):
    found = record_of(1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 4096))
    signals = {tap: found.signal("m1", tap) for tap in (Tap.CMD, Tap.MEAS)}
    findings = model_findings(ask(plain(signals[Tap.CMD], 0.8 * signals[Tap.MEAS], 12_800.0)))
    rows = {row[0]: row for row in findings.rows}
    assert float(rows["static gain"][1]) == pytest.approx(0.8, abs=1e-3)
    assert float(rows["static gain"][3]) == pytest.approx(1.0, abs=1e-3)
    assert float(rows["damping ratio"][3]) == pytest.approx(DAMPING, rel=1e-3)


@pytest.mark.parametrize("method", ["oe", "arx"])
@pytest.mark.parametrize("drive", [Tap.CMD, Tap.U])
def test_the_fitted_model_has_frequency_damping_and_gain(ask, record_of, method, drive):
    command = 1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 8192)
    record = record_of(command, noise_m=1e-12)
    findings = model_findings(ask(record, drive=drive, method=method))
    assert figure(findings, "natural frequency") == pytest.approx(FREQUENCY_HZ, rel=1e-4)
    assert figure(findings, "damping ratio") == pytest.approx(DAMPING, rel=1e-3)
    gain = 1.0 if drive is Tap.CMD else 2.7
    assert figure(findings, "static gain") == pytest.approx(gain, rel=1e-3)
    assert figure(findings, "fit") > 99.9
    assert findings.notices == ()


def test_arx_under_sensor_noise_is_doubted_and_output_error_is_right(ask, record_of):
    command = 1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 8192)
    record = record_of(command, noise_m=1e-7)
    spoilt = model_findings(ask(record, method="arx"))
    right = model_findings(ask(record, method="oe"))
    assert figure(right, "damping ratio") == pytest.approx(DAMPING, rel=0.03)
    assert figure(spoilt, "damping ratio") > 1.5 * DAMPING
    assert spoilt.notices != ()


def test_a_bad_fit_is_said_in_words(ask):
    rng = np.random.default_rng(2)
    findings = model_findings(ask(plain(rng.standard_normal(2000), rng.standard_normal(2000))))
    assert any(text.startswith("The fit ") and "below 80 %" in text for text in findings.notices)


def test_a_lag_is_called_a_lag(ask):
    command = np.random.default_rng(2).standard_normal(2000)
    meas = np.zeros(2000)
    for row in range(1, 2000):
        meas[row] = 0.9 * meas[row - 1] + 0.1 * command[row - 1]
    findings = model_findings(ask(plain(command, meas), poles=1))
    assert figure(findings, "time constant") == pytest.approx(-1.0 / np.log(0.9), rel=1e-3)
    assert any("a lag, no resonance" in text for text in findings.notices)


# --- refusals -------------------------------------------------------------------------------------


@EVERY_LOOK
def test_an_input_that_never_moves_is_refused_in_words(ask, look):
    rng = np.random.default_rng(0)
    findings = answered(look, ask(plain(np.full(900, 1e-6), rng.standard_normal(900))))
    (notice,) = findings.notices
    assert "constant" in notice or "holds no jump" in notice
    assert findings.rows == ()


@EVERY_LOOK
@pytest.mark.parametrize("rows", [1, 2, 7])
def test_a_record_that_is_too_short_is_refused_in_words(ask, look, rows):
    values = np.random.default_rng(0).standard_normal(rows)
    findings = answered(look, ask(plain(values, values)))
    assert findings.notices
    assert not any("program error" in text for text in findings.notices)


@EVERY_PAIR_LOOK
def test_the_same_tap_twice_is_refused(ask, noise_record, look):
    findings = answered(look, ask(noise_record, drive=Tap.REF, answer=Tap.REF))
    assert findings.notices == ("m1: input and output are both ref; choose two different signals",)


@EVERY_PAIR_LOOK
def test_a_tap_that_the_record_lacks_is_named(ask, noise_record, look):
    (notice,) = answered(look, ask(noise_record, answer=Tap.REF)).notices
    assert "m1.ref" in notice
    assert "m1.cmd, m1.u, m1.meas" in notice


@pytest.mark.parametrize("look", [frequency_findings, loop_findings, model_findings])
def test_uneven_rows_are_named_with_their_bound(ask, look):
    time_s = np.arange(900) / 1000.0
    time_s[450] += 4e-4
    values = np.random.default_rng(0).standard_normal(900)
    (notice,) = answered(look, ask(plain(values, values, time_s=time_s))).notices
    assert "row 450" in notice
    assert "1 % of a step" in notice


def test_a_fault_of_the_program_becomes_a_notice(ask, noise_record, caplog):
    def fails(_):
        raise ZeroDivisionError("nobody thought of it")

    (notice,) = answered(fails, ask(noise_record)).notices
    assert notice == "program error: ZeroDivisionError: nobody thought of it"
    assert caplog.records[0].exc_info
