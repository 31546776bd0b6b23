"""How closely an axis with feed-forward only follows references that were not trained on.

The page on compensation also shows zn and thx Preisach, which are easier than these plants.
"""

import numpy as np
import pytest

from rotemina.sim.compensate import Inverse, make_excitation, train
from rotemina.sim.compensate.excitation import RATE_HZ

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("compensation")]  # trained once

PLANTS = {
    "thx": ("robot", "thx", "prandtl_ishlinskii"),
    "zn bent": ("robot", "zn", "modified_prandtl_ishlinskii"),
    "thy Preisach": ("foreign", "thy", 8),
    "zn Preisach": ("foreign", "zn", 9),
}
TENTH_OF_RESONANCE_HZ = {"thx": 30.0, "thy": 30.0, "zn": 42.0}
MAX_RMS, MAX_RMS_AT_TENTH, MAX_MSE = 0.006, 0.01, 0.005
# Share of the range at which training nearly begins, and every run begins.
LOW_SHARE = 0.06
# Creep longer than the record may raise the error to this multiple of the bound.
MAX_RATIO_AFTER_LONG_REST = 1.2


def make_references(axis):
    """Return desired positions (n,), as shares of the range, by name."""
    time_s = np.arange(round(6.0 * RATE_HZ)) / RATE_HZ
    onset = np.minimum(time_s / 0.5, 1.0)

    def compute_phase(frequency_hz):
        return 2.0 * np.pi * frequency_hz * time_s

    rng = np.random.default_rng(5)
    corners = np.interp(time_s, np.cumsum(rng.uniform(0.1, 0.4, 60)), rng.uniform(0.16, 0.88, 60))
    tones = (
        np.sin(compute_phase(1.3))
        + np.sin(compute_phase(4.1) + 1.0)
        + np.sin(compute_phase(9.7) + 2.0)
    )
    return {
        "sine 1 Hz": 0.52 - 0.35 * np.cos(compute_phase(1.0)),
        "sine 10 Hz": 0.52 - 0.35 * onset * np.cos(compute_phase(10.0)),
        "fading 5 Hz": 0.52 - 0.36 * np.exp(-time_s / 4.0) * np.cos(compute_phase(5.0)),
        "triangle 2 Hz": 0.52 + 0.7 / np.pi * np.arcsin(np.sin(compute_phase(2.0) - np.pi / 2.0)),
        "corners": corners,
        "tones to 10 Hz": 0.5 + 0.12 * onset * tones,
        "tenth": 0.52 - 0.2 * onset * np.cos(compute_phase(TENTH_OF_RESONANCE_HZ[axis])),
    }


@pytest.fixture(scope="module", params=PLANTS, ids=list(PLANTS))
def trained_plant(request, robot, make_robot_plant, make_foreign_plant):
    kind, axis, variant = PLANTS[request.param]
    plant = (make_robot_plant if kind == "robot" else make_foreign_plant)(axis, variant)
    commands = make_excitation(robot, axis, np.random.default_rng(0))
    return request.param, plant, train(robot, [plant.read_samples(commands)])


def test_unseen_references_are_followed(trained_plant):
    name, plant, trained = trained_plant
    references = make_references(plant.axis)
    shares = {}
    for kind, model in trained.models.items():
        shares[kind] = {n: compute_error_share(plant, model, d) for n, d in references.items()}
        cells = " | ".join(f"{100.0 * share:.2f}" for share in shares[kind].values())
        print(f"\n| {name} | {kind} | {cells} |", end="")
    print(f"\n{name}: {trained.recommendation_reason}")
    best = shares[trained.recommended_kind]
    for reference, share in best.items():
        assert share**2 < MAX_MSE, reference
        assert share <= (MAX_RMS_AT_TENTH if reference == "tenth" else MAX_RMS), reference
    anfis, modified = (get_worst(shares[k]) for k in ("anfis", "modified_prandtl_ishlinskii"))
    assert trained.recommended_kind != "anfis" or anfis <= 1.5 * modified
    assert get_worst(best) < 0.15 * get_worst(shares["linear"])


@pytest.mark.parametrize("reference", ["sine 10 Hz", "corners", "tenth"])
def test_after_a_long_rest_elsewhere_the_error_is_a_constant(trained_plant, reference):
    # Creep with longer time constants than the record has moved the axis, which a record of half
    # a minute cannot show. About its mean the error is as small as from the low end.
    name, plant, trained = trained_plant
    reference_shares = make_references(plant.axis)[reference]
    error = plant.compute_tracking_error(
        Inverse(trained.models[trained.recommended_kind], 1.0 / RATE_HZ), reference_shares
    )
    share, share_about_mean = (
        compute_rms(error) / np.ptp(reference_shares),
        float(np.std(error)) / np.ptp(reference_shares),
    )
    print(f"\n{name} {reference}, at rest for ever: {100 * share:.2f} %, about its mean", end=" ")
    print(f"{100.0 * share_about_mean:.2f} %")
    bound = MAX_RMS_AT_TENTH if reference == "tenth" else MAX_RMS
    assert share_about_mean <= bound
    assert share <= MAX_RATIO_AFTER_LONG_REST * bound


def compute_error_share(plant, model, reference):
    """Return rms error over span of a reference (n,) that begins after a rise from the low end."""
    rise = np.linspace(0.0, 1.0, 1000)
    rise = LOW_SHARE + (reference[0] - LOW_SHARE) * rise**3 * (10.0 - 15.0 * rise + 6.0 * rise**2)
    desired = np.r_[np.full(2000, LOW_SHARE), rise, reference]
    error = plant.compute_tracking_error(Inverse(model, 1.0 / RATE_HZ), desired)[3000:]
    return compute_rms(error) / np.ptp(reference)


def compute_rms(values):
    return float(np.sqrt(np.mean(values**2)))


def get_worst(shares):
    return max(shares.values())
