"""Each analysis on records with known properties, and the records that it refuses."""

import numpy as np
import pytest

from rotemina.plugins.identification.findings import answer_question
from rotemina.plugins.identification.frequency import analyse_frequency_response
from rotemina.plugins.identification.hysteresis_loop import analyse_loop
from rotemina.plugins.identification.low_order_fit import fit_low_order_model
from rotemina.plugins.identification.panel import ANALYSES
from rotemina.plugins.identification.record_query import AnalysisView
from rotemina.plugins.identification.staircase import analyse_steps
from rotemina.sim.records import Record, Tap

EACH_ANALYSIS = pytest.mark.parametrize(
    "analysis", list(ANALYSES.values()), ids=lambda analysis: analysis.__name__
)
# The health card always uses cmd and meas, whatever pair of signals is chosen.
EACH_PAIR_ANALYSIS = pytest.mark.parametrize(
    "analysis",
    [analysis for view, analysis in ANALYSES.items() if view is not AnalysisView.HEALTH],
    ids=lambda analysis: analysis.__name__,
)
FREQUENCY_HZ, DAMPING = 1000.0, 0.02


def read_figure(findings, name):
    """Return the first number of a figure in the table."""
    return float(next(row for row in findings.rows if row[0] == name)[1].split()[0])


def read_column(findings, heading):
    return np.array(
        next(column.values for column in findings.columns if column.heading.startswith(heading))
    )


def make_record_of(command, meas, rate_hz=1000.0, time_s=None):
    time_s = np.arange(len(command)) / rate_hz if time_s is None else time_s
    signals = {("m1", Tap.CMD): command, ("m1", Tap.MEAS): meas}
    return Record.from_signals(time_s, signals, {"m1": "m"})


def test_welch_shows_the_resonance_and_the_model_agrees(make_query, noise_record):
    findings = analyse_frequency_response(make_query(noise_record, averages=4))
    assert read_figure(findings, "resonance") == pytest.approx(FREQUENCY_HZ, rel=1e-3)
    assert read_figure(findings, "damping ratio") == pytest.approx(DAMPING, rel=0.05)
    deviation = np.abs(
        read_column(findings, "magnitude") - read_column(findings, "model magnitude")
    )
    assert np.mean(deviation < read_column(findings, "radius")) > 0.9
    below_3_khz = read_column(findings, "frequency") < 3000
    ratio = read_column(findings, "magnitude") / read_column(findings, "model magnitude")
    np.testing.assert_allclose(ratio[below_3_khz], 1.0, atol=0.02)
    assert [picture.title for picture in findings.pictures] == [
        "|meas/cmd| [1]",
        "phase [°]",
        "coherence",
    ]


def test_the_response_of_a_voltage_has_a_unit(make_query, noise_record):
    findings = analyse_frequency_response(make_query(noise_record, input_tap=Tap.U))
    assert findings.pictures[0].title.startswith("|meas/u| [µm/V]")
    assert read_figure(findings, "gain, lowest line") == pytest.approx(2.7, rel=0.01)


def test_a_periodic_record_is_averaged_over_its_periods(make_query, make_mirror_record):
    period_samples, lines = 1280, np.arange(1, 200, 2)
    rows = np.arange(4 * period_samples)
    phases = np.random.default_rng(5).uniform(0, 2 * np.pi, len(lines))
    command = 1e-8 * np.cos(2 * np.pi * np.outer(rows, lines) / period_samples + phases).sum(axis=1)
    record = make_mirror_record(command, history="periodic", period_samples=str(period_samples))
    findings = analyse_frequency_response(make_query(record))
    rows = dict(findings.rows)
    assert rows["estimator"] == "multisine"
    assert rows["averages"] == "4 periods of 1280"
    assert rows["lines"] == str(len(lines))
    np.testing.assert_allclose(read_column(findings, "frequency"), 10.0 * lines)
    assert read_figure(findings, "resonance") == pytest.approx(FREQUENCY_HZ, rel=1e-3)
    assert read_figure(findings, "damping ratio") == pytest.approx(DAMPING, rel=0.02)


def test_a_slow_input_is_reported_as_exciting_low_frequencies_only(make_query, make_mirror_record):
    time_s = np.arange(12_800) / 12_800
    findings = analyse_frequency_response(
        make_query(make_mirror_record(1e-6 * np.sin(2 * np.pi * 5 * time_s)))
    )
    assert any("excites only" in text for text in findings.notices)


def test_a_record_without_a_command_is_analysed_without_the_model(make_query, noise_record):
    signals = {("m1", tap): noise_record.signal("m1", tap) for tap in (Tap.U, Tap.MEAS)}
    record = Record.from_signals(noise_record.time_s, signals, {"m1": "m"})
    findings = analyse_frequency_response(make_query(record, input_tap=Tap.U))
    assert read_figure(findings, "resonance") == pytest.approx(FREQUENCY_HZ, rel=2e-3)
    assert any(text.startswith("The nominal model is not shown: ") for text in findings.notices)
    assert not any(column.heading.startswith("model") for column in findings.columns)


