"""What a solved plate amounts to, in words and figures for people."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.modes import Modes
from rotemina.sim.plate.quasi_static_ramp import Ramp
from rotemina.sim.plate.robot_entries import Entry, agreement
from rotemina.sim.plate.seat_friction import limits
from rotemina.sim.plate.statics import UnitSolutions
from rotemina.sim.plate.stress import Safety, place_text, principal, safety, surface_stress
from rotemina.sim.quantities import percent
from rotemina.sim.robot.plate import Plate

TOLERANCE = 0.05  # within which a plate is said to agree with the shipped robot
LINEAR = 0.5  # of the thickness is how far a plate bends without stretching that counts
# Of the hub, for a largest deflection of 1 m: less is the plate's own mode.
_MOVES, _TURNS = 0.5, 20.0


def pose_text(pose: tuple[float, float, float]) -> str:
    """Say a motion of the hub in the units of screens."""
    zn, thx, thy = pose
    return f"zn {1e6 * zn:.2f} µm, thx {1e6 * thx:.1f} µrad, thy {1e6 * thy:.1f} µrad"


def safety_text(found: Safety, plate: Plate) -> str:
    """Say how safe the plate is, and whether it yields."""
    said = (
        f"{1e-6 * found.point.stress:.1f} MPa von Mises {place_text(found.point, plate)}; safety "
        f"{found.factor:.2f} against yield at {1e-6 * plate.yield_stress:.0f} MPa"
    )
    return f"THE PLATE YIELDS: {said}" if found.factor < 1.0 else said


def plate_lines(solutions: UnitSolutions) -> Iterator[str]:
    """Yield what the plate is and how stiff, beside the shipped robot."""
    plate, mesh = solutions.held.plate, solutions.held.mesh
    yield (
        f"plate   rim {1e3 * plate.rim_radius:g} mm, hub {1e3 * plate.hub_radius:g} mm, thickness "
        f"{1e3 * plate.thickness:g} mm, {len(plate.cutout)} rings of cut-outs"
    )
    yield f"mesh    {mesh.triangles.shape[1]} triangles, {solutions.unknowns} unknowns"
    entries = agreement(solutions)
    for entry in entries:
        yield f"{entry_text(entry)} (shipped robot: {entry.before:.6g})"
    agrees = all(abs(entry.difference) <= TOLERANCE for entry in entries)
    word = "agree" if agrees else "DO NOT agree"
    yield f"tilt and axial stiffness {word} with the shipped robot within {percent(TOLERANCE)}"


def range_lines(least: Safety, plate: Plate) -> Iterator[str]:
    """Yield the least safety over the whole range of motion."""
    yield f"whole range of motion: {safety_text(least, plate)}"
    yield f"  where it is least: {pose_text(least.pose)}"


def ramp_lines(solutions: UnitSolutions, ramp: Ramp) -> Iterator[str]:
    """Yield what happened while the pin's bottom moved, at its greatest."""
    plate = solutions.held.plate
    far = int(np.argmax(np.linalg.norm(ramp.bottom / _scale(ramp.bottom), axis=1)))
    zn, thx, thy = ramp.bottom[far]
    yield f"pin's bottom moved to {pose_text((zn, thx, thy))} in {ramp.time_s[-1]:g} s"
    zn, thx, thy = ramp.hub[far]
    yield f"  hub: {pose_text((zn, thx, thy))}"
    force, about_x, about_y = ramp.force[far]
    yield (
        f"  reaction: {force:.4g} N along the pin, {about_x:.4g} and {about_y:.4g} N m about x "
        "and y"
    )
    worst = worst_on(solutions, ramp)
    larger, smaller = principal(surface_stress(solutions, np.array(worst.pose)))
    yield f"  plate: {safety_text(worst, plate)}"
    bent = float(np.abs(np.array(worst.pose) @ solutions.deflection).max())
    if bent > LINEAR * plate.thickness:
        yield (
            f"  BEYOND LINEAR THEORY: it bends by {1e6 * bent:.0f} µm, more than half its "
            f"thickness of {1e6 * plate.thickness:.0f} µm; the true plate is stiffer"
        )
    yield (
        f"  principal stress, both surfaces: ± {1e-6 * max(larger.max(), -smaller.min()):.1f} MPa"
    )
    pin = float(ramp.pin_stress.max())
    word = "THE PIN YIELDS: " if pin > plate.pin.yield_stress else ""
    yields = 1e-6 * plate.pin.yield_stress
    yield f"  pin: {word}{1e-6 * pin:.1f} MPa at its seat, yield {yields:.0f} MPa"
    most_force, most_moment, _ = limits(plate.joint)
    yield (
        f"  seat: carries up to {most_force:.4g} N and {most_moment:.4g} N m; "
        f"{100.0 * ramp.utilization.max():.0f} % of its friction used, {_slip_text(ramp)}"
    )


def mode_lines(modes: Modes) -> Iterator[str]:
    """Yield the eigenfrequencies, each with what moves."""
    yield "eigenfrequencies, pin and hub riding on the plate"
    for number, (frequency, hub) in enumerate(
        zip(modes.frequencies_hz, modes.hub, strict=True), start=1
    ):
        yield f"  {number:2d}  {frequency:10.1f} Hz  {mode_name(hub)}"


def mode_name(hub: FloatArray) -> str:
    """Say what moves in a mode whose hub moves by (zn m, thx rad, thy rad), of 1 m at most."""
    along, about_x, about_y = hub
    if abs(along) > _MOVES:
        return "hub along the pin"
    if np.hypot(about_x, about_y) > _TURNS:
        return f"hub tilts about {np.degrees(np.arctan2(about_y, about_x)) % 180.0:.0f}°"
    return "plate between hub and rim"


def entry_text(entry: Entry) -> str:
    """Say one figure of a robot file and how far it is from what it was."""
    if np.isinf(entry.difference):
        return f"{entry.key:28} {entry.after:12.6g} {entry.unit:8} new"
    return f"{entry.key:28} {entry.after:12.6g} {entry.unit:8} {100.0 * entry.difference:+.2f} %"


def worst_on(solutions: UnitSolutions, ramp: Ramp) -> Safety:
    """Return the least safety on a ramp."""
    return min((safety(solutions, pose) for pose in ramp.hub), key=lambda one: one.factor)


def _slip_text(ramp: Ramp) -> str:
    if not ramp.slipped:
        return "it sticks throughout"
    along, about_x, about_y = ramp.slip[-1]
    first = ramp.time_s[int(np.argmax(np.any(ramp.slip != 0.0, axis=1)))]
    return (
        f"SLIPS from {first:.1f} s on, in the end by {1e6 * along:.2f} µm, {1e6 * about_x:.1f} and "
        f"{1e6 * about_y:.1f} µrad"
    )


def _scale(rows: FloatArray) -> FloatArray:
    largest = np.abs(rows).max(axis=0)
    return np.where(largest > 0.0, largest, 1.0)
