"""Forces at the joints: they balance, have reactions and account for all energy."""

from dataclasses import fields, replace

import numpy as np
import pytest

from rotemina.sim.errors import PlantError
from rotemina.sim.plant import JointLoads, Perturbation, Plant, RunningLoads, compute_joint_loads
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, parse_robot

ROBOT = load_robot("rotemina")
ROBOT_AXES = tuple(ROBOT.axes)
STATIC_ROBOT_TEXT = """
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


def make_commands(plant, time_s, frequency_hz=20.0):
    low, high = np.array([axis.range for axis in plant.robot.axes.values()]).T
    size = np.minimum(0.2 * (high - low), 1e-4)
    phase = 2.0 * np.pi * frequency_hz * time_s[:, None] + np.arange(len(low))
    return 0.5 * (low + high) + size * (np.sin(phase) - np.sin(phase[0]))


def simulate_loads(robot, time_s, perturbation=None, command=None, inputs=None):
    plant = Plant.of(robot)
    command = make_commands(plant, time_s) if command is None else command
    inputs = plant.compute_open_loop_inputs(command) if inputs is None else inputs
    state = plant.find_rest_state(time_s[0], command[0])
    motion, _ = plant.advance(state, time_s, command, inputs=inputs, perturbation=perturbation)
    return plant, motion, compute_joint_loads(plant, time_s, motion, perturbation)


def make_perturbation(rows, axes):
    rng = np.random.default_rng(1)
    a, b = 1e-4 * rng.uniform(-1.0, 1.0, (2, axes, axes))
    return Perturbation(rng.normal(size=(rows, axes)), a, b)


@pytest.mark.parametrize("effects", [(), EFFECTS], ids=["nominal", "effects"])
def test_all_forces_balance(effects):
    time_s = np.arange(400) / 2000
    _, _, loads = simulate_loads(replace(ROBOT, effects=effects), time_s, make_perturbation(400, 6))
    responses = loads.inertia + loads.damping + loads.stiffness
    forces = loads.actuation + loads.constant + loads.perturbation + loads.rest
    assert np.abs(responses - forces).max(axis=0) == pytest.approx(
        np.zeros(6), abs=1e-12 * np.abs(loads.stiffness).max()
    )
    disturbed = ("z", "thx", "thy", "zn") if effects else ()  # zn rides on z
    axes_with_rest = tuple(
        name for name, rest in zip(ROBOT.axes, loads.rest.T, strict=True) if rest.any()
    )
    assert set(axes_with_rest) == set(disturbed)


def test_the_acceleration_is_the_derivative_of_the_velocity():
    """Compare with the change of velocity between samples 0.1 µs apart."""
    coarse_time_s = np.arange(50) / 1000
    time_s = np.sort(np.concatenate([coarse_time_s, coarse_time_s + 1e-7]))
    plant = Plant.of(ROBOT)
    command = np.repeat(make_commands(plant, coarse_time_s), 2, axis=0)
    perturbation = make_perturbation(50, 6)
    perturbation = replace(
        perturbation, acceleration=np.repeat(perturbation.acceleration, 2, axis=0)
    )
    _, motion, loads = simulate_loads(ROBOT, time_s, perturbation, command)
    slope = (motion.velocity[1::2] - loads.velocity[::2]) / 1e-7
    worst = np.abs(slope - loads.acceleration[::2]).max(axis=0)
    assert (worst < 1e-3 * np.abs(loads.acceleration).max(axis=0)).all()


def test_at_rest_spring_forces_equal_actuator_forces():
    time_s, plant = np.arange(5) / 1000, Plant.of(ROBOT)
    command = np.tile(make_commands(plant, np.zeros(1)), (5, 1))
    _, motion, loads = simulate_loads(ROBOT, time_s, command=command)
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
    _, motion, loads = simulate_loads(
        parse_robot(STATIC_ROBOT_TEXT), time_s, command=command, inputs=inputs
    )
    assert loads.constant[:, 1].tolist() == [-0.5] * 4000
    assert loads.actuation[:, 1] == pytest.approx(1.5)
    assert motion.position[-1, 1] == pytest.approx(0.01, rel=1e-2)
    assert loads.stiffness[-1, 1] == pytest.approx(1.0, rel=1e-2)


def test_table_and_nano_stage_exert_opposite_forces():
    """The force on the nano stage, which moves by z and zn, is the reaction on the table."""
    time_s = np.arange(400) / 2000
    _, _, loads = simulate_loads(ROBOT, time_s)
    z, zn = ROBOT_AXES.index("z"), ROBOT_AXES.index("zn")
    mass, nano_mass = ROBOT.axes["z"].mass, ROBOT.axes["zn"].mass
    joint_force = loads.actuation - loads.damping - loads.stiffness
    force_on_nano = nano_mass * (loads.acceleration[:, z] + loads.acceleration[:, zn])
    force_on_table = (mass - nano_mass) * loads.acceleration[:, z]
    scale = np.abs(joint_force[:, z]).max()
    assert joint_force[:, zn] == pytest.approx(force_on_nano, abs=1e-9 * scale)
    assert joint_force[:, z] - joint_force[:, zn] == pytest.approx(force_on_table, abs=1e-9 * scale)
    assert np.abs(force_on_nano).max() > 1e-3 * scale


def test_a_free_machine_conserves_its_momentum():
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
    inputs = plant.compute_open_loop_inputs(command)
    _, _, loads = simulate_loads(free, time_s, command=command, inputs=inputs)
    momentum = 3.0 * loads.velocity[:, 0] + 2.0 * loads.velocity.sum(axis=1)
    assert np.abs(momentum).max() < 1e-12
    assert np.abs(loads.velocity[:, 0]).max() > 0.1
    assert np.abs(loads.inertia[:, 0]).max() < 1e-12 * np.abs(loads.inertia[:, 1]).max()


def compute_energy_balance(rate_hz):
    """Return the work of all forces, the loss in dampers and the increase of energy, J."""
    robot = replace(
        ROBOT, axes={name: ROBOT.axes[name] for name in ("z", "zn")}, couplings=ROBOT.couplings[:1]
    )
    robot = replace(robot, stages={})
    time_s = np.arange(rate_hz // 5 + 1) / rate_hz
    repeats = rate_hz // 1000  # commands and perturbation are the same at any rate
    rows = np.arange(len(time_s)) // repeats
    command = make_commands(Plant.of(robot), np.arange(201) / 1000)[rows]
    acceleration = np.random.default_rng(3).normal(size=(201, 2))[rows]
    perturbation = Perturbation(acceleration, 1e-3 * np.eye(2), -np.diag([42.0, 0.15]))
    _, motion, loads = simulate_loads(robot, time_s, perturbation, command)
    forces = loads.actuation + loads.constant + loads.perturbation
    # Exact, because forces are held until the next row.
    work = np.sum(forces[:-1] * np.diff(motion.position, axis=0))
    mean_speed = 0.5 * (motion.velocity + loads.velocity)
    # Exact, because an impulse does its work at the mean speed.
    work += np.sum((loads.impulse * mean_speed)[:-1])
    power = np.sum(loads.velocity * loads.damping, axis=1)
    ends = np.sum(motion.velocity**2 * [8695.0, 19.792], axis=1)
    # Trapezium rule, where the speed at the end of an interval is that before the impulse.
    lost = np.sum(0.5 * (power[:-1] + ends[1:])) / rate_hz
    energy = loads.elastic_energy + 0.5 * np.einsum(
        "ki,ij,kj->k", motion.velocity, [[42.0, 0.15], [0.15, 0.15]], motion.velocity
    )
    assert loads.kinetic_energy[-1] == pytest.approx(
        (energy - loads.elastic_energy)[-1] + loads.impulse[-1] @ mean_speed[-1]
    )
    return work, lost, energy[-1] - energy[0]


def test_all_work_is_dissipated_or_stored():
    gaps = []
    for rate_hz in (8000, 16000, 32000):
        work, lost, energy_increase = compute_energy_balance(rate_hz)
        assert lost > 0.01 * abs(work)
        gaps.append(abs(work - lost - energy_increase) / lost)
    assert gaps[0] < 0.02
    assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.1)
    assert gaps[1] / gaps[2] == pytest.approx(4.0, rel=0.1)


def test_an_impulse_changes_the_momentum():
    time_s = np.arange(3) / 1000
    perturbation = replace(make_perturbation(3, 6), b=np.zeros((6, 6)))
    _, motion, loads = simulate_loads(ROBOT, time_s, perturbation)
    change = np.diff(perturbation.acceleration, axis=0, prepend=np.zeros((1, 6)))
    assert loads.impulse == pytest.approx(change @ perturbation.a.T)
    mass = np.diag([axis.mass for axis in ROBOT.axes.values()])
    for coupling in ROBOT.couplings:
        first, second = (ROBOT_AXES.index(name) for name in coupling.axes)
        mass[first, second] = mass[second, first] = coupling.value
    jump = (loads.velocity - motion.velocity) @ mass
    assert jump == pytest.approx(loads.impulse, rel=1e-9, abs=1e-12)


def test_the_rest_is_the_force_of_an_effect():
    """The rest of a hardening spring is −k (q − q₀)³ / L² with L half the range."""
    hardening = AxisEffect(axis="zn", id="stiffness_nonlinearity", parameters={"hardening": 1.0})
    errors = []
    for rate_hz in (16000, 32000):
        time_s = np.arange(rate_hz // 20) / rate_hz
        command = make_commands(Plant.of(ROBOT), time_s)
        command[:, 5] = 32.5e-6 + 30e-6 * np.sin(100.0 * time_s)
        _, motion, loads = simulate_loads(
            replace(ROBOT, effects=(hardening,)), time_s, command=command
        )
        # The simulation holds such a force between rows, with its value half-way.
        half_way = 0.5 * (motion.position[1:, 5] + motion.position[:-1, 5])
        force = -ROBOT.axes["zn"].stiffness * (half_way - 32.5e-6) ** 3 / 32.5e-6**2
        errors.append(np.abs(loads.rest[:-1, 5] - force).max() / np.abs(force).max())
        assert loads.rest[-1, 5] == loads.rest[-2, 5]
    assert errors[0] < 0.02
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.2)


def test_apparent_vibration_does_not_change_the_acceleration():
    """Apparent vibration of an axis at rest causes no inertial force."""
    vibration = AxisEffect(axis="x", id="vibration", parameters={"sine": 1e-6})
    time_s = np.arange(100) / 1000
    command = np.tile(make_commands(Plant.of(ROBOT), np.zeros(1)), (100, 1))
    _, motion, loads = simulate_loads(replace(ROBOT, effects=(vibration,)), time_s, command=command)
    assert np.ptp(motion.position[:, 0]) > 1e-6
    assert np.abs(loads.acceleration[:, 0]).max() < 1e-6
    apparent_force = ROBOT.axes["x"].stiffness * (motion.position[:, 0] - command[0, 0])
    assert loads.rest[:, 0] == pytest.approx(apparent_force, abs=1e-6)


def test_an_amplifier_delay_changes_the_actuation_and_leaves_no_rest():
    delay = AxisEffect(axis="thx", id="delay", parameters={"delay": 3 / 4096})
    _, _, loads = simulate_loads(replace(ROBOT, effects=(delay,)), np.arange(400) / 4096)
    column = ROBOT_AXES.index("thx")
    actuation_range = np.ptp(loads.actuation[:, column])
    assert np.abs(loads.rest[:, column]).max() < 1e-3 * actuation_range


def test_the_effect_of_a_controller_delay_is_the_rest():
    """The rest is the difference between the delayed input and the present one."""
    robot = load_robot("emps")
    delayed_controller = replace(robot.axes["q"].controller, delay_s=2 / 1024)
    robot = replace(robot, axes={"q": replace(robot.axes["q"], controller=delayed_controller)})
    plant, time_s = Plant.of(robot, closed_loop=True), np.arange(512) / 1024
    command = 0.1 + 0.01 * np.sin(20.0 * time_s[:, None])
    motion, _ = plant.advance(plant.find_rest_state(0.0, command[0]), time_s, command)
    loads = compute_joint_loads(plant, time_s, motion)
    expected_rest = robot.axes["q"].gain * (motion.inputs[:-2, 0] - motion.inputs[2:, 0])
    assert np.abs(expected_rest).max() > 0.1
    assert loads.rest[2:-1, 0] == pytest.approx(
        expected_rest[:-1], abs=1e-3 * np.abs(expected_rest).max()
    )


def test_rates_of_a_static_axis_are_differences():
    time_s = np.array([0.0, 1.0, 3.0, 4.0])
    command = np.column_stack([[0.1, 0.3, 0.9, 0.8], np.zeros(4)])
    plant = Plant.of(parse_robot(STATIC_ROBOT_TEXT))
    _, _, loads = simulate_loads(parse_robot(STATIC_ROBOT_TEXT), time_s, command=command)
    assert plant.axes == ("x", "y")
    assert loads.position[:, 0] == pytest.approx([0.1, 0.3, 0.9, 0.8])
    assert loads.velocity[:, 0] == pytest.approx([0.2, 0.3, -0.1, -0.1])
    assert loads.acceleration[:, 0] == pytest.approx([0.2, 0.1 / 1.5, -0.4 / 1.5, 0.0])
    for name in ("inertia", "damping", "stiffness", "actuation", "rest", "impulse"):
        assert not getattr(loads, name)[:, 0].any()


@pytest.mark.parametrize(("rows", "is_perturbed"), [(1, True), (7, False), (60, True)])
def test_loads_of_pieces_equal_those_of_the_run(rows, is_perturbed):
    time_s = np.cumsum(np.random.default_rng(2).uniform(3e-4, 6e-4, 60))
    static = replace(ROBOT.axes["x"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "x": static}, effects=EFFECTS)
    perturbation = make_perturbation(60, 6) if is_perturbed else None
    plant, motion, whole = simulate_loads(robot, time_s, perturbation)
    running, parts = RunningLoads(plant), []
    for first in range(0, 60, rows):
        piece_rows = slice(first, first + rows)
        piece = type(motion)(*(signal[piece_rows] for signal in motion))
        part = None if perturbation is None else perturbation.part(piece_rows)
        parts.append(running.follow(time_s[piece_rows], piece, part))
    parts.append(running.compute_last())
    for field in fields(JointLoads):
        joined = np.concatenate([getattr(part, field.name) for part in parts])
        assert joined == pytest.approx(getattr(whole, field.name), rel=1e-12, abs=1e-15), field.name


def test_a_perturbation_of_another_length_is_refused_and_loads_are_read_only():
    time_s = np.arange(5) / 1000
    plant, motion, loads = simulate_loads(ROBOT, time_s)
    with pytest.raises(PlantError, match="it has 4 rows; the commands have 5"):
        compute_joint_loads(plant, time_s, motion, make_perturbation(4, 6))
    with pytest.raises(ValueError, match="read-only"):
        loads.inertia[0] = 1.0
