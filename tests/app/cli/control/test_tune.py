"""``rotemina tune`` from the command line."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim import tuning
from rotemina.sim.records import Record, Tap, read_record, write_record
from rotemina.sim.tuning import load_tuning

QUICK_SEARCH = ["--generations", "2", "--population", "12", "--jobs", "1"]
EFFECTS = """
[[axis.zn.effect]]
id = "hysteresis"
"""


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def run_tune(capsys, *options):
    status = main(["tune", "--axis", "zn", "-o", "zn.toml", *QUICK_SEARCH, *options])
    return status, capsys.readouterr()


def test_search_writes_and_prints_a_front(capsys):
    status, output = run_tune(capsys, "--json", "zn.json")
    assert status == 0
    tuning = load_tuning("zn.toml")
    assert tuning.provenance.is_complete
    assert "zn.toml: axis zn, loop at 5000 Hz" in output.out
    assert "recommended" in output.out
    assert len(output.out.splitlines()) == 2 + len(tuning.points)
    document = json.loads(Path("zn.json").read_text("utf-8"))
    assert (
        document["points"][tuning.chosen]["gains"]["integral"] == tuning.chosen_point.gains.integral
    )


def test_json_can_be_printed(capsys):
    _, output = run_tune(capsys, "--json", "-")
    assert json.loads(output.out)["axis"] == "zn"


def test_file_names_effects_and_second_objective(capsys):
    robot = Path(__file__).parents[4] / "resources/robots/rotemina.toml"
    Path("worn.toml").write_text(robot.read_text("utf-8") + EFFECTS, "utf-8")
    assert run_tune(capsys, "--effects", "worn.toml", "--against", "settling")[0] == 0
    provenance = load_tuning("zn.toml").provenance
    assert provenance.effects[0].startswith("hysteresis on zn")
    assert provenance.against == "settling"


def test_point_is_chosen_without_a_search(capsys):
    run_tune(capsys)
    before = load_tuning("zn.toml")
    last = len(before.points) - 1
    assert main(["tune", "-o", "zn.toml", "--choose", str(last)]) == 0
    after = load_tuning("zn.toml")
    assert after == before.with_choice(last)
    assert main(["tune", "-o", "zn.toml", "--choose", "99"]) == 2
    assert f"has points 0 to {last}" in capsys.readouterr().err
    assert load_tuning("zn.toml") == after


def test_unstable_gains_are_not_chosen(capsys):
    run_tune(capsys)
    path = Path("zn.toml")
    document = tomllib.loads(path.read_text("utf-8"))
    integral = str(document["points"][0]["gains"]["integral"])
    path.write_text(path.read_text("utf-8").replace(f"integral = {integral}", "integral = 9e9", 1))
    before = path.read_bytes()
    assert main(["tune", "-o", "zn.toml", "--choose", "0"]) == 2
    assert "unstable" in capsys.readouterr().err
    assert path.read_bytes() == before


def test_tuning_of_another_robot_is_refused(capsys):
    run_tune(capsys)
    assert main(["tune", "-o", "zn.toml", "--choose", "0", "--robot", "picma"]) == 2
    assert "tuned for robot 'RoTeMiNa'" in capsys.readouterr().err


def test_interrupted_search_keeps_its_points_and_reports_it(capsys, monkeypatch):
    run_search = tuning.run_search

    def interrupted_search(*arguments):
        for number, progress in enumerate(run_search(*arguments)):
            if number == 1:
                raise KeyboardInterrupt
            yield progress

    monkeypatch.setattr(tuning, "run_search", interrupted_search)
    status, output = run_tune(capsys, "--generations", "9")
    assert status == 130
    assert "stopped after 1 of 9 generations; zn.toml holds the points found so far" in output.err
    assert load_tuning("zn.toml").provenance.done == 1


def test_interrupt_before_the_first_points_leaves_no_file(capsys, monkeypatch):
    def interrupted_search(*_):
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr(tuning, "run_search", interrupted_search)
    status, _ = run_tune(capsys)
    assert status == 130
    assert not Path("zn.toml").exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--axis", "q"], "no such axis"),
        (["--rate", "900"], "too slow"),
        (["--jobs", "0"], "--jobs 0"),
        (["--generations", "0"], "generations 0"),
        (["--json", "zn.toml"], "named twice"),
        (["-o", "no/zn.toml"], "there is no folder no"),
        (["--inverse", "none.toml"], "none.toml"),
    ],
)
def test_bad_input_is_refused_before_the_search(capsys, options, message):
    status, output = run_tune(capsys, *options)
    assert status == 2
    assert message in output.err
    assert not list(Path().iterdir())


def test_no_input_is_overwritten_through_a_link(capsys):
    robot = Path(__file__).parents[4] / "resources/robots/rotemina.toml"
    for name in ("own.toml", "worn.toml"):
        Path(name).write_text(robot.read_text("utf-8") + EFFECTS, "utf-8")
        Path("link.toml").unlink(missing_ok=True)
        Path("link.toml").symlink_to(name)
        for output in (["-o", "link.toml"], ["--json", "link.toml"]):
            status, streams = run_tune(
                capsys, "--robot", "own.toml", "--effects", "worn.toml", *output
            )
            assert status == 2
            assert "link.toml is named twice" in streams.err
    # Both outputs would be written to a file that does not exist yet.
    Path("late.toml").symlink_to("new.toml")
    status, streams = run_tune(capsys, "-o", "new.toml", "--json", "late.toml")
    assert status == 2
    assert "late.toml is named twice" in streams.err


def test_choosing_a_point_does_not_overwrite_the_tuning_with_json(capsys):
    run_tune(capsys)
    assert main(["tune", "-o", "zn.toml", "--choose", "0", "--json", "./zn.toml"]) == 2
    assert "zn.toml is named twice" in capsys.readouterr().err
    load_tuning("zn.toml")


def test_axis_is_required(capsys):
    assert main(["tune", "-o", "zn.toml"]) == 2
    assert "--axis" in capsys.readouterr().err


def test_tuned_loop_plays_a_trajectory_but_an_unstable_one_does_not(capsys):
    assert run_tune(capsys)[0] == 0
    position = 32e-6 + 15e-6 * np.sin(2.0 * np.pi * 5.0 * 1e-3 * np.arange(400))
    trajectory = Record.from_signals(
        1e-3 * np.arange(400), {("zn", Tap.CMD): position}, {"zn": "m"}
    )
    write_record(trajectory, Path("way.csv"))
    errors = []
    for options in ([], ["--tuning", "zn.toml"]):
        out = f"out{len(errors)}.csv"
        assert main(["play", "way.csv", "-o", out, *options]) == 0
        record = read_record(out)
        errors.append(np.std((record.signal("zn", Tap.MEAS) - position)[50:]))
    assert record.metadata["feedback zn"].startswith("zn.toml, point ")
    assert errors[1] < 0.5 * errors[0]
    text = Path("zn.toml").read_text("utf-8")
    integral = load_tuning("zn.toml").chosen_point.gains.integral
    Path("bad.toml").write_text(text.replace(f"integral = {integral!r}", "integral = 9e3"), "utf-8")
    capsys.readouterr()
    assert main(["play", "way.csv", "-o", "no.csv", "--tuning", "bad.toml"]) == 2
    assert "nothing was applied" in capsys.readouterr().err
    assert not Path("no.csv").exists()
