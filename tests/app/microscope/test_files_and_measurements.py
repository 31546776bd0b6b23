"""Calibrations on disk, tip columns, and references made of tips."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.microscope.calibration_file import FORMAT, file_of, load, save
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.measurements import (
    axis_reference,
    tip_columns,
    tip_in_plane,
    with_reference,
)
from rotemina.sim.kinematics.chain import JOINTS
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.records.record import Record, Tap


def test_a_calibration_comes_back_as_it_was_kept(still, tmp_path):
    known = still.known()
    path = save(tmp_path / "new", known)
    assert path == file_of(tmp_path / "new", known.camera, known.objective)
    assert load(tmp_path / "new", known.camera, known.objective) == known
    assert load(tmp_path, known.camera, "40x") is None


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("version = 1", "version = 2", "at most 1"),
        ('objective = "20x"', "objectiv = 1", "did you mean 'objective'"),
        ("width = 650", "width = 0", "at least 1"),
        ("residual_px = 0.05", "residual_px = -1.0", "at least 0"),
    ],
)
def test_a_spoilt_file_is_refused_with_key_and_bound(still, tmp_path, old, new, told):
    path = save(tmp_path, still.known())
    text = path.read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(MicroscopeError, match=told):
        FORMAT.parse(text.replace(old, new), str(path))


def test_a_singular_matrix_is_refused(still):
    with pytest.raises(ValueError, match="singular"):
        replace(still.known().micro, matrix=((1.0, 1.0), (1.0, 1.0)))


def test_the_file_of_another_camera_is_refused(still, tmp_path):
    known = still.known()
    file_of(tmp_path, "a_b", "20x").write_text(FORMAT.text(known), encoding="utf-8")
    with pytest.raises(MicroscopeError, match="calibrate again"):
        load(tmp_path, "a_b", "20x")


def test_columns_say_where_the_tip_truly_is(still):
    known, track = still.known().micro, still.track()
    columns = tip_columns(track, known)
    truth = tip_position(still.chain, np.array(still.driver.true_positions))
    for index, name in enumerate("xy"):
        assert columns[f"{name} [um]"] == pytest.approx(truth[index] * 1e6, abs=0.1)
        assert 0.0 < columns[f"{name} sd [um]"] < 0.1
    lost = tip_columns(replace(track, lost_for=2), known)
    assert np.isnan(lost["x [um]"])
    assert lost["quality"] == 0.0
    assert lost.keys() == columns.keys()


def test_far_from_where_it_was_calibrated_the_doubt_grows(still):
    known = still.known().micro
    near = np.array(known.tip_px)
    far = near + np.array([300.0, 200.0])
    doubts = [np.trace(tip_in_plane(at, 1e-4 * np.eye(2), known)[1]) for at in (near, far)]
    assert doubts[1] > 1.2 * doubts[0]


@pytest.mark.parametrize("axis", JOINTS)
def test_an_axis_is_where_the_tip_says(still, axis):
    rng, chain = np.random.default_rng(0), still.chain
    joints = rng.uniform(chain.lower, chain.upper, (50, 6))
    tip_m = tip_position(chain, joints)
    others = joints.copy()
    others[:, JOINTS.index(axis)] = chain.centre[JOINTS.index(axis)]
    if axis == "zn":
        others[:, 5] = 0.0
    found = axis_reference(chain, axis, tip_m, others)
    assert found == pytest.approx(joints[:, JOINTS.index(axis)], abs=1e-12)


def test_what_is_no_joint_has_no_reference(still):
    with pytest.raises(MicroscopeError, match="does not move the tip"):
        axis_reference(still.chain, "q", np.zeros((1, 3)), np.zeros((1, 6)))


def record():
    time_s = np.arange(100) * 0.01
    return Record.from_signals(time_s, {("x", Tap.CMD): 1e-5 * time_s}, {"x": "m"})


def test_a_record_gets_its_reference_where_frames_cover_it():
    times = np.array([0.2, 0.3, 0.4, 0.5])
    values = np.array([2e-6, np.nan, 4e-6, 5e-6])
    made = with_reference(record(), "x", times, values, 2e-8)
    assert made.time_s[[0, -1]] == pytest.approx([0.2, 0.5])
    assert made.signal("x", Tap.REF) == pytest.approx(1e-5 * made.time_s)
    assert made.metadata["history"] == "unknown"
    assert "2e-08 rms, 3 frames" in made.metadata["reference"]


def test_a_reference_is_refused_where_it_has_no_place():
    with pytest.raises(MicroscopeError, match="no axis"):
        with_reference(record(), "y", np.array([0.0, 1.0]), np.zeros(2), 1e-8)
    with pytest.raises(MicroscopeError, match="1 frames"):
        with_reference(record(), "x", np.array([0.0, 1.0]), np.array([0.0, np.nan]), 1e-8)
    made = with_reference(record(), "x", np.array([0.0, 0.9]), np.zeros(2), 1e-8)
    with pytest.raises(MicroscopeError, match="reference of"):
        with_reference(made, "x", np.array([0.0, 0.9]), np.zeros(2), 1e-8)