def test_a_backlash_shows_its_play_and_area(make_query):
    width = 1e-6
    command = 10e-6 * np.sin(2 * np.pi * np.arange(6001) / 1000.0)
    meas, output = np.empty_like(command), 0.0
    for row, value in enumerate(command):
        meas[row] = output  # measured just before the command of the row acts
        output = min(max(output, value - width / 2), value + width / 2)
    findings = analyse_loop(make_query(make_record_of(command, meas)))
    assert read_figure(findings, "largest width") == pytest.approx(1.0, rel=0.02)
    assert read_figure(findings, "backlash width") == pytest.approx(1.0, rel=0.02)
    # The loop is a band of width 1 µm whose sides are 20 − 1 µm long.
    assert read_figure(findings, "area") == pytest.approx(19.0, rel=0.02)
    assert findings.columns[2].heading == "largest width [µm]"
    assert findings.notices == ()


def test_fast_cycles_are_reported_as_too_fast(make_query, noise_record):
    assert any("Drive slower" in text for text in analyse_loop(make_query(noise_record)).notices)


def test_the_number_of_evaluated_cycles_is_limited(make_query):
    command = np.random.default_rng(0).standard_normal(60_000)
    findings = analyse_loop(make_query(make_record_of(command, command)))
    assert 100 < read_figure(findings, "cycles") <= 1000  # asymmetric cycles are left out
    assert any("of 60000 rows, with 1000 reversals" in text for text in findings.notices)


def test_without_a_whole_cycle_only_the_curve_is_drawn(make_query):
    ramp = np.linspace(0.0, 1e-5, 500)
    findings = analyse_loop(make_query(make_record_of(ramp, ramp)))
    assert findings.pictures
    assert "no whole cycle" in findings.notices[0]


def test_the_loop_of_the_model_is_shown_with_the_measured_one(make_query, make_mirror_record):
    command = 1e-6 * np.sin(2 * np.pi * np.arange(3 * 12_800 + 1) / 12_800)
    mirror_record = make_mirror_record(command)
    loop_offset = 0.1e-6 * np.sign(np.gradient(command))
    signals = {
        ("m1", Tap.CMD): command,
        ("m1", Tap.MEAS): mirror_record.signal("m1", Tap.MEAS) - loop_offset,
    }
    findings = analyse_loop(
        make_query(Record.from_signals(mirror_record.time_s, signals, {"m1": "m"}))
    )
    rows = {row[0]: row for row in findings.rows}
    assert findings.head[1:3] == ("median", "model")
    assert read_figure(findings, "width at mid-range") == pytest.approx(200.0, rel=0.02)
    assert abs(float(rows["width at mid-range"][2].split()[0])) < 2.0
    assert [curve.name for curve in findings.pictures[0].curves] == ["model", "measured"]


def test_steps_are_shown_with_those_of_the_model(make_query, stairs_record):
    signals = {
        ("m1", Tap.CMD): stairs_record.signal("m1", Tap.CMD),
        ("m1", Tap.MEAS): 0.9 * stairs_record.signal("m1", Tap.MEAS),
    }
    findings = analyse_steps(
        make_query(Record.from_signals(stairs_record.time_s, signals, {"m1": "m"}))
    )
    rows = {row[0]: [float(text.split()[0]) for text in row[1:3]] for row in findings.rows[1:]}
    assert read_figure(findings, "steps") == 9
    assert rows["static gain"] == pytest.approx([0.9, 1.0], abs=1e-3)
    # About a sixth of a period of 1 ms from 10 % to 90 %.
    assert rows["rise 10–90 %"] == pytest.approx([0.172, 0.172], rel=0.05)
    settled_ms = 1e3 * np.log(1 / 0.02) / (2 * np.pi * FREQUENCY_HZ * DAMPING)
    assert rows["settling to 2 %"] == pytest.approx([settled_ms, settled_ms], rel=0.05)
    assert rows["overshoot"] == pytest.approx([rows["overshoot"][1]] * 2, abs=0.2)
    assert "model" in [curve.name for curve in findings.pictures[1].curves]


def test_short_ramps_between_levels_count_as_steps(make_query):
    """Each ramp takes five rows; the output follows one row later and rises during four of them."""
    levels = np.repeat([0.0, 1e-6, 0.0], 200)
    command = np.convolve(np.pad(levels, (4, 0)), np.full(5, 0.2), "valid")
    meas = np.concatenate([command[:1], command[:-1]])
    findings = analyse_steps(make_query(make_record_of(command, meas)))
    assert read_figure(findings, "steps") == 2
    assert read_figure(findings, "rise 10–90 %") == pytest.approx(4.0)
    assert read_figure(findings, "delay to 50 %") == pytest.approx(2.5)
    assert "takes up to 5 ms" in findings.notices[0]


