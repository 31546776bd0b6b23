"""Forces at the joints: they balance, act and react, and account for all energy."""

from dataclasses import fields, replace

import numpy as np
import pytest

from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.joint_loads import JointLoads, RunningLoads, joint_loads
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
ROBOT_AXES = tuple(ROBOT.axes)
STATIC = """
[robot]
name = "static"
axes = ["x", "y"]
[axis.x]
kind = "piezo"
static = true
range = [0.0, 1.0]
gain = 0.5
[axis.y]
kind = "force"
range = [-1.0, 1.0]
gain = 2.0
force_offset = 0.5
mass = 3.0
damping = 1.0
stiffness = 100.0
"""
EFFECTS = (
    AxisEffect(axis="z", id="friction"),
    AxisEffect(axis="thx", id="hysteresis"),
    AxisEffect(axis="thy", id="delay"),
)


def swing(plant, time_s, hz=20.0):
    low, high = np.array([axis.range for axis in plant.robot.axes.values()]).T
    size = np.minimum(0.2 * (high - low), 1e-4)
    phase = 2.0 * np.pi * hz * time_s[:, None] + np.arange(len(low))
    return 0.5 * (low + high) + size * (np.sin(phase) - np.sin(phase[0]))


def run(robot, time_s, perturbation=None, command=None, inputs=None):
    plant = Plant.of(robot)
    command = swing(plant, time_s) if command is None else command
    inputs = plant.open_loop_inputs(command) if inputs is None else inputs
    state = plant.at_rest(time_s[0], command[0])
    motion, _ = plant.advance(state, time_s, command, inputs=inputs, perturbation=perturbation)
    return plant, motion, joint_loads(plant, time_s, motion, perturbation)


def shaking(rows, axes):
    rng = np.random.default_rng(1)
    a, b = 1e-4 * rng.uniform(-1.0, 1.0, (2, axes, axes))
    return Perturbation(rng.normal(size=(rows, axes)), a, b)


@pytest.mark.parametrize("effects", [(), EFFECTS], ids=["nominal", "effects"])
def test_all_forces_balance(effects):
    time_s = np.arange(400) / 2000
    _, _, loads = run(replace(ROBOT, effects=effects), time_s, shaking(400, 6))
    left = loads.inertia + loads.damping + loads.stiffness
    right = loads.actuation + loads.constant + loads.perturbation + loads.rest
    assert np.abs(left - right).max(axis=0) == pytest.approx(
        np.zeros(6), abs=1e-12 * np.abs(loads.stiffness).max()
    )
    disturbed = ("z", "thx", "thy", "zn") if effects else ()  # zn rides on z
    found = tuple(name for name, rest in zip(ROBOT.axes, loads.rest.T, strict=True) if rest.any())
    assert set(found) == set(disturbed)


def test_the_acceleration_is_how_the_velocity_changes():
    """Just after a sample the velocity grows as said: found with samples 0.1 µs apart."""
    coarse = np.arange(50) / 1000
    time_s = np.sort(np.concatenate([coarse, coarse + 1e-7]))
    plant = Plant.of(ROBOT)
    command = np.repeat(swing(plant, coarse), 2, axis=0)
    shaken = shaking(50, 6)
    shaken = replace(shaken, acceleration=np.repeat(shaken.acceleration, 2, axis=0))
    _, motion, loads = run(ROBOT, time_s, shaken, command)
    slope = (motion.velocity[1::2] - loads.velocity[::2]) / 1e-7
    worst = np.abs(slope - loads.acceleration[::2]).max(axis=0)
    assert (worst < 1e-3 * np.abs(loads.acceleration).max(axis=0)).all()


def test_at_rest_springs_hold_what_the_actuators_push():
    time_s, plant = np.arange(5) / 1000, Plant.of(ROBOT)
    command = np.tile(swing(plant, np.zeros(1)), (5, 1))
    _, motion, loads = run(ROBOT, time_s, command=command)
    assert loads.stiffness == pytest.approx(loads.actuation, rel=1e-12)
    stiffness = np.array([axis.inertia.stiffness for axis in ROBOT.axes.values()])
    assert loads.stiffness == pytest.approx(stiffness * motion.position, rel=1e-12)
    assert np.abs(loads.damping).max() < 1e-12 * np.abs(loads.stiffness).max()
    assert np.abs(loads.inertia).max() < 1e-12 * np.abs(loads.stiffness).max()
    assert not loads.rest.any()


