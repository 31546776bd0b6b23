"""The search: repeatable, the same on several cores, stopped at any time; and its file."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import islice

import pytest

from rotemina.sim.tuning.errors import TuningError
from rotemina.sim.tuning.objectives import Constraints, SecondObjective
from rotemina.sim.tuning.search import SearchSettings, generations, objectives_of
from rotemina.sim.tuning.search_problem import TuningProblem
from rotemina.sim.tuning.tuning_result import load_tuning, save_tuning, tuning_of

SHORT = SearchSettings(generations=4, population=16, seed=3)


@pytest.fixture(scope="module")
def fast(worn):
    """One axis instead of five."""
    return TuningProblem(worn, "zn", 5000.0, spread=0.0)


@pytest.fixture(scope="module")
def done(fast):
    return list(generations(fast, SHORT))


def test_a_front_holds_points_that_keep_the_constraints_and_that_none_dominates(fast, done):
    assert [one.done for one in done] == [1, 2, 3, 4]
    assert done[-1].share == 1.0
    front = done[-1].front
    assert front
    for point in front:
        assert point.figures.peak_sensitivity <= 1.7
        assert point.figures.overshoot <= fast.constraints.overshoot
        assert point.figures.limited == 0.0
        assert fast.evaluate(point.gains) == point.figures
    scores = [objectives_of(point.figures, SecondObjective.EFFORT) for point in front]
    assert scores == sorted(scores)
    efforts = [effort for _, effort in scores]
    assert efforts == sorted(efforts, reverse=True)


def test_the_front_never_gets_worse(done):
    best = [one.front[0].figures.tracking_rms for one in done if one.front]
    assert best == sorted(best, reverse=True)


def test_a_search_is_the_same_on_several_cores(fast, done):
    with ThreadPoolExecutor(2) as pool:
        assert list(generations(fast, SHORT, pool.map)) == done


def test_another_seed_searches_elsewhere(fast, done):
    other = next(generations(fast, replace(SHORT, seed=4)))
    assert other.front != done[0].front


def test_a_search_that_is_stopped_gives_what_it_found(fast, done):
    stopped = list(islice(generations(fast, SHORT), 2))
    assert stopped == done[:2]
    tuning = tuning_of(fast, SHORT, stopped[-1])
    assert not tuning.provenance.whole
    assert (tuning.provenance.done, tuning.provenance.generations) == (2, 4)
    assert tuning_of(fast, SHORT, done[-1]).provenance.whole


def test_without_a_point_nothing_is_recommended(worn):
    strict = TuningProblem(
        worn, "zn", 5000.0, spread=0.0, constraints=Constraints(peak_sensitivity=1.0001)
    )
    settings = replace(SHORT, generations=1, population=4)
    last = list(generations(strict, settings))[-1]
    assert last.front == ()
    with pytest.raises(TuningError, match=r"after 1 generations no gains keep Ms ≤ 1\.0001"):
        tuning_of(strict, settings, last)


@pytest.mark.parametrize("name", ["generations", "population", "seed"])
def test_settings_that_are_none_are_refused(name):
    with pytest.raises(TuningError, match=f"{name} -1"):
        SearchSettings(**{name: -1})


def test_a_tuning_survives_its_file_and_tells_where_it_is_from(fast, done, tmp_path):
    tuning = tuning_of(fast, SHORT, done[-1], inverse="zn.npz")
    save_tuning(tuning, tmp_path / "zn.toml")
    read = load_tuning(tmp_path / "zn.toml")
    assert read == tuning
    assert read.best == tuning.points[tuning.recommended]
    assert read.provenance.seed == 3
    assert read.provenance.robot == "RoTeMiNa"
    assert any("hysteresis" in effect for effect in read.provenance.effects)


def test_another_point_can_be_chosen(fast, done):
    tuning = tuning_of(fast, SHORT, done[-1])
    last = len(tuning.points) - 1
    assert tuning.choosing(last).best == tuning.points[last]
    for wrong in (-1, last + 1):
        with pytest.raises(TuningError, match=rf"point {wrong}: the front has points 0 to {last}"):
            tuning.choosing(wrong)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("rate_hz", "rat_hz", "rat_hz"),
        ('axis = "zn"', "axis = 7", r"axis = 7"),
        ("chosen = ", "chosen = 9", "chosen = 9"),
        ("integral = ", "integral = -", "integral -"),
        ("integral = ", "integrale = ", "integrale"),
        ("rotemina-tuning 1", "rotemina-tuning 9", "format = 'rotemina-tuning 9'"),
        ("delay = 0", "delay = [", "not valid TOML"),
    ],
)
def test_a_file_that_is_wrong_is_refused_with_the_key(fast, done, tmp_path, old, new, message):
    path = tmp_path / "zn.toml"
    save_tuning(tuning_of(fast, SHORT, done[-1]), path)
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(TuningError, match=message) as refused:
        load_tuning(path)
    assert str(path) in str(refused.value)


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(TuningError, match="cannot be read"):
        load_tuning(tmp_path / "none.toml")
