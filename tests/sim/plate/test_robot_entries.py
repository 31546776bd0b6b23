"""The plate in a robot file: entries, couplings, safety and refusals."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import PlateError, RobotFileError
from rotemina.sim.messages import Message
from rotemina.sim.plate import (
    StressPoint,
    apply_plate,
    clamp_plate,
    find_min_safety,
    mode_lines,
    motion_ranges,
    plate_lines,
    safety_at,
    solve_unit_motions,
    write_vtu,
)
from rotemina.sim.plate.plate_report import safety_text
from rotemina.sim.plate.stress import describe_place
from rotemina.sim.robot import AxisCoupling, Plate, PlateCutout
from rotemina.sim.robot_files import format_robot, load_robot, parse_robot

ROBOT = load_robot("rotemina")
PLATE_WITH_CUTOUTS = Plate(
    thickness=0.0005,
    cutout=(
        PlateCutout(
            kind="slot", count=2, inner_radius=0.007, outer_radius=0.012, width=0.8, start=0.4
        ),
        PlateCutout(kind="hole", count=8, circle_radius=0.0145, radius=0.001),
    ),
)


def test_the_plate_becomes_entries_of_the_robot(solutions):
    robot_with_plate, entries = apply_plate(ROBOT, solutions)
    assert robot_with_plate.axes["zn"].stiffness == solutions.stiffness[0, 0]
    assert robot_with_plate.axes["thx"].stiffness == solutions.stiffness[1, 1]
    assert robot_with_plate.axes["zn"].damping == ROBOT.axes["zn"].damping
    assert robot_with_plate.axes["x"] == ROBOT.axes["x"]
    by_key = {entry.key: entry for entry in entries}
    assert set(by_key) == {
        *(f"axis.{n}.{k}" for n in ("zn", "thx", "thy") for k in ("stiffness", "mass")),
        "coupling.M[z, zn]",
        "coupling.M[thx, thy]",
    }
    # The shipped plate matches the shipped robot.
    assert all(abs(entry.difference) < 0.05 for entry in entries)
    assert robot_with_plate.couplings[0].value == robot_with_plate.axes["zn"].mass
    assert parse_robot(format_robot(robot_with_plate)) == robot_with_plate


def test_a_plate_with_cutouts_couples_axes_in_stiffness():
    solutions = solve_unit_motions(clamp_plate(PLATE_WITH_CUTOUTS, 48))
    robot_with_plate, entries = apply_plate(replace(ROBOT, plate=PLATE_WITH_CUTOUTS), solutions)
    couplings = {(c.matrix, c.axes): c.value for c in robot_with_plate.couplings}
    assert couplings["C", ("thx", "thy")] == solutions.stiffness[1, 2]
    new = [entry for entry in entries if entry.difference == float("inf")]
    assert "coupling.C[thx, thy]" in [entry.key for entry in new]
    assert parse_robot(format_robot(robot_with_plate)) == robot_with_plate


def test_couplings_that_the_plate_does_not_have_are_removed(solutions):
    extra = AxisCoupling(matrix="C", axes=("zn", "thx"), value=3.0)
    damping = AxisCoupling(matrix="D", axes=("thx", "thy"), value=1e-5)
    robot = replace(ROBOT, couplings=(*ROBOT.couplings, extra, damping))
    robot_with_plate, entries = apply_plate(robot, solutions)
    assert damping in robot_with_plate.couplings
    assert not any(c.axes == ("zn", "thx") for c in robot_with_plate.couplings)
    removed = next(entry for entry in entries if entry.key == "coupling.C[zn, thx]")
    assert (removed.before, removed.after, removed.difference) == (3.0, 0.0, -1.0)


def test_a_plate_that_yields_within_the_range_is_refused_with_the_place(solutions):
    weak_plate = replace(ROBOT.plate, yield_stress=2.0e8)
    clamped = replace(solutions.clamped, plate=weak_plate)
    with pytest.raises(
        PlateError, match=r"yields .*: 278 MPa at the hub, .* yield strength is 200"
    ):
        apply_plate(replace(ROBOT, plate=weak_plate), replace(solutions, clamped=clamped))


def test_robots_that_lack_entries_for_the_plate_are_refused(solutions):
    axes = {name: axis for name, axis in ROBOT.axes.items() if name != "thy"}
    with pytest.raises(PlateError, match="has no axis thy"):
        motion_ranges(replace(ROBOT, axes=axes))
    zn = replace(
        ROBOT.axes["zn"],
        mass=None,
        damping=None,
        stiffness=None,
        natural_frequency_hz=420.0,
        damping_ratio=0.02,
    )
    with pytest.raises(PlateError, match=r"axis\.zn has no mass and stiffness that"):
        apply_plate(replace(ROBOT, axes={**ROBOT.axes, "zn": zn}), solutions)


def test_the_minimum_safety_is_at_a_corner_of_the_range(solutions):
    ranges = motion_ranges(ROBOT)
    min_safety = find_min_safety(solutions, ranges)
    assert 3.0 < min_safety.factor < 4.0
    rng = np.random.default_rng(3)
    for share in rng.uniform(0.0, 1.0, (40, 3)):
        pose = ranges[:, 0] + share * np.ptp(ranges, axis=1)
        assert safety_at(solutions, pose).factor > min_safety.factor
    assert "at the hub" in safety_text(min_safety, ROBOT.plate)


@pytest.mark.parametrize(
    ("share", "place"), [(0.0, "at the hub"), (0.5, "between hub and rim"), (1.0, "at the rim")]
)
def test_every_place_on_the_plate_is_a_translatable_message(solutions, share, place):
    plate = solutions.clamped.plate
    radius = plate.hub_radius + share * (plate.rim_radius - plate.hub_radius)
    text = describe_place(StressPoint(1e6, radius, 0.0), plate)
    where = dict(text.fields)["where"]
    assert isinstance(where, Message)
    assert where == place


def test_the_report_states_whether_the_plate_matches_the_shipped_robot(solutions):
    text = "\n".join(plate_lines(solutions))
    assert "tilt and axial stiffness agree with the shipped robot within 5 %" in text
    thick = replace(solutions, stiffness=1.1 * solutions.stiffness)
    assert "DO NOT agree" in "\n".join(plate_lines(thick))


def test_modes_are_named(modes):
    lines = list(mode_lines(modes))
    assert [line.split("Hz")[1].strip() for line in lines[1:]] == [
        "hub tilts about 45°",
        "hub tilts about 135°",
        "hub along the pin",
        "plate between hub and rim",
    ]


def test_a_vtu_file_can_be_read_back(solutions, modes, tmp_path):
    import meshio

    path = tmp_path / "plate.vtu"
    write_vtu(path, solutions, np.array([65e-6, 0.0, 0.0]), modes)
    vtu = meshio.read(path)
    assert pytest.approx(solutions.clamped.mesh.points) == vtu.points[:, :2].T
    assert vtu.cells_dict["triangle"].T.tolist() == solutions.clamped.mesh.triangles.tolist()
    assert vtu.point_data["displacement"][:, 2].max() == pytest.approx(65e-6)
    assert vtu.point_data["von_mises"].max() == pytest.approx(208e6, rel=0.01)
    assert sum(name.startswith("mode_") for name in vtu.point_data) == 4
    with pytest.raises(PlateError, match=r"must end with \.vtu"):
        write_vtu(tmp_path / "plate.obj", solutions, np.zeros(3))


ROBOT_TEXT = format_robot(ROBOT)


def test_the_plate_of_a_robot_file_can_be_read_back():
    robot = replace(ROBOT, plate=PLATE_WITH_CUTOUTS)
    text = format_robot(robot)
    assert "[[plate.cutout]]" in text
    assert parse_robot(text) == robot


@pytest.mark.parametrize(
    ("section", "message"),
    [
        ("[plate]\nthickness = -0.001", r"plate\.thickness = -0\.001: must be greater than 0"),
        ("[plate]\nthicknes = 0.001", r"unknown key; did you mean 'thickness'\?"),
        ("[plate]\nhub_radius = 0.018", r"plate\.hub_radius = 0\.018: must be at most 0\.98"),
        ("[plate]\npoissons_ratio = 0.6", r"plate\.poissons_ratio = 0\.6: must be at most 0\.5"),
        ("[plate.pin]\ndiametre = 0.003", r"unknown key; did you mean 'diameter'\?"),
        ("[[plate.cutout]]\nkind = 'slit'\ncount = 2", r"plate\.cutout\[0\]\.kind = 'slit'"),
        ("[[plate.cutout]]\nkind = 'hole'\ncount = 2", r"cutout\[0\]\.circle_radius: missing"),
        ("[[plate.cutout]]\nkind = 'hole'\ncount = 0", r"count = 0: must be at least 1"),
    ],
)
def test_robot_files_with_an_impossible_plate_are_refused(section, message):
    with pytest.raises(RobotFileError, match=message):
        parse_robot(f"{ROBOT_TEXT}\n{section}\n")
