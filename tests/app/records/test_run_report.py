"""The self-contained run report of a playback and of a recording, in both languages."""

import re

import numpy as np
import pytest

from rotemina.app.cli.terminal.language import CatalogueWording
from rotemina.app.motion.penetration import PenetrationRun, PenetrationVerdict
from rotemina.app.motion.playback import ComparedRun
from rotemina.app.motion.recording import Recording
from rotemina.app.records import LibraryEntry, RecordKind, RunReport, render_report
from rotemina.sim.comparison import (
    compare,
    compute_gap_figure,
    find_moving_samples,
    format_gap,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
METADATA = {
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
    constant = np.full(500, 0.0275)
    signals = {
        ("zn", Tap.CMD): command,
        ("zn", Tap.MEAS): command + 1e-6,
        ("x", Tap.CMD): constant,
        ("x", Tap.MEAS): constant,
    }
    record = Record.from_signals(time_s, signals, {"zn": "m", "x": "m"}, METADATA)
    return ComparedRun("tour", compare(ROBOT, record), completed=False, model_id="nominal-77")


def strip_tags(page):
    return " ".join(re.sub(r"<[^>]*>", " ", page).split())


def test_report_of_a_playback_is_self_contained_and_has_one_gap(run, tmp_path):
    entry = LibraryEntry(
        path=tmp_path / "a.csv.gz", kind=RecordKind.PLAYBACK, name="left: tour", note="dry <i>"
    )
    page = render_report(RunReport.from_run(run, ROBOT, entry))
    text = strip_tags(page)
    gap = format_gap(run.gaps["zn", Tap.MEAS].rms, "m")
    assert f"Largest gap: zn, {gap} (" in text
    assert "Run report: left: tour" in text
    assert "Note: dry &lt;i&gt;" in text
    assert "The run was stopped early." in text
    assert "The gaps refer to the model nominal-77; corrected-1234 was in use" in text
    for value in ("2026-03-04 05:06:07+01:00", "A. &lt;b&gt;Müller&lt;/b&gt;", "oocyte 7"):
        assert value in text
    assert page.count("<svg") == 1  # x did not move
    assert "<script" not in page
    assert not re.search(r"(?:href|src)\s*=\s*[\"'](?!#)", page)
    assert "Events" not in text


def test_report_of_a_recording_has_gap_events_and_penetrations(make_recording, tmp_path):
    path = make_recording(tmp_path / "run.arrows")
    recording = Recording.open(path)
    samples = recording.read_samples()
    column = recording.axes.index("x")
    figure = compute_gap_figure(
        find_moving_samples(samples.host_time_s, samples.command),
        samples.measured[:, column],
        samples.model[:, column],
    )
    runs = [
        PenetrationRun(
            started=started,
            robot="RoTeMiNa",
            driver="simulator",
            parameters={},
            verdict=PenetrationVerdict.FAILED,
            reason="no contact",
            phases=(),
        )
        for started in ("2026-03-04T05:06:08+01:00", "2026-03-04T06:06:08+01:00")
    ]
    report = RunReport.from_recording(path, penetrations=runs)
    assert [course.axis for course in report.axis_traces] == ["x"]
    assert report.axis_traces[0].figure == figure
    assert len(report.penetrations) == 1
    text = strip_tags(render_report(report))
    assert "a note" in text
    assert "failed no contact" in text
    assert f"x {format_gap(figure.rms, 'm')} {format_gap(figure.without_offset, 'm')} –" in text


def test_report_is_german_with_german_wording(run):
    page = render_report(RunReport.from_run(run, ROBOT), CatalogueWording("de"))
    assert '<html lang="de">' in page
    text = strip_tags(page)
    gap = format_gap(run.gaps["zn", Tap.MEAS].rms, "m").replace(".", ",")
    assert f"Größte Abweichung: zn, {gap} (" in text
    assert "Der Lauf wurde vorzeitig angehalten." in text
