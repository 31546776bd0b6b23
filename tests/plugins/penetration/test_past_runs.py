"""Runs as rows and in full; which are shown."""

import json
from dataclasses import asdict, replace
from datetime import UTC, datetime

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.app.motion.penetration.thrust import ThrustMeasured
from rotemina.plugins.penetration.past_runs import COLUMN_TIPS, COLUMNS, MOST, RunList, in_full, row

NOW = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
RUN = PenetrationRun(
    started="2026-11-21T10:00:05+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters=asdict(
        PenetrationParameters(shape="table", table=((0.0, 0.0), (0.5, 0.2), (1.0, 1.0)))
    ),
    verdict=Verdict.DONE,
    reason="",
    phases=(("approach", 0.0), ("done", 2.5)),
    contact=58e-6,
    contact_height=0.0401234,
    noise_rms=1.22e-8,
    gave_way=False,
    thrust=ThrustMeasured(4.95e-5, 3e-7, 2e-3, 5.5e-4, 8.1e-4, 1000.0),
)


def numbered(count, start=0):
    return [replace(RUN, started=f"run {n}") for n in range(start, start + count)]


def test_a_row_has_the_figures_with_their_units():
    assert row(RUN, NOW) == (
        "10:00:05", "done", "40.1234 mm", "49.50 µm", "550 µm/s", "810 µm/s", "0.30 µm", "",
    )  # fmt: skip
    assert len(COLUMNS) == len(COLUMN_TIPS) == len(row(RUN, NOW))
    failed = replace(
        RUN, started="2026-11-20T23:00:00+00:00", verdict=Verdict.FAILED, reason="no contact",
        thrust=None, contact=None, contact_height=None,
    )  # fmt: skip
    assert row(failed, NOW) == ("2026-11-20 23:00", "failed", *("–",) * 5, "no contact")
    assert row(replace(RUN, contact_height=None), NOW)[2] == "58.00 µm"
    assert row(replace(RUN, started="yesterday"), NOW)[0] == "yesterday"


def test_all_of_a_run_is_told_also_when_it_comes_from_the_file():
    read = PenetrationRun.parsed(RUN.line())
    assert in_full(read) == in_full(RUN)
    text = in_full(read)
    for line in (
        "   2.500 s  done",
        "contact, height of the tip: 40.1234 mm",
        "noise, rms: 12.2 nm",
        "membrane ruptured: no",
        "error against the profile: 0.30 µm",
        "thrust, depth: 50 µm",
        "table: [[0.0, 0.0], [0.5, 0.2], [1.0, 1.0]]",
        "shape: table",
    ):
        assert line in text.splitlines()
    assert "contact detected after" not in text  # nobody knows


def test_a_strange_line_of_the_file_is_shown_as_it_is():
    table = json.loads(RUN.line())
    table["parameters"] = {"depth": "much", "table": [[0, 0], 5], "x": "<b>"}
    text = in_full(PenetrationRun.parsed(json.dumps(table)))
    assert "depth: much" in text
    assert "x: <b>" in text


def test_the_latest_are_shown_first_and_each_once():
    shown = RunList()
    shown.take_file(numbered(60))
    assert len(shown.runs) == MOST
    assert shown.runs[0].started == "run 59"
    latest = replace(RUN, started="run 60", verdict=Verdict.HELD)
    assert shown.take_latest(latest)
    assert not shown.take_latest(latest)
    assert not shown.take_latest(None)
    retracted = replace(latest, verdict=Verdict.ABORTED, phases=(*RUN.phases, ("aborted", 9.0)))
    assert shown.take_latest(retracted)  # held first, then brought back: a line for each
    assert [run.verdict for run in shown.runs[:3]] == ["aborted", "held", "done"]
    assert (len(shown.runs), shown.of_this_start) == (MOST, 2)


def test_runs_that_end_while_the_file_is_read_are_not_doubled():
    shown = RunList()
    (latest,) = numbered(1, 5)
    shown.take_latest(latest)
    shown.take_file(numbered(6))
    assert [run.started for run in shown.runs] == [f"run {n}" for n in (5, 4, 3, 2, 1, 0)]
