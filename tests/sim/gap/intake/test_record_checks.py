"""Checks of records before a diagnosis: faults are refused or reported, effects pass."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.effects import AttachedEffect, load_all_effects
from rotemina.sim.errors import EffectError
from rotemina.sim.gap.compare import effect_candidates
from rotemina.sim.gap.fit import catalogue
from rotemina.sim.gap.intake import check_records
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.gap.result import GapVerdict
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import AXES, ROBOT, get_refusal, make_commands, modify_record, simulate_record


def test_healthy_records_pass_without_cautions():
    records = [
        simulate_record(),
        simulate_record(seed=1, rate_hz=2000.0),
        simulate_record(seed=2, share=0.1),
    ]
    assert check_records(ROBOT, records) == ()


def list_effects_on(axis):
    for effect in load_all_effects()[0].values():
        for formulation in effect.formulations:
            source = ("zn" if axis == "x" else "x") if effect.coupled else None
            effect_on_axis = AxisEffect(
                axis=axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            try:
                AttachedEffect.of(ROBOT, effect_on_axis)
            except EffectError:
                continue
            yield effect_on_axis


@pytest.mark.parametrize("axis", AXES)
def test_no_effect_is_mistaken_for_a_fault(axis):
    mistaken = {
        (effect.id, effect.formulation): cautions
        for effect in list_effects_on(axis)
        if (cautions := check_records(ROBOT, [simulate_record([effect], rows=3000)]))
    }
    assert not mistaken


@pytest.mark.parametrize(
    ("axis", "effect", "parameters"),
    [
        ("thx", "gain_error", {"error": -0.5}),
        ("thx", "sensor_gain", {"error": 0.5}),
        ("x", "sensor_quantization", {"step": 2e-5}),
        ("x", "backlash", {"width": 2e-4}),
        ("thx", "sensor_outliers", {"rate": 100.0}),
        ("thx", "contact", {}),
        ("thx", "saturation", {"high_margin": 0.25}),
        ("zn", "thermal_drift", {}),
        ("x", "cross_coupling", {"k": -0.9}),
    ],
)
def test_strong_effects_are_not_mistaken_for_faults(axis, effect, parameters):
    source = "zn" if effect == "cross_coupling" else None
    axis_effect = AxisEffect(axis=axis, id=effect, parameters=parameters, from_axis=source)
    assert check_records(ROBOT, [simulate_record([axis_effect])]) == ()


def test_missing_channels_are_reported():
    record = simulate_record()
    reduced_record = modify_record(
        record,
        {
            ("x", Tap.REF): None,
            ("thx", Tap.MEAS): None,
            **{("zn", tap): None for tap in (Tap.U, Tap.REF, Tap.MEAS)},
        },
    )
    texts = {caution.axis: str(caution.text) for caution in check_records(ROBOT, [reduced_record])}
    assert texts["x"].startswith("No independent reference (ref)")
    assert texts["thx"].startswith("The axis' own sensor was not recorded")
    assert texts["zn"] == "The axis was commanded but not measured: it is not diagnosed."
    assert not [
        caution
        for caution in check_records(ROBOT, [reduced_record, simulate_record(seed=1)])
        if caution.axis == "x"
    ]


def test_an_axis_that_never_moved_is_reported_but_not_refused():
    commands = make_commands(("thx",), share=0.0)
    record = simulate(ROBOT, (), commands, np.random.default_rng(0))
    [caution] = check_records(ROBOT, [record])
    assert str(caution.text).startswith("The axis was never commanded to move")
    assert caution.axis == "thx"


@pytest.mark.parametrize(
    ("records", "message"),
    [
        ([], "no record was given"),
        (
            [lambda: simulate_record(rows=99)],
            "record 1 (99 rows, 0.098 s): 99 rows; a diagnosis needs 100 rows",
        ),
        ([make_commands], "no measured channel (u, ref or meas) but only commands"),
    ],
)
def test_records_without_usable_data_are_refused(records, message):
    assert message in get_refusal(*(make() for make in records))


def test_records_of_another_robot_are_refused():
    record = simulate_record()
    assert "has no axis 'x'; its axes are p" in get_refusal(record, robot=load_robot("picma"))
    record_in_metres = Record(
        record.time_s, record.columns, record.values, dict.fromkeys(AXES, "m")
    )
    message = get_refusal(record_in_metres, names=["odd.csv"])
    assert message.startswith("odd.csv: axis 'thx' is in units of m, but robot 'RoTeMiNa'")
    time_s = np.arange(500) / 1000.0
    force_record = Record.from_signals(
        time_s, {("q", Tap.CMD): 0.1 + 0.0 * time_s, ("q", Tap.MEAS): time_s}, {"q": "m"}
    )
    assert "there is no q.u column: add it" in get_refusal(force_record, robot=load_robot("emps"))


def test_a_command_beyond_the_range_is_reported():
    record = simulate_record(axes=("zn",))
    shifted_record = modify_record(record, {("zn", Tap.CMD): record.signal("zn", Tap.CMD) + 2e-5})
    [caution] = check_records(ROBOT, [shifted_record])
    assert str(caution.text).startswith("A command of 7")


def test_a_robot_with_another_name_fits():
    robot = replace(ROBOT, name="other")
    assert check_records(robot, [simulate_record()]) == ()


@pytest.mark.parametrize("rate_hz", [0.1, 1e5])
def test_slow_and_fast_records_are_accepted(rate_hz):
    records = [
        simulate_record(seed=seed, rate_hz=rate_hz, axes=("zn",), rows=400) for seed in (0, 1)
    ]
    assert check_records(ROBOT, records) == ()
    assert diagnose(ROBOT, records).verdict is GapVerdict.NONE


def test_a_split_record_is_diagnosed_in_pieces(monkeypatch):
    """The machine continued to move between the pieces. To save time, few effects are tried."""
    effects = [effect for effect in catalogue() if effect.id in {"gain_error", "backlash"}]
    monkeypatch.setattr(effect_candidates, "catalogue", lambda: effects)
    gain_error = AxisEffect(axis="x", id="gain_error", parameters={"error": 0.02})
    record = simulate_record([gain_error], axes=("x",))
    rows = np.r_[0:1500, 2600:4000]
    incomplete_record = Record(
        record.time_s[rows], record.columns, record.values[rows], record.units
    )
    diagnosis = diagnose(ROBOT, [incomplete_record])
    assert diagnosis.causes[0].effect == "gain_error"
    assert any(str(remark).startswith("Time jumps 1 ×") for remark in diagnosis.axes["x"].remarks)
