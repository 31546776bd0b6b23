"""``rotemina doctor``: lines or JSON, and the exit status."""

import json

import pytest

from rotemina.app import system
from rotemina.app.cli.main import main
from rotemina.app.system import FindingState
from rotemina.app.system.machine_check import CheckFinding

GOOD = CheckFinding("disk", FindingState.GOOD, "70 GB free")
LIMITED = CheckFinding(
    "serial ports", FindingState.LIMITED, "no permission for /dev/ttyUSB0", "ask for it"
)
BROKEN = CheckFinding("Qt platform", FindingState.BROKEN, "Qt does not start", "see there")


@pytest.mark.parametrize(
    ("findings", "status"), [([GOOD], 0), ([GOOD, LIMITED], 0), ([GOOD, BROKEN, LIMITED], 1)]
)
def test_status_says_whether_the_program_runs(monkeypatch, capsys, findings, status):
    monkeypatch.setattr(system, "run_checks", lambda environment: iter(findings))
    assert main(["doctor"]) == status
    output = capsys.readouterr().out
    assert all(finding.seen in output and finding.advice in output for finding in findings)

    assert main(["doctor", "--json"]) == status
    document = json.loads(capsys.readouterr().out)
    assert [entry["state"] for entry in document] == [finding.state for finding in findings]
    assert set(document[0]) == {"name", "state", "seen", "advice"}
