"""Assembles the state of the microscope for a view."""

from typing import TYPE_CHECKING

import numpy as np

from rotemina.app.microscope.measurements import tip_in_plane
from rotemina.app.microscope.optical_setup import OpticalSetup
from rotemina.app.microscope.picture_jobs import PictureJobs
from rotemina.app.microscope.status import (
    CellSeen,
    Measured,
    MicroscopeStatus,
    TipSeen,
)
from rotemina.app.microscope.tip_tracker import Tracked
from rotemina.sim.arrays import FloatArray
from rotemina.sim.vision.cell import membrane_ahead
from rotemina.sim.vision.tracking import TipTrack

if TYPE_CHECKING:
    from rotemina.app.microscope.microscope import Microscope


def build_status(microscope: "Microscope") -> MicroscopeStatus:
    """Return this moment."""
    setup, tracked = microscope.setup, microscope.tracker.tracked
    view, camera = microscope.camera.view, microscope.camera.camera
    pixel_m, source = setup.scale
    positioning, adjustments = microscope.positioning, microscope.adjustments
    calibrating, focusing = adjustments.calibrating, adjustments.focusing
    tip = microscope.tracker.tip
    return MicroscopeStatus(
        cameras=microscope.camera.cameras,
        camera_problems=microscope.camera.problems,
        camera=None if camera is None else camera.identity,
        feed=view,
        objective=setup.objective,
        objectives=setup.objectives,
        calibration=setup.calibration,
        calibration_problem=setup.problem,
        pixel_m=pixel_m,
        scale_source=source,
        activity=microscope.runs.activity,
        calibrating=None if calibrating is None else calibrating.status,
        visiting=None if positioning.run is None else positioning.run.status,
        focusing=None if focusing is None else focusing.status,
        stacking=None if adjustments.stacking is None else adjustments.stacking.status,
        stopped=microscope.runs.stopped,
        planned=positioning.planned,
        path=microscope.tracker.path,
        tip=_tip(setup, tracked),
        cell=_cell(microscope.jobs, tip, pixel_m),
        measured=_measured(microscope.measured, tip, pixel_m),
        targets=tuple(positioning.sequence.targets),
        nano_limits=setup.nano_limits(None if tip is None else tip.pixel),
        focus_axes=adjustments.focus_axes,
        drift=microscope.jobs.drift,
        background=tracked.ground,
        frames_processed=tracked.processed,
        frames_skipped=tracked.skipped,
        truth=microscope.camera.truth,
    )


def _tip(setup: OpticalSetup, tracked: Tracked) -> TipSeen:
    track = tracked.track
    if track is None:
        return TipSeen(tracked.state, reason=tracked.reason)
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
