"""Text reports of a solved plate."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.modes import PlateModes
from rotemina.sim.plate.quasi_static_ramp import RampResponse
from rotemina.sim.plate.robot_entries import RobotEntryChange, compare_with_shipped_robot
from rotemina.sim.plate.seat_friction import friction_limits
from rotemina.sim.plate.statics import UnitSolutions
from rotemina.sim.plate.stress import (
    YieldSafety,
    describe_place,
    principal_stresses,
    safety_at,
    surface_stress,
)
from rotemina.sim.robot import Plate
from rotemina.sim.units import format_percent

# Largest relative difference at which the plate agrees with the shipped robot.
AGREEMENT_TOLERANCE_RATIO = 0.05
# Largest ratio of deflection to thickness at which stretching of the plate is negligible.
MAX_LINEAR_DEFLECTION_RATIO = 0.5
# Smallest motion of the hub in one of its modes, for a largest deflection of 1 m. With less motion
# the mode is one of the plate itself.
_MIN_HUB_SHIFT_M, _MIN_HUB_TILT_RAD = 0.5, 20.0


def pose_text(pose: tuple[float, float, float]) -> str:
    """Return a motion of the hub as text in display units."""
    zn, thx, thy = pose
    return f"zn {1e6 * zn:.2f} µm, thx {1e6 * thx:.1f} µrad, thy {1e6 * thy:.1f} µrad"


def safety_text(safety: YieldSafety, plate: Plate) -> str:
    """Return the safety of the plate as text, with a warning if it yields."""
    text = (
        f"{1e-6 * safety.point.stress:.1f} MPa von Mises {describe_place(safety.point, plate)}; "
        f"safety {safety.factor:.2f} against yield at {1e-6 * plate.yield_stress:.0f} MPa"
    )
    return f"THE PLATE YIELDS: {text}" if safety.factor < 1.0 else text


def plate_lines(solutions: UnitSolutions) -> Iterator[str]:
    """Yield the dimensions and the stiffness of the plate, compared with the shipped robot."""
    plate, mesh = solutions.clamped.plate, solutions.clamped.mesh
    yield (
        f"plate   rim {1e3 * plate.rim_radius:g} mm, hub {1e3 * plate.hub_radius:g} mm, thickness "
        f"{1e3 * plate.thickness:g} mm, {len(plate.cutout)} rings of cut-outs"
    )
    yield f"mesh    {mesh.triangles.shape[1]} triangles, {solutions.unknowns} unknowns"
    entries = compare_with_shipped_robot(solutions)
    for entry in entries:
        yield f"{entry_text(entry)} (shipped robot: {entry.before:.6g})"
    agrees = all(abs(entry.difference) <= AGREEMENT_TOLERANCE_RATIO for entry in entries)
    verdict = "agree" if agrees else "DO NOT agree"
    tolerance = format_percent(AGREEMENT_TOLERANCE_RATIO)
    yield f"tilt and axial stiffness {verdict} with the shipped robot within {tolerance}"


def range_lines(safety: YieldSafety, plate: Plate) -> Iterator[str]:
    """Yield the minimum safety over the whole range of motion."""
    yield f"whole range of motion: {safety_text(safety, plate)}"
    yield f"  where it is least: {pose_text(safety.pose)}"


def ramp_lines(solutions: UnitSolutions, ramp: RampResponse) -> Iterator[str]:
    """Yield the state at the largest motion of the pin's bottom end."""
    plate = solutions.clamped.plate
    row = int(np.argmax(np.linalg.norm(ramp.bottom / _find_largest_values(ramp.bottom), axis=1)))
    zn, thx, thy = ramp.bottom[row]
    yield f"pin's bottom moved to {pose_text((zn, thx, thy))} in {ramp.time_s[-1]:g} s"
    zn, thx, thy = ramp.hub[row]
    yield f"  hub: {pose_text((zn, thx, thy))}"
    force, about_x, about_y = ramp.force[row]
    yield (
        f"  reaction: {force:.4g} N along the pin, {about_x:.4g} and {about_y:.4g} N m about x "
        "and y"
    )
    lowest_safety = min_safety_on_ramp(solutions, ramp)
    larger, smaller = principal_stresses(surface_stress(solutions, np.array(lowest_safety.pose)))
    yield f"  plate: {safety_text(lowest_safety, plate)}"
    largest_deflection = float(np.abs(np.array(lowest_safety.pose) @ solutions.deflection).max())
    if largest_deflection > MAX_LINEAR_DEFLECTION_RATIO * plate.thickness:
        yield (
            f"  BEYOND LINEAR THEORY: it bends by {1e6 * largest_deflection:.0f} µm, more than "
            f"half its thickness of {1e6 * plate.thickness:.0f} µm; the true plate is stiffer"
        )
    yield (
        f"  principal stress, both surfaces: ± {1e-6 * max(larger.max(), -smaller.min()):.1f} MPa"
    )
    pin = float(ramp.pin_stress.max())
    warning = "THE PIN YIELDS: " if pin > plate.pin.yield_stress else ""
    yield_mpa = 1e-6 * plate.pin.yield_stress
    yield f"  pin: {warning}{1e-6 * pin:.1f} MPa at its seat, yield {yield_mpa:.0f} MPa"
    max_force, max_moment, _ = friction_limits(plate.joint)
    yield (
        f"  seat: carries up to {max_force:.4g} N and {max_moment:.4g} N m; "
        f"{100.0 * ramp.utilization.max():.0f} % of its friction used, {_describe_slip(ramp)}"
    )


