"""Whether an adapter makes the rate of the boards' line, tried on a pseudo-terminal."""

import sys

import pytest

from rotemina.app import line_rate as module
from rotemina.app.cli.board_ports import PseudoTerminal
from rotemina.app.cli.main import main
from rotemina.app.line_rate import line_rate
from rotemina.app.machine_check import State

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="others do not tell the rate")


@pytest.fixture
def port(tmp_path):
    made = PseudoTerminal(tmp_path / "line")
    yield str(tmp_path / "line")
    made.close()


def test_a_port_that_makes_the_rate_is_good(port):
    found = line_rate(port)
    assert (found.state, found.seen) == (State.GOOD, f"{port}: makes 125000 baud of 125000")


@pytest.mark.parametrize(("made", "state"), [(115_200, State.LIMITED), (123_000, State.GOOD)])
def test_one_that_makes_another_is_told_by_how_much(monkeypatch, port, made, state):
    monkeypatch.setattr(module, "_made", lambda _: made)
    found = line_rate(port)
    assert found.state is state
    assert f"makes {made} baud of 125000" in found.seen
    assert bool(found.advice) == (state is State.LIMITED)


def test_a_port_that_cannot_be_opened_says_why(tmp_path):
    found = line_rate(str(tmp_path / "nothing"))
    assert found.state is State.LIMITED
    assert "could not open port" in found.seen


def test_the_doctor_tries_the_ports_that_it_is_given(monkeypatch, capsys, port):
    monkeypatch.setattr("rotemina.app.machine_check.examine", lambda environment: iter(()))
    assert main(["doctor", "--port", port]) == 0
    assert "makes 125000 baud of 125000" in capsys.readouterr().out
