"""Robot files: loading, and refusals with file, key, value and bound."""

import pytest

from rotemina.sim.errors import RobotFileError
from rotemina.sim.robot import ForceAxis
from rotemina.sim.robot_files import (
    list_nominal_robots,
    list_shipped_robots,
    load_robot,
    parse_robot,
)

MINIMAL = """
[robot]
name = "one"
axes = ["a"]

[axis.a]
kind = "stepper"
range = [0.0, 1.0]
mass = 2.0
damping = 3.0
stiffness = 400.0
"""

PIEZO = """
[robot]
name = "two"
axes = ["p", "s"]

[axis.p]
kind = "piezo"
range = [0.0, 50e-6]
voltage_range = [0.0, 100.0]
gain = 5e-7
mass = 0.1
damping = 1.0
stiffness = 1e5
sensor.kind = "strain_gauge"
sensor.resolution = 3e-9
sensor.noise_rms = 4e-9

[axis.s]
kind = "piezo"
range = [0.0, 50e-6]
gain = 5e-7
static = true
"""

CONTROLLED = """
[robot]
name = "three"
axes = ["q"]

[axis.q]
kind = "force"
range = [0.0, 1.0]
voltage_range = [-10.0, 10.0]
gain = 30.0
mass = 90.0
damping = 400.0

[axis.q.controller]
kind = "cascade"
kp = 100.0
kv = 200.0
limit = 10.0
"""


def test_every_shipped_robot_loads():
    assert list_shipped_robots() == ("emps", "fsm", "picma", "rotemina", "rotemina_worn", "xyz")
    for name in list_shipped_robots():
        assert load_robot(name).axes
        assert (name in list_nominal_robots()) == (not load_robot(name).effects)
    assert isinstance(load_robot("emps").axes["q"], ForceAxis)
    assert load_robot("emps").axes["q"].controller.velocity == "backward"


def test_the_shipped_robot_file_matches_the_specification(shared_dir):
    shared = (shared_dir / "spec" / "robot.toml").read_text("utf-8")
    assert parse_robot(shared) == load_robot("rotemina")


def test_any_number_and_names_of_axes_are_accepted():
    robot = parse_robot(MINIMAL.replace('"a"', '"θ-17"').replace("axis.a", 'axis."θ-17"'))
    assert list(robot.axes) == ["θ-17"]
    assert robot.unit("θ-17") is None


