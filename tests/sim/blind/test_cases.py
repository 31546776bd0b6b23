"""Cases: what is in them is there to be found, and labels say no more and no less."""

import json
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from rotemina.sim.blind.case import _beside, draw_case, measured, significant
from rotemina.sim.blind.catalogue import CATALOGUE
from rotemina.sim.blind.effect_sizing import (
    LEAST_BESIDE,
    LEAST_FLOORS,
    OVER_REMAINDER,
    Trial,
    beyond,
)
from rotemina.sim.blind.files import kinds, write_case
from rotemina.sim.blind.force import draw_force_case
from rotemina.sim.blind.remainder import LEAST_SHARE, MOST_SHARE
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")


def test_the_generator_knows_every_effect_of_the_program():
    effects, _ = all_effects()
    theirs = {effect.id: (str(effect.stage), set(effect.kinds)) for effect in effects.values()}
    assert {name: (entry.stage, set(entry.kinds)) for name, entry in CATALOGUE.items()} == theirs


@pytest.mark.slow
@pytest.mark.parametrize("effect", CATALOGUE)
def test_every_effect_makes_a_case_whose_gap_shows(effect):
    case = draw_case(ROBOT, "single", 2, effect)
    (one,) = case.present
    assert one.part.effect == effect
    assert one.part.axis.kind in CATALOGUE[effect].kinds
    assert one.floors >= LEAST_FLOORS
    assert one.part.sizes[0] <= one.part.size <= one.part.sizes[1]


@pytest.mark.parametrize("seed", [9])
def test_two_effects_both_count(seed):
    case = draw_case(ROBOT, "double", seed)
    assert len(case.present) == 2
    assert all(one.floors >= LEAST_FLOORS for one in case.present)
    assert case.label()["verdict"] == "explained"


@pytest.mark.parametrize("seed", [9, 13])
def test_half_of_the_faulty_machines_do_something_that_no_catalogue_holds(seed):
    case = draw_case(ROBOT, "single", seed, "gain_error")
    assert LEAST_SHARE <= case.remainder.share <= MOST_SHARE
    assert all(one.floors >= OVER_REMAINDER * case.remainder.floors for one in case.present)
    assert case.label()["verdict"] == "explained"
    assert case.label()["remainder"]["axis"] == case.present[0].part.axis.name
    assert draw_case(ROBOT, "single", seed + 1, "gain_error").remainder is None
    # The same motion, the same remainder: it is no noise.
    first, again = (case.machine.respond(case.training[0], chance).reading for chance in (1, 2))
    assert np.array_equal(first, again)


def test_a_further_effect_may_be_small_beside_the_first():
    rng = np.random.default_rng(0)
    drawn = [_beside(200.0, rng) for _ in range(500)]
    assert LEAST_BESIDE < min(drawn) < 8.0
    assert max(drawn) > 300.0


def test_a_healthy_machine_stays_within_its_floor():
    for seed in (1, 2, 5):
        case = draw_case(ROBOT, "healthy", seed)
        plain = case.machine.having([])
        assert case.label() == {
            "verdict": "none",
            "effects": [],
            "hidden": [],
            "kind": "healthy",
            "floors": 0.0,
            "remainder": None,
        }
        for number, commands in enumerate(case.training):
            _, reading = measured(case, commands, number)
            gap = reading - plain.respond(commands, 0).reading
            for axis in case.machine.axes:
                assert np.std(gap[:, axis.index]) < 1.15 * axis.floor


def test_the_same_seed_makes_the_same_case_and_another_another():
    first, again, other = (draw_case(ROBOT, "single", seed, "sensor_noise") for seed in (6, 6, 7))
    assert first.label() == again.label() != other.label()
    one, two = (measured(case, case.training[0], 0)[1] for case in (first, again))
    assert np.array_equal(one, two)


