"""PICMA: an inverse trained on swings of one size reproduces the voltage of growing swings."""

import pytest

from rotemina.sim.compensate import compute_residual, read_samples, train
from rotemina.sim.records import read_record
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow

MAX_RESIDUAL_M = 0.45e-6


def test_the_recorded_voltage_of_growing_swings_is_reproduced(real_dir):
    """The history of a real record is unknown, so its offset is removed."""
    robot = load_robot("picma")
    training, unseen = (
        read_samples(robot, "p", read_record(real_dir / f"picma_{name}.csv", robot=robot), name)
        for name in ("train", "growing")
    )
    trained = train(robot, [training])
    residuals = {
        kind: compute_residual(model, [(unseen, unseen.first)])
        for kind, model in trained.models.items()
    }
    for kind, residual in residuals.items():
        print(
            f"{kind}: {1e6 * residual.aligned:.3f} µm, with the offset {1e6 * residual.rms:.3f} µm"
        )
    assert trained.recommended_kind == "prandtl_ishlinskii"
    assert "All swings have one size" in trained.recommendation_reason
    assert residuals[trained.recommended_kind].aligned <= MAX_RESIDUAL_M
    assert residuals["linear"].aligned > 5.0 * residuals[trained.recommended_kind].aligned
