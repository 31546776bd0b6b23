"""Recording of frame times and the tracked tip."""

from collections.abc import Callable

from rotemina.app.microscope.calibration_file import MicroscopeCalibration
from rotemina.app.microscope.measurements import TIP_CHANNEL, make_tip_columns
from rotemina.app.microscope.tip_tracker import TrackingResult
from rotemina.app.motion.recording import SessionRecorder
from rotemina.drivers.cameras import CameraFrame

FRAMES_CHANNEL = "frames"


class FrameRecorder:
    """Writes frame times and tip positions to the running recording.

    The methods are called on the threads of the camera and the tracker, and never wait.

    Parameters
    ----------
    recorder : callable
        Returns the running recorder, or None.
    calibration : callable
        Returns the calibration of camera and objective, or None.
    """

    def __init__(
        self,
        recorder: Callable[[], SessionRecorder | None],
        calibration: Callable[[], MicroscopeCalibration | None],
    ) -> None:
        self._get_recorder, self._get_calibration = recorder, calibration

    def record_frame(self, frame: CameraFrame) -> None:
        """Record the arrival of a picture, with all numeric metadata of the camera.

        They include the time on the camera's clock, if the camera reports it.
        """
        recorder = self._get_recorder()
        if recorder is None:
            return
        camera_values = {
            name: float(value)
            for name, value in frame.metadata.items()
            if isinstance(value, bool | int | float)
        }
        exposure = {} if frame.exposure_s is None else {"exposure [s]": frame.exposure_s}
        counters = {"number": float(frame.number), "lost": float(frame.lost)}
        recorder.record_values(
            FRAMES_CHANNEL, frame.host_time_s, {**camera_values, **counters, **exposure}
        )

    def record_tip(self, result: TrackingResult) -> None:
        """Record the position of the tip in a picture; NaN while the tip is lost."""
        recorder, frame, track = self._get_recorder(), result.frame, result.track
        if recorder is None or frame is None or track is None:
            return
        calibration = self._get_calibration()
        columns = make_tip_columns(track, None if calibration is None else calibration.micro)
        recorder.record_values(
            TIP_CHANNEL, frame.host_time_s, {**columns, "frame": float(frame.number)}
        )