def test_a_constant_force_is_balanced_by_the_spring():
    time_s = np.arange(4000) / 100
    command = np.tile([0.2, 0.01], (4000, 1))
    inputs = np.tile([0.4, 0.75], (4000, 1))  # 2 N/V · 0.75 V − 0.5 N = 1 N on 100 N/m
    _, motion, loads = run(parse_robot(STATIC), time_s, command=command, inputs=inputs)
    assert loads.constant[:, 1].tolist() == [-0.5] * 4000
    assert loads.actuation[:, 1] == pytest.approx(1.5)
    assert motion.position[-1, 1] == pytest.approx(0.01, rel=1e-2)
    assert loads.stiffness[-1, 1] == pytest.approx(1.0, rel=1e-2)


def test_what_carries_and_what_is_carried_push_each_other():
    """The nano stage moves by z and zn together; what moves it is what it takes from the table."""
    time_s = np.arange(400) / 2000
    _, _, loads = run(ROBOT, time_s)
    z, zn = ROBOT_AXES.index("z"), ROBOT_AXES.index("zn")
    mass, carried = ROBOT.axes["z"].mass, ROBOT.axes["zn"].mass
    joint = loads.actuation - loads.damping - loads.stiffness
    on_carried = carried * (loads.acceleration[:, z] + loads.acceleration[:, zn])
    on_table = (mass - carried) * loads.acceleration[:, z]
    scale = np.abs(joint[:, z]).max()
    assert joint[:, zn] == pytest.approx(on_carried, abs=1e-9 * scale)
    assert joint[:, z] - joint[:, zn] == pytest.approx(on_table, abs=1e-9 * scale)
    assert np.abs(on_carried).max() > 1e-3 * scale


def test_a_free_machine_keeps_its_momentum():
    free = parse_robot("""
[robot]
name = "free"
axes = ["z", "zn"]
[axis.z]
kind = "force"
range = [-1.0, 1.0]
gain = 1.0
mass = 5.0
damping = 0.0
[axis.zn]
kind = "piezo"
range = [0.0, 1.0]
gain = 0.01
mass = 2.0
damping = 3.0
stiffness = 800.0
[[coupling]]
matrix = "M"
axes = ["z", "zn"]
value = 2.0
""")
    time_s, plant = np.arange(500) / 500, Plant.of(free)
    command = np.column_stack([np.zeros(500), 0.1 * np.sin(9.0 * time_s)])
    inputs = plant.open_loop_inputs(command)
    _, _, loads = run(free, time_s, command=command, inputs=inputs)
    momentum = 3.0 * loads.velocity[:, 0] + 2.0 * loads.velocity.sum(axis=1)
    assert np.abs(momentum).max() < 1e-12
    assert np.abs(loads.velocity[:, 0]).max() > 0.1
    assert np.abs(loads.inertia[:, 0]).max() < 1e-12 * np.abs(loads.inertia[:, 1]).max()