@pytest.mark.parametrize(
    ("text", "old", "new", "message"),
    [
        (MINIMAL, "mass = 2.0", "mas = 2.0", r"axis\.a\.mas = 2\.0: unknown key; .*'mass'"),
        (MINIMAL, "mass = 2.0", "mass = -2.0", r"axis\.a\.mass = -2\.0: .*greater than 0"),
        (MINIMAL, "mass = 2.0", "mass = true", r"axis\.a\.mass = True: must be a number"),
        (MINIMAL, "mass = 2.0", 'mass = "2"', r"axis\.a\.mass = '2': must be a number"),
        (MINIMAL, "mass = 2.0", "mass = nan", r"axis\.a\.mass = nan: must be a finite"),
        (MINIMAL, "damping = 3.0", "damping = -1", r"axis\.a\.damping = -1: .*at least 0"),
        (MINIMAL, "stiffness = 400.0", "", r"axis\.a\.stiffness: missing; .*'stepper' needs"),
        (MINIMAL, "[0.0, 1.0]", "[1.0, 1.0]", r"axis\.a\.range = \[1\.0, 1\.0\]: .*below"),
        (MINIMAL, "[0.0, 1.0]", "[1.0]", r"axis\.a\.range\[1\]: missing"),
        (MINIMAL, '"stepper"', '"servo"', r"axis\.a\.kind = 'servo': .*'stepper', 'piezo'"),
        (MINIMAL, 'kind = "stepper"', "", r"axis\.a\.kind: missing"),
        (MINIMAL, 'axes = ["a"]', 'axes = ["a", "b"]', r"robot\.axes = b: .*\[axis\.b\]"),
        (MINIMAL, 'axes = ["a"]', "axes = []", r"robot\.axes = .*at least one"),
        (MINIMAL, 'axes = ["a"]', 'axes = ["a", "a"]', r"robot\.axes .*once"),
        (MINIMAL, "[0.0, 1.0]", "[-1e300, 1e300]", r"axis\.a\.range\[0\] = -1e\+300: .*-1000000"),
        (MINIMAL, 'axes = ["a"]', 'axes = ["#a"]', r"."),
        (MINIMAL, 'name = "one"', "", r"robot\.name: missing"),
        (MINIMAL, 'name = "one"', "name = 3", r"robot\.name = 3: must be text"),
        (MINIMAL, "[robot]", "[robt]\nx = 1\n[robot]", r"robt = .*: unknown key; .*'robot'"),
        (MINIMAL, "mass = 2.0", "natural_frequency_hz = 9.0", r"damping = 3\.0: .*not both"),
        (MINIMAL, "mass = 2.0", "mass = 2.0\npitch = 0.001", r"steps_per_rev: missing; .*together"),
        (MINIMAL, "mass = 2.0", "mass = 2.0\nstatic = true", r"a\.mass = 2\.0: .*static"),
        (MINIMAL, "[robot]", "[robot", r"not valid TOML: .*line 2"),
        (MINIMAL, 'axes = ["a"]', 'axes = ["a"]\nstages.m = ["b"]', r"stages\.m = b: .*one of"),
        (PIEZO, "gain = 5e-7\nmass", "gain = 0.0\nmass", r"axis\.p\.gain = 0\.0: .*not be zero"),
        (PIEZO, "[0.0, 100.0]", "[0.0, 50.0]", r"axis\.p\.range = .*reaches only"),
        (PIEZO, "[0.0, 100.0]", "[9.0, 0.0]", r"axis\.p\.voltage_range = .*below"),
        (PIEZO, "resolution = 3e-9", "resolution = 1.0", r"sensor\.resolution = 1\.0: .*below"),
        (PIEZO, "noise_rms = 4e-9", "noise = 4e-9", r"axis\.p\.sensor\.noise = .*'noise_rms'"),
        (PIEZO, "static = true", "static = 1", r"axis\.s\.static = 1: must be true or false"),
        (CONTROLLED, "limit = 10.0", "limit = 11.0", r"controller\.limit = 11\.0: .*10 V"),
        (CONTROLLED, '"cascade"', '"pid"', r"controller\.kind = 'pid': must be 'cascade'"),
        (CONTROLLED, "kp = 100.0", "kp = 1\ndelay_s = 2.0", r"delay_s = 2\.0: must be at most 1"),
        (CONTROLLED, "kp = 100.0", "kp = 0.0", r"controller\.kp = 0\.0: .*greater than 0"),
        (CONTROLLED, "mass = 90.0", "mass = 90.0\nstatic = true", r"static = True: .*'force'"),
    ],
)
def test_a_wrong_value_is_refused_with_file_key_value_and_bound(text, old, new, message):
    assert old in text
    with pytest.raises(RobotFileError, match=r"^lab\.toml: .*" + message):
        parse_robot(text.replace(old, new, 1), source="lab.toml")


@pytest.mark.parametrize("name", ["#x", "-x", "a,b", "x" * 201, ""])
def test_an_axis_name_that_no_record_can_have_is_refused(name):
    text = MINIMAL.replace('"a"', f'"{name}"').replace("axis.a", f'axis."{name}"')
    with pytest.raises(RobotFileError, match=r"robot\.axes"):
        parse_robot(text)


def add_coupling(matrix, value, axes='["a", "b"]'):
    second = MINIMAL[MINIMAL.index("[axis.a]") :].replace("axis.a", "axis.b")
    text = MINIMAL.replace('axes = ["a"]', 'axes = ["a", "b"]') + second
    return text + f'\n[[coupling]]\nmatrix = "{matrix}"\naxes = {axes}\nvalue = {value}\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (add_coupling("M", 2.5), r"coupling = \[2\.5\]: M must be positive definite"),
        (add_coupling("C", 401.0), r"coupling = \[401\.0\]: C must be positive semi-definite"),
        (add_coupling("K", 1.0), r"coupling\[0\]\.matrix = 'K': must be 'M', 'D' or 'C'"),
        (add_coupling("M", 0.1, '["a", "c"]'), r"coupling\[0\]\.axes = c: must be one of"),
        (add_coupling("M", 0.1, '["a", "a"]'), r"coupling\[0\]\.axes = .*two different"),
    ],
)
def test_an_impossible_coupling_is_refused(text, message):
    with pytest.raises(RobotFileError, match=message):
        parse_robot(text)


def test_a_coupling_is_symmetric():
    from rotemina.sim.robot import assemble_inertia_matrices

    _, mass, _, _ = assemble_inertia_matrices(parse_robot(add_coupling("M", 0.5)))
    assert mass.tolist() == [[2.0, 0.5], [0.5, 2.0]]


@pytest.mark.parametrize("kind", ["missing", "folder", "binary", "huge"])
def test_a_file_that_is_no_robot_file_is_refused(tmp_path, kind):
    path = tmp_path / "robot.toml"
    if kind == "folder":
        path.mkdir()
    elif kind == "binary":
        path.write_bytes(b"[robot]\nname = '\xff\xfe'")
    elif kind == "huge":
        path.write_bytes(b"#" * 5_000_000)
    with pytest.raises(RobotFileError, match=r"robot\.toml"):
        load_robot(path)
