"""Log of runs: appending, reading back, and reading despite a truncated line."""

import json
from dataclasses import asdict, replace

import pytest

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration import (
    PenetrationParameters,
    PenetrationRun,
    PenetrationVerdict,
    RunLog,
)
from rotemina.app.motion.penetration.thrust import MeasuredThrust
from rotemina.sim.errors import FileWriteError

RUN = PenetrationRun(
    started="2026-11-21T00:00:00+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters=asdict(PenetrationParameters()),
    verdict=PenetrationVerdict.DONE,
    reason="",
    phases=(("approach", 0.0), ("done", 2.5)),
    contact=58e-6,
    thrust=MeasuredThrust(50e-6, 1e-7, 0.01, 5e-4, 8e-4, 1000.0),
)


def list_run_values(runs):
    return [(run.verdict, run.reason, run.contact, run.thrust, run.phases) for run in runs]


def test_runs_are_appended_and_read_back(tmp_path):
    log = RunLog(tmp_path / "runs.jsonl")
    other = replace(
        RUN, verdict=PenetrationVerdict.FAILED, reason="no contact within 10 µm", thrust=None
    )
    log.append(RUN)
    log.append(other)
    runs, problems = log.read()
    assert list_run_values(runs) == list_run_values([RUN, other])
    assert problems == ()
    lines = (tmp_path / "runs.jsonl").read_text("utf-8").splitlines()
    assert [json.loads(line)["verdict"] for line in lines] == ["done", "failed"]


def test_a_line_cut_off_by_a_crash_loses_only_that_run(tmp_path):
    path = tmp_path / "runs.jsonl"
    log = RunLog(path)
    log.append(RUN)
    path.write_bytes(path.read_bytes() + RUN.to_json().encode()[:150])
    log.append(RUN)
    runs, problems = log.read()
    assert len(runs) == 2
    assert len(problems) == 1
    assert "line 2" in problems[0]


@pytest.mark.parametrize("line", ["{}", "null", '{"verdict": "odd"}', "{" * 50_000])
def test_a_line_that_is_no_run_is_reported_with_its_number(tmp_path, line):
    path = tmp_path / "runs.jsonl"
    path.write_text(line + "\n", "utf-8")
    runs, problems = RunLog(path).read()
    assert runs == ()
    assert "line 1: not the run of a penetration" in problems[0]


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("contact", "58 µm"),
        ("reason", 3),
        ("parameters", [1]),
        ("thrust", {**asdict(RUN.thrust), "depth": None}),
        ("phases", [["approach", "late"]]),
        ("thrust", 5),
    ],
)
def test_an_invalid_value_is_refused(key, value):
    with pytest.raises(PenetrationError, match="not the run of a penetration"):
        PenetrationRun.from_json(json.dumps({**json.loads(RUN.to_json()), key: value}))


def test_a_path_that_cannot_be_written_or_read_is_refused(tmp_path):
    with pytest.raises(FileWriteError, match="cannot be written"):
        RunLog(tmp_path).append(RUN)
    with pytest.raises(PenetrationError, match="cannot be read"):
        RunLog(tmp_path / "none").read()
