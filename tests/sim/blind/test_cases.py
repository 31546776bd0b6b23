"""Blind cases: each one contains the effects of its label, large enough to be found."""

import json
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from rotemina.sim.blind import draw_case, draw_force_case, draw_kinds, write_case
from rotemina.sim.blind.case import simulate_record
from rotemina.sim.blind.catalogue import CATALOGUE
from rotemina.sim.blind.effect_sizing import (
    MIN_EFFECT_TO_REMAINDER_RATIO,
    MIN_FLOORS,
    MIN_FLOORS_IF_SEVERAL,
    SizingTrial,
    remove_shapes,
)
from rotemina.sim.blind.remainder import MAX_REMAINDER_SHARE, MIN_REMAINDER_SHARE
from rotemina.sim.effects import load_all_effects
from rotemina.sim.records import Tap, read_record
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def test_the_catalogue_contains_every_effect_of_the_program():
    effects, _ = load_all_effects()
    program_effects = {
        effect.id: (str(effect.stage), set(effect.kinds)) for effect in effects.values()
    }
    assert {
        name: (entry.stage, set(entry.kinds)) for name, entry in CATALOGUE.items()
    } == program_effects


@pytest.mark.slow
@pytest.mark.parametrize("effect", CATALOGUE)
def test_a_case_of_each_effect_has_a_visible_gap(effect):
    case = draw_case(ROBOT, "single", 2, effect)
    (present_effect,) = case.present_effects
    assert present_effect.part.effect == effect
    assert present_effect.part.axis.kind in CATALOGUE[effect].kinds
    assert present_effect.floors >= MIN_FLOORS
    assert present_effect.part.sizes[0] <= present_effect.part.size <= present_effect.part.sizes[1]


def test_both_effects_of_a_double_case_exceed_the_noise_floor():
    case = draw_case(ROBOT, "double", 9)
    assert len(case.present_effects) == 2
    assert all(present_effect.floors >= MIN_FLOORS for present_effect in case.present_effects)
    assert case.label()["verdict"] == "explained"


def test_half_of_the_faulty_machines_have_a_remainder_outside_the_catalogue():
    case = draw_case(ROBOT, "single", 9, "gain_error")
    assert MIN_REMAINDER_SHARE <= case.remainder.share <= MAX_REMAINDER_SHARE
    assert all(
        present_effect.floors >= MIN_EFFECT_TO_REMAINDER_RATIO * case.remainder.floors
        for present_effect in case.present_effects
    )
    assert case.label()["verdict"] == "explained"
    assert case.label()["remainder"]["axis"] == case.present_effects[0].part.axis.name
    assert draw_case(ROBOT, "single", 10, "gain_error").remainder is None
    # The same motion leaves the same remainder, so it is not noise.
    first, again = (case.machine.respond(case.training[0], chance).reading for chance in (1, 2))
    assert np.array_equal(first, again)


def test_a_healthy_machine_stays_within_its_noise_floor():
    for seed in (1, 5):
        case = draw_case(ROBOT, "healthy", seed)
        nominal = case.machine.with_parts([])
        assert case.label() == {
            "verdict": "none",
            "effects": [],
            "hidden": [],
            "kind": "healthy",
            "floors": 0.0,
            "remainder": None,
        }
        for number, commands in enumerate(case.training):
            _, reading = simulate_record(case, commands, number)
            gap = reading - nominal.respond(commands, 0).reading
            for axis in case.machine.axes:
                assert np.std(gap[:, axis.index]) < 1.15 * axis.floor


@pytest.fixture(scope="module")
def noisy_case():
    return draw_case(ROBOT, "single", 6, "sensor_noise")


def test_the_same_seed_makes_the_same_case_and_another_seed_a_different_one(noisy_case):
    first = noisy_case
    repeated, other = (draw_case(ROBOT, "single", seed, "sensor_noise") for seed in (6, 7))
    assert first.label() == repeated.label() != other.label()
    first_reading, second_reading = (
        simulate_record(case, case.training[0], 0)[1] for case in (first, repeated)
    )
    assert np.array_equal(first_reading, second_reading)


def test_a_robot_with_one_axis_gets_only_effects_of_one_axis():
    robot = replace(ROBOT, axes={"zn": ROBOT.axes["zn"]}, stages={"nano": ("zn",)}, couplings=())
    case = draw_case(robot, "single", 1, "backlash")
    assert case.axis_names == ("zn",)
    assert case.present_effects[0].part.effect not in {"backlash", "cross_coupling"}


def test_labels_of_poor_excitation_and_of_an_effect_outside_the_catalogue():
    poor = draw_case(ROBOT, "poor", 2).label()
    assert (poor["verdict"], poor["effects"]) == ("insufficient_excitation", [])
    assert len(poor["hidden"]) == 1
    unknown = draw_case(ROBOT, "unknown", 4).label()
    assert unknown["verdict"] == "unknown"
    assert [effect["effect"] for effect in unknown["effects"]] == ["unknown"]


def test_files_contain_the_applied_commands_and_the_readings(tmp_path):
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
        _, reading = simulate_record(case, commands, number)
        assert dict(record.metadata) == {"mode": "open_loop"}
        for i, name in enumerate(case.axis_names):
            assert np.allclose(record.signal(name, Tap.CMD), commands.values[:, i], rtol=1e-14)
            assert np.allclose(record.signal(name, Tap.MEAS), reading[:, i], rtol=1e-6)
    test_commands = read_record(tmp_path / "test_commands.csv.gz", robot=ROBOT)
    assert {column.tap for column in test_commands.columns} == {Tap.CMD}


@pytest.fixture(scope="module")
def force_cases():
    return [draw_force_case(load_robot("emps"), seed) for seed in (0, 1)]


def test_an_axis_under_force_is_recorded_in_closed_loop(force_cases, tmp_path):
    robot = load_robot("emps")
    assert len({json.dumps(case.label()) for case in force_cases}) > 1
    write_case(tmp_path, force_cases[0], robot)
    record = read_record(tmp_path / "train_1.csv.gz", robot=robot)
    assert record.closed_loop
    assert record.has("q", Tap.U)


def test_each_effect_under_force_exceeds_the_noise_floor(force_cases):
    assert force_cases[1].kind == "double"
    assert min(floors for _, floors in force_cases[1].present_effects) >= MIN_FLOORS_IF_SEVERAL


def test_a_longer_series_of_a_seed_begins_with_the_shorter_one():
    assert list(draw_kinds(40, 3)) == list(islice(draw_kinds(300, 3), 40))
    kinds = [kind for kind, _, _ in draw_kinds(300, 3)]
    assert kinds.count("healthy") >= 36
    assert {"poor", "unknown", "triple", "parameter", "double", "force"} <= set(kinds)


def test_no_size_is_found_for_a_part_out_of_bounds(noisy_case):
    case = noisy_case
    trial = SizingTrial(case.machine.with_parts([]), case.training, 0)
    assert trial.find_size(case.present_effects[0].part, 1e-3) is None


def test_parts_with_the_same_shape_are_not_distinct():
    case = draw_case(ROBOT, "single", 3, "thermal_drift")
    trial = SizingTrial(case.machine.with_parts([]), case.training, 0)
    part = case.present_effects[0].part
    assert trial.are_distinct([part])
    assert not trial.are_distinct([part, part.with_size(0.5 * part.size)])
    values = np.array([1.0, 2.0, 4.0, 3.0])
    assert np.allclose(remove_shapes(values, [values * 3.0]), 0.0)
    assert np.array_equal(remove_shapes(values, []), values)
