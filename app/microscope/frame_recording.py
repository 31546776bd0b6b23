"""Writes frame times and the tip into the running recording."""

from collections.abc import Callable

from rotemina.app.microscope.calibration_file import MicroscopeCalibration
from rotemina.app.microscope.measurements import CHANNEL, tip_columns
from rotemina.app.microscope.tip_tracker import Tracked
from rotemina.app.motion.recording.session_recorder import SessionRecorder
from rotemina.drivers.cameras.frame import Frame

FRAMES = "frames"


class FrameRecording:
    """Hands on what is seen; on the threads of camera and tracker, and never waits.

    Parameters
    ----------
    recorder : callable
        Return what records now, or None.
    calibration : callable
        Return what is known of camera and objective, or None.
    """

    def __init__(
        self,
        recorder: Callable[[], SessionRecorder | None],
        calibration: Callable[[], MicroscopeCalibration | None],
    ) -> None:
        self._recorder, self._calibration = recorder, calibration

    def frame(self, frame: Frame) -> None:
        """Record the arrival of a picture, with all numbers of the camera.

        A camera's own time is among those, where it tells one.
        """
        recorder = self._recorder()
        if recorder is None:
            return
        told = {
            name: float(value)
            for name, value in frame.metadata.items()
            if isinstance(value, bool | int | float)
        }
        exposure = {} if frame.exposure_s is None else {"exposure [s]": frame.exposure_s}
        known = {"number": float(frame.number), "lost": float(frame.lost)}
        recorder.record(FRAMES, frame.host_time_s, {**told, **known, **exposure})

    def tip(self, tracked: Tracked) -> None:
        """Record where the tip is in a picture; NaN while it is lost."""
        recorder, frame, track = self._recorder(), tracked.frame, tracked.track
        if recorder is None or frame is None or track is None:
            return
        known = self._calibration()
        columns = tip_columns(track, None if known is None else known.micro)
        recorder.record(CHANNEL, frame.host_time_s, {**columns, "frame": float(frame.number)})
