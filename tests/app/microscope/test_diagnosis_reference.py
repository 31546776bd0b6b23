"""A reference from the microscope separates sensor errors from machine errors."""

import numpy as np
import pytest

from rotemina.app.microscope import make_reference_record
from rotemina.app.motion.recording import Recording
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect

OFFSETS_M = (30e-6, -20e-6, 15e-6, -35e-6, 25e-6)
DECIMATION = 10  # every 10th of 1000 samples/s, since the diagnosis of all takes minutes


def extract_x(record, *taps):
    """Return some decimated signals of x."""
    signals = {("x", tap): record.signal("x", tap)[::DECIMATION] for tap in taps}
    return Record.from_signals(record.time_s[::DECIMATION], signals, {"x": "m"}, record.metadata)


@pytest.mark.slow
def test_reference_separates_sensor_gain_from_gain_error(tmp_path, make_rig):
    rig = make_rig(tmp_path, seconds=0.04)
    rig.find_cameras()
    rig.store_true_calibration()
    rig.start_tracking()
    rig.session.service.set_effects(
        [AxisEffect(axis="x", id="sensor_gain", parameters={"error": 0.05})]
    )
    rig.step(2)
    recorder = rig.start_recording(tmp_path / "run.arrows")
    start = rig.session.snapshot().command["x"]
    for offset in OFFSETS_M:
        rig.session.go_to({"x": start + offset}, speeds={"x": 40e-6})
        rig.step(40)
        recorder.writer.run_once()
    recorder.close()
    record = make_reference_record(Recording.open(tmp_path / "run.arrows"), "x")
    assert np.ptp(record.signal("x", Tap.REF)) == pytest.approx(65e-6, rel=0.01)

    # The decimated commands are held longer, so the model also names a delay.
    with_reference = diagnose(rig.robot, [extract_x(record, Tap.CMD, Tap.MEAS, Tap.REF)]).axes["x"]
    causes = {cause.effect: cause for cause in with_reference.causes}
    assert not {"gain_error", "static_nonlinearity", "leadscrew_error"} & set(causes)
    sensor_gain = causes["sensor_gain"]
    assert sensor_gain.tap is Tap.MEAS
    assert "gain_error" not in sensor_gain.ambiguous_with
    assert sensor_gain.closed > 0.95
    (error,) = sensor_gain.parameters
    assert error.value == pytest.approx(0.05, rel=0.05)
