"""Regression levels of the diagnosis on real machines, with all data next to the checkout."""

import runpy
from pathlib import Path

import pytest

from rotemina.app.bench.bench_run import diagnose_machine
from rotemina.app.bench.machine import find_machines

pytestmark = pytest.mark.slow

# Largest corrected error as a multiple of the error to beat. Of two machines with the same causes,
# one is diagnosed here; `rotemina gap bench` diagnoses all of them.
MAX_ERROR_RATIOS = {
    "emps": 0.95,
    "kuka2_twist": 1.05,
    "so101_wrist_pitch": 1.1,
    "worm_ap": 1.1,
}


@pytest.fixture(scope="module")
def machines(shared_dir, tmp_path_factory):
    folder = tmp_path_factory.mktemp("real")
    lay_out = runpy.run_path(str(Path(__file__).with_name("laid_out.py")))["lay_out"]
    lay_out(shared_dir / "data", folder)
    return {machine.name: machine for machine in find_machines([folder])}


@pytest.mark.parametrize("name", MAX_ERROR_RATIOS)
def test_diagnosis_of_real_machine_is_no_worse_than_before(name, machines):
    result = diagnose_machine(machines[name])
    assert not result.not_run
    assert result.is_first_cause_known
    # Every known cause is named, or belongs to a small set of indistinguishable causes.
    assert result.missed_causes == []
    assert result.corrected_error <= MAX_ERROR_RATIOS[name] * result.to_beat


def test_all_machine_folders_are_complete(machines):
    assert all(machine.test and machine.truth for machine in machines.values())
    inverse = [name for name, machine in machines.items() if machine.is_inverse]
    assert inverse == ["kuka1_torque"]