def test_a_robot_of_one_axis_gets_cases_that_it_can_have():
    one = replace(ROBOT, axes={"zn": ROBOT.axes["zn"]}, stages={"nano": ("zn",)}, couplings=())
    case = draw_case(one, "single", 1, "backlash")
    assert case.names == ("zn",)
    assert case.present[0].part.effect not in {"backlash", "cross_coupling"}


def test_poor_excitation_hides_its_effect_from_the_label_of_effects():
    label = draw_case(ROBOT, "poor", 2).label()
    assert label["verdict"] == "insufficient_excitation"
    assert label["effects"] == []
    assert len(label["hidden"]) == 1


def test_an_effect_in_no_catalogue_is_unknown():
    label = draw_case(ROBOT, "unknown", 4).label()
    assert label["verdict"] == "unknown"
    assert [effect["effect"] for effect in label["effects"]] == ["unknown"]


def test_files_hold_what_was_applied_and_measured(tmp_path):
    case = draw_case(ROBOT, "single", 9, "amplifier_lag")
    write_case(tmp_path, case, ROBOT)
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == [
        "test_commands.csv.gz",
        "test_measured.csv.gz",
        *(f"train_{k + 1}.csv.gz" for k in range(len(case.training))),
    ]
    for number, commands in enumerate(case.training):
        record = read_record(tmp_path / f"train_{number + 1}.csv.gz", robot=ROBOT)
        _, reading = measured(case, commands, number)
        assert dict(record.metadata) == {"mode": "open_loop"}
        for i, name in enumerate(case.names):
            assert np.allclose(record.signal(name, Tap.CMD), commands.values[:, i], rtol=1e-14)
            assert np.allclose(record.signal(name, Tap.MEAS), reading[:, i], rtol=1e-6)
    asked = read_record(tmp_path / "test_commands.csv.gz", robot=ROBOT)
    assert {column.tap for column in asked.columns} == {Tap.CMD}


def test_an_axis_under_force_is_recorded_in_closed_loop(tmp_path):
    robot = load_robot("emps")
    cases = [draw_force_case(robot, seed) for seed in range(4)]
    assert len({json.dumps(case.label()) for case in cases}) > 1
    write_case(tmp_path, cases[0], robot)
    record = read_record(tmp_path / "train_1.csv.gz", robot=robot)
    assert record.closed_loop
    assert record.has("q", Tap.U)


@pytest.mark.parametrize(
    "seed", [1, *(pytest.param(s, marks=pytest.mark.slow) for s in (17, 19, 23))]
)
def test_each_effect_under_force_is_clear_beside_the_other(seed):
    case = draw_force_case(load_robot("emps"), seed)
    assert case.kind == "double"
    assert min(floors for _, floors in case.present) >= LEAST_BESIDE


def test_more_cases_of_a_seed_begin_with_the_same():
    assert list(kinds(40, 3)) == list(islice(kinds(300, 3), 40))
    drawn = [kind for kind, _, _ in kinds(300, 3)]
    assert drawn.count("healthy") >= 36
    assert {"poor", "unknown", "triple", "parameter", "double", "force"} <= set(drawn)


def test_a_part_out_of_bounds_is_refused():
    case = draw_case(ROBOT, "single", 11, "sensor_noise")
    trial = Trial(case.machine.having([]), case.training, 0)
    assert trial.sized(case.present[0].part, 1e-3) is None


def test_digits_are_those_that_files_show():
    assert significant(np.array([581.77512345, -0.0012345678, 0.0])).tolist() == [
        581.7751,
        -0.001234568,
        0.0,
    ]


def test_what_a_gain_or_another_part_would_do_is_no_effect_of_its_own():
    case = draw_case(ROBOT, "single", 3, "thermal_drift")
    trial = Trial(case.machine.having([]), case.training, 0)
    part = case.present[0].part
    assert trial.distinct([part])
    assert not trial.distinct([part, part.sized(0.5 * part.size)])
    values = np.array([1.0, 2.0, 4.0, 3.0])
    assert np.allclose(beyond(values, [values * 3.0]), 0.0)
    assert np.array_equal(beyond(values, []), values)
