"""Text about a solved plate."""

import numpy as np

from rotemina.app.display_units import label
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.solution import Solved
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.plate_report import TOLERANCE, mode_name
from rotemina.sim.plate.robot_entries import agreement
from rotemina.sim.plate.stress import Safety, StressPoint, safety
from rotemina.sim.quantities import fixed, percent
from rotemina.sim.robot.plate import Plate

MESHES = ((mark("Coarse mesh"), 60), (mark("Default mesh"), 120), (mark("Fine mesh"), 240))
_NEAR = 0.02  # of the way from hub to rim
AXES = (("zn", "µm", 1e6), ("thx", "µrad", 1e6), ("thy", "µrad", 1e6))
EMPTY = mark("Solve the plate of this robot to see its stress, its deformation and its modes.")


# What moves in a mode, as the model says it.
MODES = (mark("hub along the pin"), mark("plate between hub and rim"))
_TILTS = "hub tilts about "


def pose_lines(solved: Solved, pose: FloatArray) -> str:
    """Say what the plate bears and answers at a pose of the hub."""
    solutions = solved.solutions
    found = safety(solutions, pose)
    force, about_x, about_y = solutions.stiffness @ pose
    reaction = tr("Reaction {force:.1f} N; {x:.1f} and {y:.1f} N mm about x and y")
    lines = [reaction.format(force=force, x=1e3 * about_x, y=1e3 * about_y)]
    if np.any(pose):
        lines.insert(0, safety_text(found, solutions.held.plate))
    return "\n".join(lines)


def safety_text(found: Safety, plate: Plate) -> str:
    """Say how safe the plate is, and whether it yields."""
    text = tr(
        "{stress:.1f} MPa von Mises {place}; safety {factor:.2f} against yield at {limit:.0f} MPa"
    )
    said = text.format(
        stress=1e-6 * found.point.stress,
        place=place_text(found.point, plate),
        factor=found.factor,
        limit=1e-6 * plate.yield_stress,
    )
    if found.factor < 1.0:
        return tr("THE PLATE YIELDS: {said}").format(said=said)
    return said


def place_text(point: StressPoint, plate: Plate) -> str:
    """Say where on the plate a place is."""
    share = (point.radius - plate.hub_radius) / (plate.rim_radius - plate.hub_radius)
    text = tr("between, r {radius:.2f} mm, {degrees:.0f}°")
    if share < _NEAR:
        text = tr("at the hub, r {radius:.2f} mm, {degrees:.0f}°")
    elif share > 1.0 - _NEAR:
        text = tr("at the rim, r {radius:.2f} mm, {degrees:.0f}°")
    degrees = np.degrees(point.direction) % 360.0
    return text.format(radius=1e3 * point.radius, degrees=degrees)


def plate_text(solved: Solved) -> str:
    """Say how stiff and how safe the plate is over the whole range of motion."""
    solutions = solved.solutions
    axial, tilt_x, tilt_y = np.diag(solutions.stiffness)
    far = max(abs(entry.difference) for entry in agreement(solutions))
    agrees = tr(
        "{axial:.3f} N/µm along the pin; {x:.4g} and {y:.4g} N m/rad in tilt: they agree with the "
        "shipped robot within {tolerance}"
    )
    differs = tr(
        "{axial:.3f} N/µm along the pin; {x:.4g} and {y:.4g} N m/rad in tilt: they do not agree "
        "with the shipped robot within {tolerance}"
    )
    stiff = agrees if far <= TOLERANCE else differs
    whole = tr("Whole range: {safety}, at {pose}")
    pose = ", ".join(
        f"{label(name)} {fixed(per_si * value, 1)} {unit}"
        for (name, unit, per_si), value in zip(AXES, solved.least.pose, strict=True)
    )
    return "\n".join(
        [
            stiff.format(axial=1e-6 * axial, x=tilt_x, y=tilt_y, tolerance=percent(TOLERANCE)),
            whole.format(safety=safety_text(solved.least, solutions.held.plate), pose=pose),
        ]
    )


def mode_titles(solved: Solved) -> list[str]:
    """Return a title for each mode."""
    modes = solved.modes
    return [
        f"{number}  {fixed(frequency, 0)} Hz  {_mode(mode_name(hub))}"
        for number, (frequency, hub) in enumerate(
            zip(modes.frequencies_hz, modes.hub, strict=True), start=1
        )
    ]


def yields(solved: Solved, pose: FloatArray) -> bool:
    """Whether the plate yields at a pose."""
    return safety(solved.solutions, pose).factor < 1.0


def _mode(name: str) -> str:
    about = name.removeprefix(_TILTS)
    if about != name:
        return tr("hub tilts about {angle}").format(angle=about)
    return tr(name)