def mode_lines(modes: PlateModes) -> Iterator[str]:
    """Yield the natural frequencies, each with a description of the mode."""
    yield "eigenfrequencies, pin and hub riding on the plate"
    for number, (frequency, hub) in enumerate(
        zip(modes.frequencies_hz, modes.hub, strict=True), start=1
    ):
        yield f"  {number:2d}  {frequency:10.1f} Hz  {mode_name(hub)}"


def mode_name(hub: FloatArray) -> str:
    """Return the moving part of a mode as text, from the hub motion (zn m, thx rad, thy rad).

    The motion is scaled to a largest deflection of 1 m.
    """
    along, about_x, about_y = hub
    if abs(along) > _MIN_HUB_SHIFT_M:
        return "hub along the pin"
    if np.hypot(about_x, about_y) > _MIN_HUB_TILT_RAD:
        return f"hub tilts about {np.degrees(np.arctan2(about_y, about_x)) % 180.0:.0f}°"
    return "plate between hub and rim"


def entry_text(entry: RobotEntryChange) -> str:
    """Return one value of a robot file as text, with its relative change."""
    if np.isinf(entry.difference):
        return f"{entry.key:28} {entry.after:12.6g} {entry.unit:8} new"
    return f"{entry.key:28} {entry.after:12.6g} {entry.unit:8} {100.0 * entry.difference:+.2f} %"


def min_safety_on_ramp(solutions: UnitSolutions, ramp: RampResponse) -> YieldSafety:
    """Return the minimum safety during a ramp."""
    return min((safety_at(solutions, pose) for pose in ramp.hub), key=lambda safety: safety.factor)


def _describe_slip(ramp: RampResponse) -> str:
    if not ramp.has_slipped:
        return "it sticks throughout"
    along, about_x, about_y = ramp.slip[-1]
    first_slip_s = ramp.time_s[int(np.argmax(np.any(ramp.slip != 0.0, axis=1)))]
    return (
        f"SLIPS from {first_slip_s:.1f} s on, in the end by {1e6 * along:.2f} µm, "
        f"{1e6 * about_x:.1f} and {1e6 * about_y:.1f} µrad"
    )


def _find_largest_values(rows: FloatArray) -> FloatArray:
    largest = np.abs(rows).max(axis=0)
    return np.where(largest > 0.0, largest, 1.0)
