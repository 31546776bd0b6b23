"""Calibration files, tip columns, and references computed from tips."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope import compute_tip_xy
from rotemina.app.microscope.calibration_file import (
    CALIBRATION_FORMAT,
    load_calibration,
    make_calibration_path,
    save_calibration,
)
from rotemina.app.microscope.measurements import (
    compute_axis_reference,
    make_tip_columns,
    with_reference,
)
from rotemina.sim.kinematics import JOINTS, compute_tip_position
from rotemina.sim.records import Record, Tap


def test_saved_calibration_loads_unchanged(shared_bench, tmp_path):
    calibration = shared_bench.make_true_calibration()
    path = save_calibration(tmp_path / "new", calibration)
    assert path == make_calibration_path(
        tmp_path / "new", calibration.camera, calibration.objective
    )
    assert (
        load_calibration(tmp_path / "new", calibration.camera, calibration.objective) == calibration
    )
    assert load_calibration(tmp_path, calibration.camera, "40x") is None


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("version = 1", "version = 2", "at most 1"),
        ('objective = "20x"', "objectiv = 1", "did you mean 'objective'"),
        ("width = 650", "width = 0", "at least 1"),
        ("residual_px = 0.05", "residual_px = -1.0", "at least 0"),
    ],
)
def test_invalid_file_is_refused_with_key_and_bound(shared_bench, tmp_path, old, new, message):
    path = save_calibration(tmp_path, shared_bench.make_true_calibration())
    text = path.read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(MicroscopeError, match=message):
        CALIBRATION_FORMAT.parse(text.replace(old, new), str(path))


def test_singular_matrix_is_refused(shared_bench):
    with pytest.raises(ValueError, match="singular"):
        replace(shared_bench.make_true_calibration().micro, matrix=((1.0, 1.0), (1.0, 1.0)))


def test_file_of_another_camera_is_refused(shared_bench, tmp_path):
    calibration = shared_bench.make_true_calibration()
    make_calibration_path(tmp_path, "a_b", "20x").write_text(
        CALIBRATION_FORMAT.to_toml(calibration), encoding="utf-8"
    )
    with pytest.raises(MicroscopeError, match="calibrate again"):
        load_calibration(tmp_path, "a_b", "20x")


def test_columns_match_the_true_tip_position(shared_bench):
    calibration, track = shared_bench.make_true_calibration().micro, shared_bench.track_tip()
    columns = make_tip_columns(track, calibration)
    truth = compute_tip_position(shared_bench.chain, np.array(shared_bench.driver.true_positions))
    for index, name in enumerate("xy"):
        assert columns[f"{name} [um]"] == pytest.approx(truth[index] * 1e6, abs=0.1)
        assert 0.0 < columns[f"{name} sd [um]"] < 0.1
    lost = make_tip_columns(replace(track, lost_frames=2), calibration)
    assert np.isnan(lost["x [um]"])
    assert lost["quality"] == 0.0
    assert lost.keys() == columns.keys()


def test_uncertainty_grows_with_distance_from_the_calibration_point(shared_bench):
    calibration = shared_bench.make_true_calibration().micro
    near = np.array(calibration.tip_px)
    far = near + np.array([300.0, 200.0])
    variances = [
        np.trace(compute_tip_xy(pixel, 1e-4 * np.eye(2), calibration)[1]) for pixel in (near, far)
    ]
    assert variances[1] > 1.2 * variances[0]


def test_axis_reference_follows_from_the_tip(shared_bench):
    rng, chain = np.random.default_rng(0), shared_bench.chain
    joints = rng.uniform(chain.lower, chain.upper, (50, 6))
    tip_m = compute_tip_position(chain, joints)
    for column, axis in enumerate(JOINTS):
        others = joints.copy()
        others[:, column] = 0.0 if axis == "zn" else chain.centre[column]
        reference = compute_axis_reference(chain, axis, tip_m, others)
        assert reference == pytest.approx(joints[:, column], abs=1e-12), axis
    with pytest.raises(MicroscopeError, match="does not move the tip"):
        compute_axis_reference(chain, "q", np.zeros((1, 3)), np.zeros((1, 6)))


def make_x_record():
    time_s = np.arange(100) * 0.01
    return Record.from_signals(time_s, {("x", Tap.CMD): 1e-5 * time_s}, {"x": "m"})


def test_record_gets_a_reference_where_frames_cover_it():
    times = np.array([0.2, 0.3, 0.4, 0.5])
    values = np.array([2e-6, np.nan, 4e-6, 5e-6])
    record = with_reference(make_x_record(), "x", times, values, 2e-8)
    assert record.time_s[[0, -1]] == pytest.approx([0.2, 0.5])
    assert record.signal("x", Tap.REF) == pytest.approx(1e-5 * record.time_s)
    assert record.metadata["history"] == "unknown"
    assert "2e-08 rms, 3 frames" in record.metadata["reference"]


def test_impossible_reference_is_refused():
    with pytest.raises(MicroscopeError, match="no axis"):
        with_reference(make_x_record(), "y", np.array([0.0, 1.0]), np.zeros(2), 1e-8)
    with pytest.raises(MicroscopeError, match="1 frames"):
        with_reference(make_x_record(), "x", np.array([0.0, 1.0]), np.array([0.0, np.nan]), 1e-8)
    record = with_reference(make_x_record(), "x", np.array([0.0, 0.9]), np.zeros(2), 1e-8)
    with pytest.raises(MicroscopeError, match="reference of"):
        with_reference(record, "x", np.array([0.0, 0.9]), np.zeros(2), 1e-8)
