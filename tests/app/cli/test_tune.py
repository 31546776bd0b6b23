"""``rotemina tune`` as its users meet it."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.tuning import search
from rotemina.sim.tuning.tuning_result import load_tuning

SHORT = ["--generations", "2", "--population", "12", "--jobs", "1"]
EFFECTS = """
[[axis.zn.effect]]
id = "hysteresis"
"""


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def tuned(capsys, *more):
    status = main(["tune", "--axis", "zn", "-o", "zn.toml", *SHORT, *more])
    return status, capsys.readouterr()


def test_a_search_writes_a_front_and_tells_it(capsys):
    status, said = tuned(capsys, "--json", "zn.json")
    assert status == 0
    tuning = load_tuning("zn.toml")
    assert tuning.provenance.whole
    assert "zn.toml: axis zn, loop at 5000 Hz" in said.out
    assert "recommended" in said.out
    assert len(said.out.splitlines()) == 2 + len(tuning.points)
    document = json.loads(Path("zn.json").read_text("utf-8"))
    assert document["points"][tuning.chosen]["gains"]["integral"] == tuning.best.gains.integral


def test_json_can_be_printed(capsys):
    _, said = tuned(capsys, "--json", "-")
    assert json.loads(said.out)["axis"] == "zn"


def test_effects_and_the_second_objective_are_told_in_the_file(capsys):
    robot = Path(__file__).parents[3] / "resources/robots/rotemina.toml"
    Path("worn.toml").write_text(robot.read_text("utf-8") + EFFECTS, "utf-8")
    assert tuned(capsys, "--effects", "worn.toml", "--against", "settling")[0] == 0
    provenance = load_tuning("zn.toml").provenance
    assert provenance.effects[0].startswith("hysteresis on zn")
    assert provenance.against == "settling"


def test_a_point_is_chosen_without_a_search(capsys):
    tuned(capsys)
    before = load_tuning("zn.toml")
    last = len(before.points) - 1
    assert main(["tune", "-o", "zn.toml", "--choose", str(last)]) == 0
    after = load_tuning("zn.toml")
    assert after == before.choosing(last)
    assert main(["tune", "-o", "zn.toml", "--choose", "99"]) == 2
    assert f"has points 0 to {last}" in capsys.readouterr().err
    assert load_tuning("zn.toml") == after


def test_unstable_gains_are_not_chosen(capsys):
    tuned(capsys)
    path = Path("zn.toml")
    document = tomllib.loads(path.read_text("utf-8"))
    wild = str(document["points"][0]["gains"]["integral"])
    path.write_text(path.read_text("utf-8").replace(f"integral = {wild}", "integral = 9e9", 1))
    before = path.read_bytes()
    assert main(["tune", "-o", "zn.toml", "--choose", "0"]) == 2
    assert "unstable" in capsys.readouterr().err
    assert path.read_bytes() == before


def test_a_tuning_is_not_for_another_robot(capsys):
    tuned(capsys)
    assert main(["tune", "-o", "zn.toml", "--choose", "0", "--robot", "picma"]) == 2
    assert "tuned for robot 'RoTeMiNa'" in capsys.readouterr().err


def test_an_interrupt_keeps_what_was_found_and_says_so(capsys, monkeypatch):
    whole = search.generations

    def interrupted(*arguments):
        for number, one in enumerate(whole(*arguments)):
            if number == 1:
                raise KeyboardInterrupt
            yield one

    monkeypatch.setattr(search, "generations", interrupted)
    status, said = tuned(capsys, "--generations", "9")
    assert status == 130
    assert "stopped after 1 of 9 generations; zn.toml holds the points found so far" in said.err
    assert load_tuning("zn.toml").provenance.done == 1


def test_an_interrupt_before_anything_was_found_leaves_no_file(capsys, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr(search, "generations", interrupted)
    status, _ = tuned(capsys)
    assert status == 130
    assert not Path("zn.toml").exists()


@pytest.mark.parametrize(
    ("given", "message"),
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
def test_bad_input_is_told_before_any_work(capsys, given, message):
    status, said = tuned(capsys, *given)
    assert status == 2
    assert message in said.err
    assert not list(Path().iterdir())


def test_an_axis_is_needed(capsys):
    assert main(["tune", "-o", "zn.toml"]) == 2
    assert "--axis" in capsys.readouterr().err


def test_a_tuned_loop_plays_a_trajectory_and_one_that_is_not_stable_does_not(capsys):
    assert tuned(capsys)[0] == 0
    path = 32e-6 + 15e-6 * np.sin(2.0 * np.pi * 5.0 * 1e-3 * np.arange(400))
    way = Record.from_signals(1e-3 * np.arange(400), {("zn", Tap.CMD): path}, {"zn": "m"})
    write_record(way, Path("way.csv"))
    errors = []
    for more in ([], ["--tuning", "zn.toml"]):
        out = f"out{len(errors)}.csv"
        assert main(["play", "way.csv", "-o", out, *more]) == 0
        record = read_record(out)
        errors.append(np.std((record.signal("zn", Tap.MEAS) - path)[50:]))
    assert record.metadata["feedback zn"].startswith("zn.toml, point ")
    assert errors[1] < 0.5 * errors[0]
    text = Path("zn.toml").read_text("utf-8")
    chosen = load_tuning("zn.toml").best.gains.integral
    Path("bad.toml").write_text(text.replace(f"integral = {chosen!r}", "integral = 9e3"), "utf-8")
    capsys.readouterr()
    assert main(["play", "way.csv", "-o", "no.csv", "--tuning", "bad.toml"]) == 2
    assert "nothing was applied" in capsys.readouterr().err
    assert not Path("no.csv").exists()
