"""The check whether an adapter reaches the baud rate of the boards, on a pseudo-terminal."""

import sys

import pytest

from rotemina.app.cli.machine.board_ports import PseudoTerminal
from rotemina.app.cli.main import main
from rotemina.app.system import FindingState, check_line_rate, line_rate as module

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="other systems do not report the rate"
)


@pytest.fixture
def port(tmp_path):
    terminal = PseudoTerminal(tmp_path / "line")
    yield str(tmp_path / "line")
    terminal.close()


@pytest.mark.parametrize(
    ("actual_baud", "state"), [(115_200, FindingState.LIMITED), (123_000, FindingState.GOOD)]
)
def test_a_different_rate_is_reported(monkeypatch, port, actual_baud, state):
    monkeypatch.setattr(module, "_read_actual_baud", lambda _: actual_baud)
    finding = check_line_rate(port)
    assert finding.state is state
    assert f"{actual_baud} baud at a setting of 125000" in finding.seen
    assert bool(finding.advice) == (state is FindingState.LIMITED)


def test_a_port_that_cannot_be_opened_says_why(tmp_path):
    finding = check_line_rate(str(tmp_path / "nothing"))
    assert finding.state is FindingState.LIMITED
    assert "could not open port" in finding.seen


def test_the_doctor_checks_the_given_ports(monkeypatch, capsys, port):
    assert check_line_rate(port).state is FindingState.GOOD
    monkeypatch.setattr("rotemina.app.system.run_checks", lambda environment: iter(()))
    assert main(["doctor", "--port", port]) == 0
    assert "125000 baud at a setting of 125000" in capsys.readouterr().out
