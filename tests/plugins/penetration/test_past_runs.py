"""The list of past runs: rows, full descriptions, and which runs are listed."""

import json
from dataclasses import asdict, replace
from datetime import UTC, datetime

from rotemina.app.motion.penetration import (
    PenetrationParameters,
    PenetrationRun,
    PenetrationVerdict,
)
from rotemina.app.motion.penetration.thrust import MeasuredThrust
from rotemina.plugins.penetration.past_runs import (
    COLUMN_TIPS,
    COLUMN_TITLES,
    MAX_RUNS,
    PastRunList,
    describe_run,
    make_run_row,
)

NOW = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
RUN = PenetrationRun(
    started="2026-11-21T10:00:05+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters=asdict(
        PenetrationParameters(shape="table", table=((0.0, 0.0), (0.5, 0.2), (1.0, 1.0)))
    ),
    verdict=PenetrationVerdict.DONE,
    reason="",
    phases=(("approach", 0.0), ("done", 2.5)),
    contact=58e-6,
    contact_height=0.0401234,
    noise_rms=1.22e-8,
    gave_way=False,
    thrust=MeasuredThrust(4.95e-5, 3e-7, 2e-3, 5.5e-4, 8.1e-4, 1000.0),
)


def make_runs(count, start=0):
    return [replace(RUN, started=f"run {n}") for n in range(start, start + count)]


def test_a_row_shows_the_figures_with_their_units():
    assert make_run_row(RUN, NOW) == (
        "10:00:05", "done", "40.1234 mm", "49.50 µm", "550 µm/s", "810 µm/s", "0.30 µm", "",
    )  # fmt: skip
    assert len(COLUMN_TITLES) == len(COLUMN_TIPS) == len(make_run_row(RUN, NOW))
    failed = replace(
        RUN, started="2026-11-20T23:00:00+00:00", verdict=PenetrationVerdict.FAILED,
        reason="no contact", thrust=None, contact=None, contact_height=None,
    )  # fmt: skip
    assert make_run_row(failed, NOW) == ("2026-11-20 23:00", "failed", *("–",) * 5, "no contact")
    assert make_run_row(replace(RUN, contact_height=None), NOW)[2] == "58.00 µm"
    assert make_run_row(replace(RUN, started="yesterday"), NOW)[0] == "yesterday"


def test_a_run_read_from_the_file_is_described_in_full():
    read = PenetrationRun.from_json(RUN.to_json())
    assert describe_run(read) == describe_run(RUN)
    text = describe_run(read)
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
    assert "contact detected after" not in text  # the time was not measured


def test_unexpected_parameters_of_a_file_are_shown_as_they_are():
    document = json.loads(RUN.to_json())
    document["parameters"] = {"depth": "much", "table": [[0, 0], 5], "x": "<b>"}
    text = describe_run(PenetrationRun.from_json(json.dumps(document)))
    assert "depth: much" in text
    assert "x: <b>" in text


def test_the_latest_runs_are_listed_first_and_once():
    run_list = PastRunList()
    run_list.add_logged(make_runs(60))
    assert len(run_list.runs) == MAX_RUNS
    assert run_list.runs[0].started == "run 59"
    latest = replace(RUN, started="run 60", verdict=PenetrationVerdict.HELD)
    assert run_list.add_latest(latest)
    assert not run_list.add_latest(latest)
    assert not run_list.add_latest(None)
    retracted = replace(
        latest, verdict=PenetrationVerdict.ABORTED, phases=(*RUN.phases, ("aborted", 9.0))
    )
    assert run_list.add_latest(retracted)  # a held and then retracted run has two rows
    assert [run.verdict for run in run_list.runs[:3]] == ["aborted", "held", "done"]
    assert (len(run_list.runs), run_list.new_run_count) == (MAX_RUNS, 2)


def test_runs_that_end_while_the_file_is_read_are_not_duplicated():
    run_list = PastRunList()
    run_list.add_latest(*make_runs(1, 5))
    run_list.add_logged(make_runs(6))
    assert [run.started for run in run_list.runs] == [f"run {n}" for n in (5, 4, 3, 2, 1, 0)]
