"""``rotemina doctor``: lines or JSON, and the exit status."""

import json

import pytest

from rotemina.app import machine_check
from rotemina.app.cli.main import main
from rotemina.app.machine_check import Finding, State

GOOD = Finding("disk", State.GOOD, "70 GB free")
LIMITED = Finding("serial ports", State.LIMITED, "no permission for /dev/ttyUSB0", "ask for it")
BROKEN = Finding("Qt platform", State.BROKEN, "Qt does not start", "see there")


@pytest.mark.parametrize(
    ("findings", "status"), [([GOOD], 0), ([GOOD, LIMITED], 0), ([GOOD, BROKEN, LIMITED], 1)]
)
def test_status_says_whether_the_program_runs(monkeypatch, capsys, findings, status):
    monkeypatch.setattr(machine_check, "examine", lambda environment: iter(findings))
    assert main(["doctor"]) == status
    said = capsys.readouterr().out
    assert all(one.seen in said and one.advice in said for one in findings)

    assert main(["doctor", "--json"]) == status
    read = json.loads(capsys.readouterr().out)
    assert [one["state"] for one in read] == [one.state for one in findings]
    assert set(read[0]) == {"name", "state", "seen", "advice"}


@pytest.mark.slow  # starts Qt in a process of its own
def test_this_machine_runs_the_program(capsys):
    status = main(["doctor", "--json"])
    read = {one["name"]: one for one in json.loads(capsys.readouterr().out)}
    assert status == 0, read
    assert {"Python", "dependencies", "Qt platform", "rendering", "clock"} <= set(read)
