"""``rotemina recording`` from the command line."""

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.app.motion.recording import SessionRecorder
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.records import Tap, read_record
from rotemina.sim.robot_files import load_robot


@pytest.fixture
def unfinished_recording(tmp_path):
    """The unfinished recording that remains of a move after a crash."""
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


def test_recover_then_info(unfinished_recording, capsys):
    assert main(["recording", "recover", "run.arrows.part"]) == 0
    assert capsys.readouterr().out == "run.arrows\n"
    assert main(["recording", "info", "run.arrows", "--events"]) == 0
    out = capsys.readouterr().out
    assert "run.arrows: 1.200 s" in out
    assert "1200 of x, y, z, thx, thy, zn" in out
    assert "clock: 60 rows of connection, device_time_s, offset_s, uncertainty_s" in out
    assert "0.220000 state          moving" in out

    assert main(["recording", "info", "run.arrows", "--robot-file"]) == 0
    unfinished_recording.with_name("robot.toml").write_text(capsys.readouterr().out, "utf-8")
    assert load_robot("robot.toml").axes == load_robot("rotemina").axes


def test_recover_reports_invalid_files_of_a_folder(unfinished_recording, capsys):
    unfinished_recording.with_name("bad.arrows.part").write_bytes(b"nothing of ours")
    assert main(["recording", "recover", "."]) == 2
    output = capsys.readouterr()
    assert output.out == "run.arrows\n"
    assert "bad.arrows.part: not an interrupted recording of this program" in output.err
    unfinished_recording.with_name("bad.arrows.part").unlink()
    assert main(["recording", "recover", "."]) == 0
    assert "nothing to recover" in capsys.readouterr().out


def test_exported_record_is_readable_and_exported_trajectory_plays(unfinished_recording, capsys):
    main(["recording", "recover", "."])
    assert main(["recording", "export", "run.arrows", "-o", "a.csv", "--from", "0.5"]) == 0
    record = read_record("a.csv")
    assert len(record.time_s) == pytest.approx(701, abs=1)
    assert float(record.metadata["recording_from_s"]) == pytest.approx(0.5, abs=1.1e-3)
    assert main(["recording", "export", "run.arrows", "-o", "b.csv", "--trajectory"]) == 0
    trajectory = read_record("b.csv", robot=load_robot("rotemina"))
    assert trajectory.axes == ("x",)
    assert trajectory.signal("x", Tap.CMD)[-1] == 0.028
    assert main(["play", "b.csv", "-o", "c.csv"]) == 0
    played_commands = read_record("c.csv").signal("x", Tap.CMD)
    np.testing.assert_allclose(played_commands, trajectory.signal("x", Tap.CMD), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("info none.arrows", "none.arrows cannot be read"),
        ("info run.arrows.part", "recover it first"),
        ("recover none.arrows.part", "cannot be read"),
        ("export run.arrows -o run.arrows", "is the input file"),
        ("report run.arrows -o run.arrows", "is the input file"),
        ("export run.arrows -o a.csv --from 3", "no samples in this section"),
        ("export run.arrows -o a.csv --from 2 --to 1", "in order"),
        ("export run.arrows -o a.csv --period 0", "--period 0"),
        ("export run.arrows -o a.csv --trajectory --from 0.25", "axis x moves at the start"),
    ],
)
def test_bad_input_is_refused(unfinished_recording, get_refusal, arguments, message):
    if "run.arrows " in arguments:
        main(["recording", "recover", "."])
    assert message in get_refusal(f"recording {arguments}")


def test_report_of_a_recording_and_of_a_record(unfinished_recording, capsys, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(unfinished_recording.parent / "data"))
    main(["recording", "recover", "run.arrows.part"])
    assert main(["recording", "report", "run.arrows", "-o", "run.html"]) == 0
    assert capsys.readouterr().out.endswith("run.html\n")
    assert "Run report: run" in unfinished_recording.with_name("run.html").read_text("utf-8")
    assert main(["recording", "export", "run.arrows", "-o", "run.csv"]) == 0
    assert main(["recording", "report", "run.csv", "-o", "csv.html"]) == 0
    page = unfinished_recording.with_name("csv.html").read_text("utf-8")
    assert page.count("<svg") == 1