def energies(rate_hz):
    """Return the work of all that pushes, what dampers took and the gain of energy, J."""
    robot = replace(
        ROBOT, axes={name: ROBOT.axes[name] for name in ("z", "zn")}, couplings=ROBOT.couplings[:1]
    )
    robot = replace(robot, stages={})
    time_s = np.arange(rate_hz // 5 + 1) / rate_hz
    held = rate_hz // 1000  # the same commands and shaking at any rate
    at = np.arange(len(time_s)) // held
    command = swing(Plant.of(robot), np.arange(201) / 1000)[at]
    shaken = np.random.default_rng(3).normal(size=(201, 2))[at]
    perturbation = Perturbation(shaken, 1e-3 * np.eye(2), -np.diag([42.0, 0.15]))
    _, motion, loads = run(robot, time_s, perturbation, command)
    pushed = loads.actuation + loads.constant + loads.perturbation
    work = np.sum(pushed[:-1] * np.diff(motion.position, axis=0))  # exact: held until the next row
    mean_speed = 0.5 * (motion.velocity + loads.velocity)
    work += np.sum((loads.impulse * mean_speed)[:-1])  # exact: an impulse works at the mean speed
    power = np.sum(loads.velocity * loads.damping, axis=1)
    ends = np.sum(motion.velocity**2 * [8695.0, 19.792], axis=1)
    # Trapezium rule; the speed at the end of an interval is that before the impulse.
    lost = np.sum(0.5 * (power[:-1] + ends[1:])) / rate_hz
    energy = loads.elastic_energy + 0.5 * np.einsum(
        "ki,ij,kj->k", motion.velocity, [[42.0, 0.15], [0.15, 0.15]], motion.velocity
    )
    assert loads.kinetic_energy[-1] == pytest.approx(
        (energy - loads.elastic_energy)[-1] + loads.impulse[-1] @ mean_speed[-1]
    )
    return work, lost, energy[-1] - energy[0]


def test_all_work_is_lost_in_dampers_or_kept_as_energy():
    gaps = []
    for rate_hz in (8000, 16000, 32000):
        work, lost, gained = energies(rate_hz)
        assert lost > 0.01 * abs(work)
        gaps.append(abs(work - lost - gained) / lost)
    assert gaps[0] < 0.02
    assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.1)
    assert gaps[1] / gaps[2] == pytest.approx(4.0, rel=0.1)


def test_an_impulse_changes_the_momentum():
    time_s = np.arange(3) / 1000
    perturbation = replace(shaking(3, 6), b=np.zeros((6, 6)))
    _, motion, loads = run(ROBOT, time_s, perturbation)
    change = np.diff(perturbation.acceleration, axis=0, prepend=np.zeros((1, 6)))
    assert loads.impulse == pytest.approx(change @ perturbation.a.T)
    mass = np.diag([axis.mass for axis in ROBOT.axes.values()])
    for coupling in ROBOT.couplings:
        first, second = (ROBOT_AXES.index(name) for name in coupling.axes)
        mass[first, second] = mass[second, first] = coupling.value
    jump = (loads.velocity - motion.velocity) @ mass
    assert jump == pytest.approx(loads.impulse, rel=1e-9, abs=1e-12)


def test_the_rest_is_the_force_of_an_effect():
    """A spring that hardens: what the balance lacks is −k (q − q₀)³ / L², L half the range."""
    hard = AxisEffect(axis="zn", id="stiffness_nonlinearity", parameters={"hardening": 1.0})
    errors = []
    for rate_hz in (16000, 32000):
        time_s = np.arange(rate_hz // 20) / rate_hz
        command = swing(Plant.of(ROBOT), time_s)
        command[:, 5] = 32.5e-6 + 30e-6 * np.sin(100.0 * time_s)
        _, motion, loads = run(replace(ROBOT, effects=(hard,)), time_s, command=command)
        # The simulation holds such a force from row to row, as it is half way.
        half_way = 0.5 * (motion.position[1:, 5] + motion.position[:-1, 5])
        force = -ROBOT.axes["zn"].stiffness * (half_way - 32.5e-6) ** 3 / 32.5e-6**2
        errors.append(np.abs(loads.rest[:-1, 5] - force).max() / np.abs(force).max())
        assert loads.rest[-1, 5] == loads.rest[-2, 5]
    assert errors[0] < 0.02
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.2)


def test_an_axis_that_is_seen_elsewhere_keeps_its_own_acceleration():
    """Shaken images of an axis at rest are no forces of inertia."""
    shaken = AxisEffect(axis="x", id="vibration", parameters={"sine": 1e-6})
    time_s = np.arange(100) / 1000
    command = np.tile(swing(Plant.of(ROBOT), np.zeros(1)), (100, 1))
    _, motion, loads = run(replace(ROBOT, effects=(shaken,)), time_s, command=command)
    assert np.ptp(motion.position[:, 0]) > 1e-6
    assert np.abs(loads.acceleration[:, 0]).max() < 1e-6
    seen = ROBOT.axes["x"].stiffness * (motion.position[:, 0] - command[0, 0])
    assert loads.rest[:, 0] == pytest.approx(seen, abs=1e-6)


