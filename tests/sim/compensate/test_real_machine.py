"""PICMA: trained on swings of one size, an inverse reproduces the voltage of growing ones."""

import pytest

from rotemina.sim.compensate.judgement import residual
from rotemina.sim.compensate.samples import samples_of
from rotemina.sim.compensate.training import train
from rotemina.sim.records.reading import read_record
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow

MOST_M = 0.45e-6


def test_the_recorded_voltage_of_growing_swings_is_reproduced(real_dir):
    """The past of a real record is unknown: its offset is its own, and is taken off."""
    robot = load_robot("picma")
    known, unseen = (
        samples_of(robot, "p", read_record(real_dir / f"picma_{name}.csv", robot=robot), name)
        for name in ("train", "growing")
    )
    found = train(robot, [known])
    left = {kind: residual(model, [(unseen, unseen.first)]) for kind, model in found.models.items()}
    for kind, one in left.items():
        print(f"{kind}: {1e6 * one.aligned:.3f} µm, with the offset {1e6 * one.rms:.3f} µm")
    assert found.chosen == "prandtl_ishlinskii"
    assert "All swings have one size" in found.why
    assert left[found.chosen].aligned <= MOST_M
    assert left["linear"].aligned > 5.0 * left[found.chosen].aligned
