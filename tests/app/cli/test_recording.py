"""``rotemina recording`` as its users meet it."""

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot


@pytest.fixture
def crashed(tmp_path, monkeypatch):
    """A recording of a move that nobody ended."""
    monkeypatch.chdir(tmp_path)
    clock = VirtualClock(7.0)
    session = MotionSession(Simulator(load_robot("rotemina"), clock=clock))
    session.connect()
    session.run_once()
    recorder = SessionRecorder(session, tmp_path / "run.arrows", clock=clock)
    recorder.start(thread=False)
    for step in range(60):
        if step == 10:
            session.go_to({"x": 0.028})
        clock.advance(0.02)
        session.run_once()
    recorder.writer.run_once()
    recorder.writer._file.close()
    session.close()
    return tmp_path / "run.arrows.part"


def test_recover_then_info(crashed, capsys):
    assert main(["recording", "recover", "run.arrows.part"]) == 0
    assert capsys.readouterr().out == "run.arrows\n"
    assert main(["recording", "info", "run.arrows", "--events"]) == 0
    out = capsys.readouterr().out
    assert "run.arrows: 1.200 s" in out
    assert "1200 of x, y, z, thx, thy, zn" in out
    assert "clock: 60 rows of connection, device_time_s, offset_s, uncertainty_s" in out
    assert "0.220000 state          moving" in out


def test_the_robot_file_in_it_is_printed_to_be_used(crashed, capsys):
    main(["recording", "recover", "run.arrows.part"])
    capsys.readouterr()
    assert main(["recording", "info", "run.arrows", "--robot-file"]) == 0
    crashed.with_name("robot.toml").write_text(capsys.readouterr().out, "utf-8")
    assert load_robot("robot.toml").axes == load_robot("rotemina").axes


def test_a_folder_is_recovered_but_for_what_is_none(crashed, capsys):
    crashed.with_name("bad.arrows.part").write_bytes(b"nothing of ours")
    assert main(["recording", "recover", "."]) == 2
    told = capsys.readouterr()
    assert told.out == "run.arrows\n"
    assert "bad.arrows.part: not an interrupted recording of this program" in told.err
    crashed.with_name("bad.arrows.part").unlink()
    assert main(["recording", "recover", "."]) == 0
    assert "nothing to recover" in capsys.readouterr().out


def test_export_a_record_and_a_trajectory_that_plays(crashed, capsys):
    main(["recording", "recover", "."])
    assert main(["recording", "export", "run.arrows", "-o", "a.csv", "--from", "0.5"]) == 0
    record = read_record("a.csv")
    assert len(record.time_s) == pytest.approx(701, abs=1)
    assert float(record.metadata["recording_from_s"]) == pytest.approx(0.5, abs=1.1e-3)
    assert main(["recording", "export", "run.arrows", "-o", "b.csv", "--trajectory"]) == 0
    again = read_record("b.csv", robot=load_robot("rotemina"))
    assert again.axes == ("x",)
    assert again.signal("x", Tap.CMD)[-1] == 0.028
    assert main(["play", "b.csv", "-o", "c.csv"]) == 0
    played = read_record("c.csv").signal("x", Tap.CMD)
    np.testing.assert_allclose(played, again.signal("x", Tap.CMD), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["info", "none.arrows"], "none.arrows cannot be read"),
        (["info", "run.arrows.part"], "recover it first"),
        (["recover", "none.arrows.part"], "cannot be read"),
        (["export", "run.arrows", "-o", "run.arrows"], "is the input file"),
        (["export", "run.arrows", "-o", "a.csv", "--from", "3"], "no samples in this section"),
        (["export", "run.arrows", "-o", "a.csv", "--from", "2", "--to", "1"], "in order"),
        (["export", "run.arrows", "-o", "a.csv", "--period", "0"], "--period 0"),
        (
            ["export", "run.arrows", "-o", "a.csv", "--trajectory", "--from", "0.25"],
            "axis x moves at the start",
        ),
    ],
)
def test_bad_input_is_one_clear_line(crashed, capsys, arguments, words):
    if "run.arrows" in arguments:
        main(["recording", "recover", "."])
    assert main(["recording", *arguments]) == 2
    err = capsys.readouterr().err
    assert words in err
    assert err.count("\n") == 1
    assert not crashed.with_name("a.csv").exists()


def test_a_report_is_written_of_a_recording_and_of_a_record(crashed, capsys, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(crashed.parent / "data"))
    main(["recording", "recover", "run.arrows.part"])
    assert main(["recording", "report", "run.arrows", "-o", "run.html"]) == 0
    assert capsys.readouterr().out.endswith("run.html\n")
    assert "Run report: run" in crashed.with_name("run.html").read_text("utf-8")
    assert main(["recording", "export", "run.arrows", "-o", "run.csv"]) == 0
    assert main(["recording", "report", "run.csv", "-o", "csv.html"]) == 0
    page = crashed.with_name("csv.html").read_text("utf-8")
    assert page.count("<svg") == 1
    assert main(["recording", "report", "run.csv", "-o", "run.csv"]) == 2
    assert "is the input file" in capsys.readouterr().err