def test_a_delay_of_the_amplifier_shows_in_its_output_and_leaves_no_rest():
    late = AxisEffect(axis="thx", id="delay", parameters={"delay": 3 / 4096})
    _, _, loads = run(replace(ROBOT, effects=(late,)), np.arange(400) / 4096)
    column = ROBOT_AXES.index("thx")
    swing_force = np.ptp(loads.actuation[:, column])
    assert np.abs(loads.rest[:, column]).max() < 1e-3 * swing_force


def test_the_delay_of_a_controller_is_the_rest():
    """What is missing is the input of two samples before in place of the one just given."""
    robot = load_robot("emps")
    late = replace(robot.axes["q"].controller, delay_s=2 / 1024)
    robot = replace(robot, axes={"q": replace(robot.axes["q"], controller=late)})
    plant, time_s = Plant.of(robot, closed_loop=True), np.arange(512) / 1024
    command = 0.1 + 0.01 * np.sin(20.0 * time_s[:, None])
    motion, _ = plant.advance(plant.at_rest(0.0, command[0]), time_s, command)
    loads = joint_loads(plant, time_s, motion)
    missing = robot.axes["q"].gain * (motion.inputs[:-2, 0] - motion.inputs[2:, 0])
    assert np.abs(missing).max() > 0.1
    assert loads.rest[2:-1, 0] == pytest.approx(missing[:-1], abs=1e-3 * np.abs(missing).max())


def test_a_static_axis_moves_by_differences():
    time_s = np.array([0.0, 1.0, 3.0, 4.0])
    command = np.column_stack([[0.1, 0.3, 0.9, 0.8], np.zeros(4)])
    plant = Plant.of(parse_robot(STATIC))
    _, _, loads = run(parse_robot(STATIC), time_s, command=command)
    assert plant.axes == ("x", "y")
    assert loads.position[:, 0] == pytest.approx([0.1, 0.3, 0.9, 0.8])
    assert loads.velocity[:, 0] == pytest.approx([0.2, 0.3, -0.1, -0.1])
    assert loads.acceleration[:, 0] == pytest.approx([0.2, 0.1 / 1.5, -0.4 / 1.5, 0.0])
    for name in ("inertia", "damping", "stiffness", "actuation", "rest", "impulse"):
        assert not getattr(loads, name)[:, 0].any()


@pytest.mark.parametrize("rows", [1, 2, 7, 60])
@pytest.mark.parametrize("shaken", [False, True])
def test_loads_of_pieces_are_those_of_the_run(rows, shaken):
    time_s = np.cumsum(np.random.default_rng(2).uniform(3e-4, 6e-4, 60))
    static = replace(ROBOT.axes["x"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "x": static}, effects=EFFECTS)
    perturbation = shaking(60, 6) if shaken else None
    plant, motion, whole = run(robot, time_s, perturbation)
    running, parts = RunningLoads(plant), []
    for first in range(0, 60, rows):
        own = slice(first, first + rows)
        piece = type(motion)(*(signal[own] for signal in motion))
        part = None if perturbation is None else perturbation.part(own)
        parts.append(running.follow(time_s[own], piece, part))
    parts.append(running.last())
    for each in fields(JointLoads):
        joined = np.concatenate([getattr(part, each.name) for part in parts])
        assert joined == pytest.approx(getattr(whole, each.name), rel=1e-12, abs=1e-15), each.name


def test_what_does_not_fit_is_refused_and_nothing_can_be_changed():
    time_s = np.arange(5) / 1000
    plant, motion, loads = run(ROBOT, time_s)
    with pytest.raises(PlantError, match="it has 4 rows; the commands have 5"):
        joint_loads(plant, time_s, motion, shaking(4, 6))
    with pytest.raises(ValueError, match="read-only"):
        loads.inertia[0] = 1.0
