"""A signal that asks for an end interrupts the command line, and its number is the exit status."""

import signal
import subprocess
import sys

import pytest

from rotemina.app.cli import play
from rotemina.app.cli.main import main
from rotemina.app.cli.termination import interrupted_by_signals, termination_requested


@pytest.fixture
def signalled_play(monkeypatch):
    """Return how to run a command during which a signal arrives."""

    def run(number):
        monkeypatch.setattr(play, "run", lambda _: signal.raise_signal(number))
        return main(["play", "trajectory.csv"])

    return run


@pytest.fixture
def handlers():
    """Restore the handlers that a test replaces."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGHUP)}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_ends_a_command_with_its_own_status(signalled_play, handlers, capsys, name):
    number = signal.Signals[name]
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    before = signal.getsignal(number)
    assert signalled_play(number) == 128 + number
    assert capsys.readouterr().err == "rotemina: interrupted\n"
    assert signal.getsignal(number) is before


def test_a_background_job_of_a_script_can_be_interrupted(signalled_play, handlers):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    assert signalled_play(signal.SIGINT) == 130


def test_a_signal_while_the_subcommands_are_loaded_ends_with_its_status(monkeypatch, capsys):
    monkeypatch.setattr(
        "rotemina.app.cli.main.build_parser", lambda _: signal.raise_signal(signal.SIGTERM)
    )
    assert main(["play", "trajectory.csv"]) == 128 + signal.SIGTERM
    assert capsys.readouterr().err == "rotemina: interrupted\n"


def test_a_signal_that_interrupts_an_exec_ends_with_its_own_status(tmp_path):
    (tmp_path / "signalled_play.py").write_text("""if True:
        import sys
        from rotemina.app.cli import main, play
        program = "import signal; signal.raise_signal(signal.SIGTERM)"
        play.run = lambda _: exec(program)
        sys.exit(main.main(["play", "trajectory.csv"]))
    """)
    command = [sys.executable, "-m", "signalled_play"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 128 + signal.SIGTERM


@pytest.mark.parametrize("context", [interrupted_by_signals, termination_requested])
def test_under_nohup_a_closed_terminal_ends_nothing(handlers, context):
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with context():
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN


def test_a_server_ends_when_its_terminal_closes(handlers):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    with termination_requested() as ended:
        assert not ended()
        signal.raise_signal(signal.SIGHUP)
        assert ended()
