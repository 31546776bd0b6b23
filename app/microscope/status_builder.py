"""Assembles the state of the microscope for a view."""

from dataclasses import dataclass

import numpy as np

from rotemina.app.microscope.adjustments import Adjustments
from rotemina.app.microscope.camera_in_use import CameraInUse
from rotemina.app.microscope.measurements import tip_in_plane
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.picture_jobs import PictureJobs
from rotemina.app.microscope.runs import Runs
from rotemina.app.microscope.status import (
    CellSeen,
    Measured,
    MicroscopeStatus,
    TipSeen,
)
from rotemina.app.microscope.tip_positioning import TipPositioning
from rotemina.app.microscope.tip_tracker import TipTracker, Tracked
from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.cell import membrane_ahead
from rotemina.sim.vision.tracking import TipTrack


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """What a microscope's status is of."""

    camera: CameraInUse
    setup: OpticalSetup
    tracker: TipTracker
    jobs: PictureJobs
    runs: Runs
    positioning: TipPositioning
    adjustments: Adjustments


def build_status(parts: Parts, ends: tuple[FloatArray, FloatArray] | None) -> MicroscopeStatus:
    """Return this moment; ``ends`` (2,) px each are those of the measured line, if any."""
    setup, tracked = parts.setup, parts.tracker.tracked
    view, camera = parts.camera.view, parts.camera.camera
    pixel_m, source = setup.scale
    positioning, adjustments = parts.positioning, parts.adjustments
    calibrating, focusing = adjustments.calibrating, adjustments.focusing
    tip = parts.tracker.tip
    return MicroscopeStatus(
        cameras=parts.camera.cameras,
        camera_problems=parts.camera.problems,
        camera=None if camera is None else camera.identity,
        feed=view,
        objective=setup.objective,
        objectives=setup.objectives,
        calibration=setup.calibration,
        calibration_problem=setup.problem,
        pixel_m=pixel_m,
        scale_source=source,
        activity=parts.runs.activity,
        calibrating=None if calibrating is None else calibrating.status,
        visiting=None if positioning.run is None else positioning.run.status,
        focusing=None if focusing is None else focusing.status,
        stacking=None if adjustments.stacking is None else adjustments.stacking.status,
        stopped=parts.runs.stopped,
        planned=positioning.planned,
        path=parts.tracker.path,
        tip=_tip(setup, tracked),
        cell=_cell(parts.jobs, tip, pixel_m),
        measured=_measured(ends, tip, pixel_m),
        targets=tuple(positioning.sequence.targets),
        nano_limits=setup.nano_limits(None if tip is None else tip.pixel),
        focus_axes=adjustments.focus_axes,
        drift=parts.jobs.drift,
        background=tracked.ground,
        frames_processed=tracked.processed,
        frames_skipped=tracked.skipped,
        truth=parts.camera.truth,
    )


def _tip(setup: OpticalSetup, tracked: Tracked) -> TipSeen:
    track, frame = tracked.track, tracked.frame
    number = None if frame is None else frame.number
    at_s = None if frame is None else frame.host_time_s
    if track is None:
        return TipSeen(tracked.state, reason=tracked.reason, frame_number=number, host_time_s=at_s)
    place = sigma = None
    kept = setup.calibration
    if kept is not None and kept.micro is not None:
        place, spread = tip_in_plane(track.pixel, track.covariance, kept.micro)
        sigma = np.sqrt(np.diag(spread))
    return TipSeen(
        state=tracked.state,
        pixel=track.pixel,
        sigma_px=float(np.sqrt(np.linalg.eigvalsh(track.covariance)[-1])),
        direction=track.pipette.direction,
        depth=track.depth,
        place_m=place,
        sigma_m=sigma,
        quality=track.quality,
        reason=tracked.reason,
        frame_number=number,
        host_time_s=at_s,
    )


def _cell(jobs: PictureJobs, tip: TipTrack | None, pixel_m: float | None) -> CellSeen:
    outline, reason = jobs.cell, jobs.reason
    if outline is None or tip is None:
        return CellSeen(outline, reason=reason)
    # The way of the tip is out of its body, which leads the other way.
    ahead = membrane_ahead(outline, tip.pixel, tip.covariance, tip.pipette.direction + np.pi)
    if ahead is None or pixel_m is None:
        return CellSeen(outline, ahead, reason=reason)
    away, doubt = ahead.distance * pixel_m, ahead.distance_uncertainty * pixel_m
    return CellSeen(outline, ahead, away, doubt, reason)


def _measured(
    ends: tuple[FloatArray, FloatArray] | None, tip: TipTrack | None, pixel_m: float | None
) -> Measured | None:
    if ends is None:
        return None
    way = ends[1] - ends[0]
    length, angle = float(np.hypot(*way)), float(np.arctan2(way[1], way[0]))
    to_body = None
    if tip is not None:
        between = abs((angle - tip.pipette.direction + 0.5 * np.pi) % np.pi - 0.5 * np.pi)
        to_body = float(between)
    return Measured(
        begin=ends[0],
        end=ends[1],
        length_px=length,
        length_m=None if pixel_m is None else length * pixel_m,
        angle=angle,
        to_body=to_body,
    )
