"""The run report: of a playback and of a recording, whole by itself, in both languages."""

import re

import numpy as np
import pytest

from rotemina.app.cli.language import CatalogueWording
from rotemina.app.motion.compared_run import Run
from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.records.entry import Entry, Kind
from rotemina.app.records.run_report import RunReport, report_text
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.comparison.gap import gap_figure, gap_text, moving
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
SAID = {
    "began": "2026-03-04T05:06:07+01:00",
    "model": "corrected-1234",
    "operator": "A. <b>Müller</b>",
    "sample": "oocyte 7",
    "effects": "zn hysteresis",
}


@pytest.fixture(scope="module")
def run():
    time_s = 0.002 * np.arange(500)
    command = 3e-5 + 1e-5 * np.sin(np.pi * time_s) ** 2
    still = np.full(500, 0.0275)
    signals = {
        ("zn", Tap.CMD): command,
        ("zn", Tap.MEAS): command + 1e-6,
        ("x", Tap.CMD): still,
        ("x", Tap.MEAS): still,
    }
    record = Record.from_signals(time_s, signals, {"zn": "m", "x": "m"}, SAID)
    return Run("tour", compare(ROBOT, record), completed=False, model_id="nominal-77")


def plain(page):
    return " ".join(re.sub(r"<[^>]*>", " ", page).split())


def test_a_playback_is_told_with_the_one_gap_and_asks_for_nothing(run, tmp_path):
    entry = Entry(path=tmp_path / "a.csv.gz", kind=Kind.PLAYBACK, name="left: tour", note="dry <i>")
    page = report_text(RunReport.of_run(run, ROBOT, entry))
    text = plain(page)
    gap = gap_text(run.gaps["zn", Tap.MEAS].rms, "m")
    assert f"Largest gap: zn, {gap} (" in text
    assert "Run report: left: tour" in text
    assert "Note: dry &lt;i&gt;" in text
    assert "The run was stopped early." in text
    assert "The figures are from the model nominal-77; corrected-1234 was in use" in text
    for told in ("2026-03-04 05:06:07+01:00", "A. &lt;b&gt;Müller&lt;/b&gt;", "oocyte 7"):
        assert told in text
    assert page.count("<svg") == 1  # x did not move
    assert "<script" not in page
    assert not re.search(r"(?:href|src)\s*=\s*[\"'](?!#)", page)
    assert "Events" not in text


def test_a_recording_has_its_own_models_gap_events_and_penetrations(make_recording, tmp_path):
    path = make_recording(tmp_path / "run.arrows")
    recording = Recording.open(path)
    samples = recording.samples()
    column = recording.axes.index("x")
    figure = gap_figure(
        moving(samples.host_time_s, samples.command),
        samples.measured[:, column],
        samples.model[:, column],
    )
    runs = [
        PenetrationRun(
            started=started,
            robot="RoTeMiNa",
            driver="simulator",
            parameters={},
            verdict=Verdict.FAILED,
            reason="no contact",
            phases=(),
        )
        for started in ("2026-03-04T05:06:08+01:00", "2026-03-04T06:06:08+01:00")
    ]
    report = RunReport.of_recording(path, penetrations=runs)
    assert [one.axis for one in report.courses] == ["x"]
    assert report.courses[0].figure == figure
    assert len(report.penetrations) == 1
    text = plain(report_text(report))
    assert "a note" in text
    assert "failed no contact" in text
    assert f"x {gap_text(figure.rms, 'm')} {gap_text(figure.without_offset, 'm')} –" in text


def test_it_is_german_where_german_is_chosen(run):
    page = report_text(RunReport.of_run(run, ROBOT), CatalogueWording("de"))
    assert '<html lang="de">' in page
    text = plain(page)
    gap = gap_text(run.gaps["zn", Tap.MEAS].rms, "m").replace(".", ",")
    assert f"Größte Abweichung: zn, {gap} (" in text
    assert "Der Lauf wurde vorzeitig angehalten." in text