def test_a_record_without_steps_is_reported(make_query, noise_record):
    findings = answer_question(analyse_steps, make_query(noise_record))
    assert "holds no jump" in findings.notices[0]
    assert findings.rows == ()
    assert findings.pictures


def test_steps_within_the_noise_are_reported(make_query, make_mirror_record):
    record = make_mirror_record(1e-9 * (np.arange(12_800) // 1280 % 2), noise_m=5e-10)
    notices = analyse_steps(make_query(record)).notices
    assert any("smaller than 10 times the noise" in text for text in notices)
    assert any("settling to 2 %" in text for text in notices)


def test_the_fit_of_the_model_is_shown_with_the_measured_one(make_query, make_mirror_record):
    mirror_record = make_mirror_record(1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 4096))
    signals = {tap: mirror_record.signal("m1", tap) for tap in (Tap.CMD, Tap.MEAS)}
    findings = fit_low_order_model(
        make_query(make_record_of(signals[Tap.CMD], 0.8 * signals[Tap.MEAS], 12_800.0))
    )
    rows = {row[0]: row for row in findings.rows}
    assert float(rows["static gain"][1]) == pytest.approx(0.8, abs=1e-3)
    assert float(rows["static gain"][3]) == pytest.approx(1.0, abs=1e-3)
    assert float(rows["damping ratio"][3]) == pytest.approx(DAMPING, rel=1e-3)


def test_under_noise_arx_is_questioned_and_output_error_is_right(make_query, make_mirror_record):
    command = 1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 8192)
    record = make_mirror_record(command, noise_m=1e-7)
    arx_findings = fit_low_order_model(make_query(record, method="arx"))
    oe_findings = fit_low_order_model(make_query(record, method="oe"))
    assert read_figure(oe_findings, "damping ratio") == pytest.approx(DAMPING, rel=0.03)
    assert read_figure(arx_findings, "damping ratio") > 1.5 * DAMPING
    assert arx_findings.notices != ()
    # Noise alone.
    noise = np.random.default_rng(2).standard_normal((2, 2000))
    noise_query = make_query(make_record_of(*noise))
    notices = fit_low_order_model(noise_query).notices
    assert any(text.startswith("The fit ") and "below 80 %" in text for text in notices)
    notices = analyse_frequency_response(noise_query).notices
    assert any("coherence is below 0.8" in text for text in notices)


@EACH_ANALYSIS
def test_a_constant_input_is_refused(make_query, analysis):
    rng = np.random.default_rng(0)
    findings = answer_question(
        analysis, make_query(make_record_of(np.full(900, 1e-6), rng.standard_normal(900)))
    )
    (notice,) = findings.notices
    assert "constant" in notice or "holds no jump" in notice
    assert findings.rows == ()


@EACH_ANALYSIS
def test_a_too_short_record_is_refused(make_query, analysis):
    for rows in (1, 2, 7):
        values = np.random.default_rng(0).standard_normal(rows)
        findings = answer_question(analysis, make_query(make_record_of(values, values)))
        assert findings.notices
        assert not any("program error" in text for text in findings.notices)


@EACH_PAIR_ANALYSIS
def test_a_missing_tap_and_the_same_tap_twice_are_refused(make_query, noise_record, analysis):
    (notice,) = answer_question(analysis, make_query(noise_record, output_tap=Tap.REF)).notices
    assert "m1.ref" in notice
    assert "m1.cmd, m1.u, m1.meas" in notice
    query = make_query(noise_record, input_tap=Tap.REF, output_tap=Tap.REF)
    assert answer_question(analysis, query).notices == (
        "m1: input and output are both ref; choose two different signals",
    )


@pytest.mark.parametrize(
    "analysis", [analyse_frequency_response, analyse_loop, fit_low_order_model]
)
def test_uneven_sampling_is_refused_with_its_bound(make_query, analysis):
    time_s = np.arange(900) / 1000.0
    time_s[450] += 4e-4
    values = np.random.default_rng(0).standard_normal(900)
    (notice,) = answer_question(
        analysis, make_query(make_record_of(values, values, time_s=time_s))
    ).notices
    assert "row 450" in notice
    assert "1 % of a step" in notice


def test_a_program_error_becomes_a_notice(make_query, noise_record, caplog):
    def raise_error(_):
        raise ZeroDivisionError("nobody thought of it")

    (notice,) = answer_question(raise_error, make_query(noise_record)).notices
    assert notice == "program error: ZeroDivisionError: nobody thought of it"
    assert caplog.records[0].exc_info
