"""The plate in a robot file: entries, couplings, safety, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.export import write_vtu
from rotemina.sim.plate.plate_report import mode_lines, plate_lines, safety_text
from rotemina.sim.plate.robot_entries import applied
from rotemina.sim.plate.statics import hold, solve
from rotemina.sim.plate.stress import least_safety, motion_ranges, safety
from rotemina.sim.robot.errors import RobotFileError
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import Coupling
from rotemina.sim.robot.plate import Cutout, Plate
from rotemina.sim.robot.writing import robot_text

ROBOT = load_robot("rotemina")
CUT = Plate(
    thickness=0.0005,
    cutout=(
        Cutout(kind="slot", count=2, inner_radius=0.007, outer_radius=0.012, width=0.8, start=0.4),
        Cutout(kind="hole", count=8, circle_radius=0.0145, radius=0.001),
    ),
)


def test_plate_becomes_entries_of_the_robot(solutions):
    made, entries = applied(ROBOT, solutions)
    assert made.axes["zn"].stiffness == solutions.stiffness[0, 0]
    assert made.axes["thx"].stiffness == solutions.stiffness[1, 1]
    assert made.axes["zn"].damping == ROBOT.axes["zn"].damping
    assert made.axes["x"] == ROBOT.axes["x"]
    by_key = {entry.key: entry for entry in entries}
    assert set(by_key) == {
        *(f"axis.{n}.{k}" for n in ("zn", "thx", "thy") for k in ("stiffness", "mass")),
        "coupling.M[z, zn]",
        "coupling.M[thx, thy]",
    }
    # The shipped plate is chosen for the shipped robot.
    assert all(abs(entry.difference) < 0.05 for entry in entries)
    assert made.couplings[0].value == made.axes["zn"].mass
    assert parse_robot(robot_text(made)) == made


def test_cut_plate_couples_axes_in_stiffness():
    solutions = solve(hold(CUT, 48))
    made, entries = applied(replace(ROBOT, plate=CUT), solutions)
    couplings = {(c.matrix, c.axes): c.value for c in made.couplings}
    assert couplings["C", ("thx", "thy")] == solutions.stiffness[1, 2]
    new = [entry for entry in entries if entry.difference == float("inf")]
    assert "coupling.C[thx, thy]" in [entry.key for entry in new]
    assert parse_robot(robot_text(made)) == made


def test_coupling_that_the_plate_has_not_goes(solutions):
    extra = Coupling(matrix="C", axes=("zn", "thx"), value=3.0)
    damping = Coupling(matrix="D", axes=("thx", "thy"), value=1e-5)
    robot = replace(ROBOT, couplings=(*ROBOT.couplings, extra, damping))
    made, entries = applied(robot, solutions)
    assert damping in made.couplings
    assert not any(c.axes == ("zn", "thx") for c in made.couplings)
    gone = next(entry for entry in entries if entry.key == "coupling.C[zn, thx]")
    assert (gone.before, gone.after, gone.difference) == (3.0, 0.0, -1.0)


def test_plate_that_yields_in_its_range_is_refused_with_the_place(solutions):
    weak = replace(ROBOT.plate, yield_stress=2.0e8)
    held = replace(solutions.held, plate=weak)
    with pytest.raises(
        PlateError, match=r"yields .*: 278 MPa at the hub, .* yield strength is 200"
    ):
        applied(replace(ROBOT, plate=weak), replace(solutions, held=held))


def test_robots_without_what_the_plate_needs_are_refused(solutions):
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
    with pytest.raises(PlateError, match=r"axis\.zn has no mass and stiffness of its own"):
        applied(replace(ROBOT, axes={**ROBOT.axes, "zn": zn}), solutions)


def test_least_safety_is_at_a_corner(solutions):
    ranges = motion_ranges(ROBOT)
    least = least_safety(solutions, ranges)
    assert 3.0 < least.factor < 4.0
    rng = np.random.default_rng(3)
    for share in rng.uniform(0.0, 1.0, (40, 3)):
        pose = ranges[:, 0] + share * np.ptp(ranges, axis=1)
        assert safety(solutions, pose).factor > least.factor
    assert "at the hub" in safety_text(least, ROBOT.plate)


def test_report_says_that_the_shipped_plate_agrees(solutions):
    text = "\n".join(plate_lines(solutions))
    assert "tilt and axial stiffness agree with the shipped robot within 5 %" in text
    thick = replace(solutions, stiffness=1.1 * solutions.stiffness)
    assert "DO NOT agree" in "\n".join(plate_lines(thick))


def test_modes_are_named(modes):
    said = list(mode_lines(modes))
    assert [line.split("Hz")[1].strip() for line in said[1:]] == [
        "hub tilts about 45°",
        "hub tilts about 135°",
        "hub along the pin",
        "plate between hub and rim",
    ]


def test_vtu_reads_back(solutions, modes, tmp_path):
    import meshio

    path = tmp_path / "plate.vtu"
    write_vtu(path, solutions, np.array([65e-6, 0.0, 0.0]), modes)
    read = meshio.read(path)
    assert pytest.approx(solutions.held.mesh.points) == read.points[:, :2].T
    assert read.cells_dict["triangle"].T.tolist() == solutions.held.mesh.triangles.tolist()
    assert read.point_data["displacement"][:, 2].max() == pytest.approx(65e-6)
    assert read.point_data["von_mises"].max() == pytest.approx(208e6, rel=0.01)
    assert sum(name.startswith("mode_") for name in read.point_data) == 4
    with pytest.raises(PlateError, match=r"must end with \.vtu"):
        write_vtu(tmp_path / "plate.obj", solutions, np.zeros(3))


FILE = robot_text(ROBOT)


def test_plate_of_a_robot_file_reads_back():
    robot = replace(ROBOT, plate=CUT)
    text = robot_text(robot)
    assert "[[plate.cutout]]" in text
    assert parse_robot(text) == robot


@pytest.mark.parametrize(
    ("section", "said"),
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
def test_robot_files_with_an_impossible_plate_are_refused(section, said):
    with pytest.raises(RobotFileError, match=said):
        parse_robot(f"{FILE}\n{section}\n")
