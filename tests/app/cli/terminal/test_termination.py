"""A termination signal interrupts the command line and determines the exit status."""

import signal
import subprocess
import sys

import pytest

from rotemina.app.cli.main import main
from rotemina.app.cli.records import play
from rotemina.app.cli.terminal import interrupt_on_signals, watch_termination


@pytest.fixture
def play_with_signal(monkeypatch):
    """Function that runs a command during which a signal arrives."""

    def run(number):
        monkeypatch.setattr(play, "run", lambda _: signal.raise_signal(number))
        return main(["play", "trajectory.csv"])

    return run


@pytest.fixture
def restored_handlers():
    """Restore the handlers that a test replaces."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGHUP)}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_signal_ends_a_command_with_its_own_status(
    play_with_signal, restored_handlers, capsys, name
):
    number = signal.Signals[name]
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    before = signal.getsignal(number)
    assert play_with_signal(number) == 128 + number
    assert capsys.readouterr().err == "rotemina: interrupted\n"
    assert signal.getsignal(number) is before


def test_a_background_job_of_a_script_can_be_interrupted(play_with_signal, restored_handlers):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    assert play_with_signal(signal.SIGINT) == 130


def test_signal_during_loading_of_subcommands_ends_with_its_status(monkeypatch, capsys):
    monkeypatch.setattr(
        "rotemina.app.cli.main.build_parser", lambda _: signal.raise_signal(signal.SIGTERM)
    )
    assert main(["play", "trajectory.csv"]) == 128 + signal.SIGTERM
    assert capsys.readouterr().err == "rotemina: interrupted\n"


def test_signal_during_exec_ends_with_its_own_status(tmp_path):
    (tmp_path / "signalled_play.py").write_text("""if True:
        import sys
        from rotemina.app.cli import main
        from rotemina.app.cli.records import play
        program = "import signal; signal.raise_signal(signal.SIGTERM)"
        play.run = lambda _: exec(program)
        sys.exit(main.main(["play", "trajectory.csv"]))
    """)
    command = [sys.executable, "-m", "signalled_play"]
    process = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert process.returncode == 128 + signal.SIGTERM


@pytest.mark.parametrize("context", [interrupt_on_signals, watch_termination])
def test_closed_terminal_is_ignored_under_nohup(restored_handlers, context):
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with context():
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN


def test_server_ends_when_its_terminal_closes(restored_handlers):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    with watch_termination() as is_terminated:
        assert not is_terminated()
        signal.raise_signal(signal.SIGHUP)
        assert is_terminated()
