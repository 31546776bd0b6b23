"""What the microscope saw as the reference that tells a sensor's error from the machine's."""

import numpy as np
import pytest

from rotemina.app.microscope.recorded_reference import recorded_reference
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import AxisEffect

WAYS_M = (30e-6, -20e-6, 15e-6, -35e-6, 5e-6, 25e-6, -10e-6)


THINNED = 10  # kept of 1000 samples/s: every such, for the diagnosis takes minutes with all


def of_x(record, *taps):
    """Return some of what was recorded of x, thinned."""
    signals = {("x", tap): record.signal("x", tap)[::THINNED] for tap in taps}
    return Record.from_signals(record.time_s[::THINNED], signals, {"x": "m"}, record.metadata)


@pytest.mark.slow
def test_a_sensor_that_reads_wrong_is_told_from_a_machine_that_goes_wrong(tmp_path, make_work):
    running = []
    work = make_work(tmp_path, seconds=0.04, recorder=lambda: running[0] if running else None)
    work.look()
    work.calibrate_by_truth()
    work.tracking()
    work.session.service.set_effects(
        [AxisEffect(axis="x", id="sensor_gain", parameters={"error": 0.05})]
    )
    work.step(2)
    recorder = SessionRecorder(work.session, tmp_path / "run.arrows", clock=work.clock)
    recorder.start(thread=False)
    running.append(recorder)
    begin = work.session.snapshot().command["x"]
    for away in WAYS_M:
        work.session.go_to({"x": begin + away}, speeds={"x": 40e-6})
        work.step(40)
        recorder.writer.run_once()
    recorder.close()
    record = recorded_reference(Recording.open(tmp_path / "run.arrows"), "x")
    assert np.ptp(record.signal("x", Tap.REF)) == pytest.approx(65e-6, rel=0.01)

    # Commands that are held for longer come later to the model: a delay is named as well.
    seen = diagnose(work.robot, [of_x(record, Tap.CMD, Tap.MEAS, Tap.REF)]).axes["x"]
    causes = {cause.effect: cause for cause in seen.causes}
    assert not {"gain_error", "static_nonlinearity", "leadscrew_error"} & set(causes)
    found = causes["sensor_gain"]
    assert found.tap is Tap.MEAS
    assert "gain_error" not in found.ambiguous_with
    assert found.closed > 0.95
    (error,) = found.parameters
    assert error.value == pytest.approx(0.05, rel=0.05)

    unseen = diagnose(work.robot, [of_x(record, Tap.CMD, Tap.MEAS)]).axes["x"]
    (gain,) = [one for one in unseen.causes if one.effect in ("gain_error", "sensor_gain")]
    assert {gain.effect, *gain.ambiguous_with} >= {"gain_error", "sensor_gain"}
    assert any("No independent reference" in str(remark) for remark in unseen.remarks)
