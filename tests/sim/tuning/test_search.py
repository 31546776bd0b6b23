"""The search is repeatable, the same on several cores and stoppable, and its result is a file."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import islice

import pytest

from rotemina.sim.errors import TuningError
from rotemina.sim.tuning import (
    SearchSettings,
    SecondObjective,
    TuningProblem,
    compute_objectives,
    load_tuning,
    make_tuning,
    run_search,
    save_tuning,
)
from rotemina.sim.tuning.search_problem import TuningConstraints

SHORT = SearchSettings(generations=4, population=16, seed=3)


@pytest.fixture(scope="module")
def fast_problem(worn_robot):
    """Problem that simulates one axis instead of five."""
    return TuningProblem(worn_robot, "zn", 5000.0, spread=0.0)


@pytest.fixture(scope="module")
def search_states(fast_problem):
    return list(run_search(fast_problem, SHORT))


def test_points_of_the_front_meet_the_constraints_and_are_not_dominated(
    fast_problem, search_states
):
    assert [state.done for state in search_states] == [1, 2, 3, 4]
    assert search_states[-1].completed_share == 1.0
    front = search_states[-1].front
    assert front
    for point in front:
        assert point.figures.peak_sensitivity <= 1.7
        assert point.figures.overshoot <= fast_problem.constraints.overshoot
        assert point.figures.limited == 0.0
        assert fast_problem.evaluate(point.gains) == point.figures
    scores = [compute_objectives(point.figures, SecondObjective.EFFORT) for point in front]
    assert scores == sorted(scores)
    efforts = [effort for _, effort in scores]
    assert efforts == sorted(efforts, reverse=True)


def test_the_front_never_gets_worse(search_states):
    errors = [state.front[0].figures.tracking_rms for state in search_states if state.front]
    assert errors == sorted(errors, reverse=True)


def test_a_search_is_the_same_on_several_cores(fast_problem, search_states):
    with ThreadPoolExecutor(2) as pool:
        assert list(run_search(fast_problem, SHORT, pool.map)) == search_states


def test_another_seed_finds_another_front(fast_problem, search_states):
    other = next(run_search(fast_problem, replace(SHORT, seed=4)))
    assert other.front != search_states[0].front


def test_a_stopped_search_gives_its_results_so_far(fast_problem, search_states):
    states = list(islice(run_search(fast_problem, SHORT), 2))
    assert states == search_states[:2]
    tuning = make_tuning(fast_problem, SHORT, states[-1])
    assert not tuning.provenance.is_complete
    assert (tuning.provenance.done, tuning.provenance.generations) == (2, 4)
    assert make_tuning(fast_problem, SHORT, search_states[-1]).provenance.is_complete


def test_a_search_without_valid_gains_is_refused(worn_robot):
    strict_problem = TuningProblem(
        worn_robot, "zn", 5000.0, spread=0.0, constraints=TuningConstraints(peak_sensitivity=1.0001)
    )
    settings = replace(SHORT, generations=1, population=4)
    last_state = list(run_search(strict_problem, settings))[-1]
    assert last_state.front == ()
    with pytest.raises(TuningError, match=r"after 1 generations no gains meet Ms ≤ 1\.0001"):
        make_tuning(strict_problem, settings, last_state)


@pytest.mark.parametrize("name", ["generations", "population", "seed"])
def test_invalid_settings_are_refused(name):
    with pytest.raises(TuningError, match=f"{name} -1"):
        SearchSettings(**{name: -1})


def test_a_tuning_is_restored_from_its_file_with_its_provenance(
    fast_problem, search_states, tmp_path
):
    tuning = make_tuning(fast_problem, SHORT, search_states[-1], inverse="zn.npz")
    save_tuning(tuning, tmp_path / "zn.toml")
    restored = load_tuning(tmp_path / "zn.toml")
    assert restored == tuning
    assert restored.chosen_point == tuning.points[tuning.recommended]
    assert restored.provenance.seed == 3
    assert restored.provenance.robot == "RoTeMiNa"
    assert any("hysteresis" in effect for effect in restored.provenance.effects)


def test_another_point_can_be_chosen(fast_problem, search_states):
    tuning = make_tuning(fast_problem, SHORT, search_states[-1])
    last = len(tuning.points) - 1
    assert tuning.with_choice(last).chosen_point == tuning.points[last]
    for index in (-1, last + 1):
        with pytest.raises(TuningError, match=rf"point {index}: the front has points 0 to {last}"):
            tuning.with_choice(index)


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
def test_a_wrong_file_is_refused_with_the_key(
    fast_problem, search_states, tmp_path, old, new, message
):
    path = tmp_path / "zn.toml"
    save_tuning(make_tuning(fast_problem, SHORT, search_states[-1]), path)
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(TuningError, match=message) as refusal:
        load_tuning(path)
    assert str(path) in str(refusal.value)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(TuningError, match="cannot be read"):
        load_tuning(tmp_path / "none.toml")
