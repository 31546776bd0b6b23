"""``rotemina tune`` from the command line."""

import json
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim import tuning
from rotemina.sim.records import Record, Tap, read_record, write_record
from rotemina.sim.robot_files import read_robot_file
from rotemina.sim.tuning import load_tuning

QUICK_SEARCH = ["--generations", "2", "--population", "12", "--jobs", "1"]
EFFECTS = """
[[axis.zn.effect]]
id = "hysteresis"
"""


@pytest.fixture(scope="module")
def tuned_file(tmp_path_factory):
    """A file with the points of a search, which takes a second."""
    path = tmp_path_factory.mktemp("tuned") / "zn.toml"
    assert main(["tune", "--axis", "zn", "-o", str(path), *QUICK_SEARCH]) == 0
    return path


@pytest.fixture
def tuned(tuned_file, in_tmp):
    """A copy of these points, ``zn.toml``."""
    shutil.copy(tuned_file, in_tmp / "zn.toml")
    return load_tuning("zn.toml")


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


def test_file_names_effects_and_second_objective(capsys):
    Path("worn.toml").write_text(read_robot_file("rotemina") + EFFECTS, "utf-8")
    options = "--effects", "worn.toml", "--against", "settling", "--json", "-"
    status, output = run_tune(capsys, *options)
    assert status == 0
    assert json.loads(output.out)["axis"] == "zn"
    provenance = load_tuning("zn.toml").provenance
    assert provenance.effects[0].startswith("hysteresis on zn")
    assert provenance.against == "settling"


def test_point_is_chosen_without_a_search(tuned, get_refusal):
    last = len(tuned.points) - 1
    assert main(["tune", "-o", "zn.toml", "--choose", str(last)]) == 0
    assert load_tuning("zn.toml") == tuned.with_choice(last)
    for arguments, message in (
        ("--choose 99", f"has points 0 to {last}"),
        ("--choose 0 --robot picma", "tuned for robot 'RoTeMiNa'"),
        ("--choose 0 --json ./zn.toml", "zn.toml is named twice"),
    ):
        assert message in get_refusal(f"tune -o zn.toml {arguments}")


def test_unstable_gains_are_not_chosen(tuned, get_refusal):
    path = Path("zn.toml")
    document = tomllib.loads(path.read_text("utf-8"))
    integral = str(document["points"][0]["gains"]["integral"])
    path.write_text(path.read_text("utf-8").replace(f"integral = {integral}", "integral = 9e9", 1))
    assert "unstable" in get_refusal("tune -o zn.toml --choose 0")


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
        ("-o zn.toml", "--axis"),
        ("-o zn.toml --axis q", "no such axis"),
        ("-o zn.toml --axis zn --rate 900", "too slow"),
        ("-o zn.toml --axis zn --generations 0", "generations 0"),
        ("-o zn.toml --axis zn --json zn.toml", "named twice"),
        ("-o no/zn.toml --axis zn", "there is no folder no"),
        ("-o zn.toml --axis zn --inverse none.toml", "none.toml"),
    ],
)
def test_bad_input_is_refused_before_the_search(options, message, get_refusal):
    assert message in get_refusal(f"tune {options}")


def test_no_file_is_written_twice_through_a_link(get_refusal):
    search = "tune --axis zn --robot own.toml --effects worn.toml"
    for name in ("own.toml", "worn.toml"):
        Path(name).write_text(read_robot_file("rotemina") + EFFECTS, "utf-8")
    Path("own-link.toml").symlink_to("own.toml")
    Path("worn-link.toml").symlink_to("worn.toml")
    assert "own-link.toml is named twice" in get_refusal(f"{search} -o own-link.toml")
    refusal = get_refusal(f"{search} -o new.toml --json worn-link.toml")
    assert "worn-link.toml is named twice" in refusal
    # Both outputs would be written to a file that does not exist yet.
    Path("late.toml").symlink_to("new.toml")
    refusal = get_refusal("tune --axis zn -o new.toml --json late.toml")
    assert "late.toml is named twice" in refusal


def test_tuned_loop_plays_a_trajectory_but_an_unstable_one_does_not(tuned, get_refusal):
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
    integral = tuned.chosen_point.gains.integral
    Path("bad.toml").write_text(text.replace(f"integral = {integral!r}", "integral = 9e3"), "utf-8")
    assert "nothing was applied" in get_refusal("play way.csv -o no.csv --tuning bad.toml")
