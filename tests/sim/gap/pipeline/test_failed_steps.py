"""A computation that fails is reported as failed, never as a finding about the machine."""

import json

import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.sim.gap.compare import screening
from rotemina.sim.gap.fit import output_error
from rotemina.sim.gap.output import as_json, make_summary_text
from rotemina.sim.gap.pipeline import diagnose, diagnosis_pipeline
from rotemina.sim.gap.result import GapVerdict
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
GAIN_ERRORS = tuple(
    AxisEffect(axis=name, id="gain_error", parameters={"error": 0.04}) for name in ("zn", "thx")
)


@pytest.fixture(scope="module")
def records():
    """Return two records of zn and thx, both with a wrong gain."""
    time_s = np.arange(1000) / 500.0
    result = []
    for seed in range(2):
        signals, units = {}, {}
        for number, name in enumerate(("zn", "thx")):
            axis = ROBOT.axes[name]
            wave = np.sin(2.0 * np.pi * (1.0 + number + 0.3 * seed) * time_s) * time_s / 8.0
            signals[name, Tap.CMD] = sum(axis.range) / 2.0 + axis.span * wave
            units[name] = axis.unit
        commands = Record.from_signals(time_s, signals, units)
        result.append(simulate(ROBOT, GAIN_ERRORS, commands, np.random.default_rng(seed)))
    return result


def raise_singular(*_arguments, **_keywords):
    raise np.linalg.LinAlgError("Singular matrix")


@pytest.fixture
def failing_zn(monkeypatch):
    """Let the examination of zn fail."""
    examine = diagnosis_pipeline.examine

    def examine_others(evidence, *arguments, **keywords):
        if evidence.axis == "zn":
            raise_singular()
        return examine(evidence, *arguments, **keywords)

    monkeypatch.setattr(diagnosis_pipeline, "examine", examine_others)


def test_an_axis_that_is_not_examined_leaves_the_others_their_answer(records, failing_zn):
    diagnosis = diagnose(ROBOT, records)
    assert diagnosis.axes["zn"].verdict is GapVerdict.FAILED
    assert diagnosis.axes["zn"].causes == ()
    assert diagnosis.verdict is diagnosis.axes["thx"].verdict is GapVerdict.EXPLAINED
    document = as_json(diagnosis)
    assert document["axes"]["zn"] == "failed"
    assert document["complete"] is False
    assert {"axis": "zn", "effects": [], "reason": "Singular matrix"} in document["failed"]
    text = make_summary_text(diagnosis, records)
    assert "zn: not examined, because the program failed" in text
    assert "no known effect" not in text


def test_the_command_writes_the_other_axes_and_ends_with_status_1(
    records, failing_zn, tmp_path, capsys
):
    files = [tmp_path / f"{number}.csv" for number in range(len(records))]
    for record, file in zip(records, files, strict=True):
        write_record(record, file)
    output = tmp_path / "out.json"
    assert main(["gap", "diagnose", *map(str, files), "--json", str(output)]) == 1
    assert json.loads(output.read_text("utf-8"))["axes"] == {"thx": "explained", "zn": "failed"}
    error = capsys.readouterr().err
    assert "axis zn: the program failed to examine it (Singular matrix)" in error


def test_a_candidate_that_fails_is_listed_and_the_others_are_compared(records, monkeypatch):
    find_residual = output_error.residual_of

    def fail_with_a_delay(evidence, effects, *arguments, **keywords):
        if any(effect.id == "delay" for effect in effects):
            raise_singular()
        return find_residual(evidence, effects, *arguments, **keywords)

    for module in (output_error, screening):
        monkeypatch.setattr(module, "residual_of", fail_with_a_delay)
    diagnosis = diagnose(ROBOT, records)
    assert diagnosis.is_complete
    assert {cause.effect for cause in diagnosis.causes} == {"gain_error"}
    assert {step.axis for step in diagnosis.failed if "delay" in step.effects} == {"zn", "thx"}
    assert all(step.reason == "Singular matrix" for step in diagnosis.failed)
