"""The nominal plant in open loop, compared with exact solutions and reference responses."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import PlantError
from rotemina.sim.plant import Plant, kernel, simulate_nominal_response
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot import assemble_inertia_matrices
from rotemina.sim.robot_files import load_robot, parse_robot

ROBOT = load_robot("rotemina")
CENTRE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])


def make_robot(mass=2.0, damping=3.0, stiffness=800.0, extra=""):
    return parse_robot(
        "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='stepper'\nrange=[-1.0, 1.0]\n"
        f"mass={mass}\ndamping={damping}\nstiffness={stiffness}\n{extra}"
    )


def compute_step_response(time_s, mass, damping, stiffness):
    """Return the unit step response of m q'' + d q' + k q = k, from rest at 0."""
    natural = np.sqrt(stiffness / mass)
    ratio = damping / (2 * mass * natural)
    damped = natural * np.sqrt(1 - ratio**2)
    decay = np.exp(-ratio * natural * time_s)
    return 1 - decay * (
        np.cos(damped * time_s) + ratio * natural / damped * np.sin(damped * time_s)
    )


def make_step_record(time_s):
    return Record.from_signals(
        np.concatenate([[-1.0], time_s]),
        {("a", Tap.CMD): np.concatenate([[0.0], np.ones(len(time_s))])},
        {"a": "m"},
    )


@pytest.mark.parametrize("name", ["steps", "sines", "uneven"])
def test_reference_responses_match_within_1e9_of_the_range(shared_dir, name):
    record = read_record(shared_dir / "reference" / f"{name}.csv", robot=ROBOT)
    response = simulate_nominal_response(ROBOT, record)
    for axis in ROBOT.axes:
        gap = np.abs(response.signal(axis, Tap.MEAS) - record.signal(axis, Tap.MEAS)).max()
        assert gap <= 1e-9 * ROBOT.axes[axis].span, axis


def test_read_only_arrays_need_no_second_compilation():
    plant, time_s, command = Plant.of(ROBOT), np.array([0.0, 1e-3, 2e-3]), np.tile(CENTRE, (3, 1))
    rest_state = plant.find_rest_state(-1e-3, CENTRE)
    motion, _ = plant.advance(rest_state, time_s, command)
    compiled = list(kernel.run.signatures)
    time_s.flags.writeable = command.flags.writeable = False
    repeated, _ = plant.advance(rest_state, time_s, command)
    np.testing.assert_array_equal(motion.position, repeated.position)
    assert kernel.run.signatures == compiled


@given(st.lists(st.floats(1e-4, 0.3), min_size=3, max_size=60))
def test_a_step_is_exact_at_any_sample_times(intervals):
    """The command acts from t = 0, and the response does not depend on the sample times."""
    time_s = np.concatenate([[0.0], np.cumsum(intervals)])
    record = make_step_record(time_s)
    response = simulate_nominal_response(make_robot(), record).signal("a", Tap.MEAS)[1:]
    np.testing.assert_allclose(response, compute_step_response(time_s, 2.0, 3.0, 800.0), atol=1e-11)


def test_an_offset_shifts_the_reading_but_not_the_motion():
    record = make_step_record(np.linspace(0, 1, 20))
    response = simulate_nominal_response(make_robot(extra="offset=0.25"), record)
    np.testing.assert_allclose(
        response.signal("a", Tap.MEAS), response.signal("a", Tap.REF) + 0.25, atol=1e-15
    )


def test_natural_frequency_and_damping_ratio_give_the_same_motion_as_mass_and_stiffness():
    natural, ratio = np.sqrt(800.0 / 2.0), 3.0 / (2 * np.sqrt(800.0 * 2.0))
    modal = parse_robot(
        "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='stepper'\nrange=[-1, 1]\n"
        f"natural_frequency_hz={float(natural / (2 * np.pi))!r}\ndamping_ratio={float(ratio)!r}\n"
    )
    record = make_step_record(np.linspace(0, 1, 50))
    first, second = (
        simulate_nominal_response(robot, record).signal("a", Tap.REF)
        for robot in (make_robot(), modal)
    )
    np.testing.assert_allclose(first, second, atol=1e-12)


def test_energy_is_constant_without_damping_and_falls_with_it():
    undamped_robot = replace(
        ROBOT,
        axes={name: replace(axis, damping=0.0) for name, axis in ROBOT.axes.items()},
    )
    time_s = np.arange(0, 0.2, 5e-4)
    start = CENTRE * 1.001
    for model, is_lossless in ((undamped_robot, True), (ROBOT, False)):
        plant = Plant.of(model)
        _, mass, _, stiffness = assemble_inertia_matrices(model)
        inputs = plant.compute_open_loop_inputs(CENTRE[None])[0]
        state = plant.make_state(0.0, inputs, start, np.zeros(6))
        motion, _ = plant.advance(state, time_s, np.tile(CENTRE, (len(time_s), 1)))
        deflection = motion.position - CENTRE
        energy = 0.5 * np.einsum("ni,ij,nj->n", motion.velocity, mass, motion.velocity)
        energy += 0.5 * np.einsum("ni,ij,nj->n", deflection, stiffness, deflection)
        if is_lossless:
            np.testing.assert_allclose(energy, energy[0], rtol=1e-8)
        else:
            assert np.diff(energy).max() <= 1e-12 * energy[0]
            assert energy[-1] < 1e-3 * energy[0]


def test_the_acceleration_of_the_table_moves_the_nano_z_axis():
    """M couples z and zn, so a step of z moves zn but no other axis."""
    time_s = np.arange(0, 0.05, 5e-4)
    command = np.tile(CENTRE, (len(time_s), 1))
    command[10:, 2] += 1e-5
    plant = Plant.of(ROBOT)
    motion, _ = plant.advance(plant.find_rest_state(0.0, CENTRE), time_s, command)
    travels = np.ptp(motion.position, axis=0)
    assert travels[2] > 1e-5
    assert travels[5] > 1e-8
    np.testing.assert_allclose(travels[[0, 1, 3, 4]], 0.0, atol=1e-14)


def test_static_axes_follow_immediately():
    robot = load_robot("picma")
    time_s = np.arange(5) / 200
    command = np.array([0.0, 1e-5, 4e-5, 2e-5, 0.0])
    record = Record.from_signals(time_s, {("p", Tap.CMD): command}, {"p": "m"})
    response = simulate_nominal_response(robot, record)
    np.testing.assert_allclose(response.signal("p", Tap.MEAS), command, rtol=1e-14)
    np.testing.assert_allclose(response.signal("p", Tap.U), command / 12.53e-6, rtol=1e-14)


def test_an_unknown_history_starts_from_the_first_measured_samples():
    time_s = np.arange(400) / 4000
    robot = make_robot(mass=1.0, damping=2.0, stiffness=400.0)
    reading = 0.2 * np.exp(-time_s) * np.cos(np.sqrt(399.0) * time_s)
    signals = {("a", Tap.CMD): np.zeros(400), ("a", Tap.MEAS): reading}
    record = Record.from_signals(time_s, signals, {"a": "m"}, {"history": "unknown"})
    response = simulate_nominal_response(robot, record).signal("a", Tap.MEAS)
    assert np.abs(response - reading).max() < 2e-3 * 0.2
    at_rest = Record.from_signals(time_s, signals, {"a": "m"})
    assert np.abs(simulate_nominal_response(robot, at_rest).signal("a", Tap.MEAS)).max() < 1e-15


def test_an_axis_that_the_robot_lacks_is_refused():
    record = Record.from_signals(np.arange(3.0), {("q", Tap.CMD): np.zeros(3)}, {"q": "m"})
    with pytest.raises(PlantError, match=r"'q'.*'RoTeMiNa' has only x, y, z"):
        simulate_nominal_response(ROBOT, record)


def test_a_record_without_commands_cannot_drive_the_model():
    record = Record.from_signals(np.arange(3.0), {("x", Tap.MEAS): np.zeros(3)}, {"x": "m"})
    with pytest.raises(PlantError, match=r"no x\.cmd column"):
        simulate_nominal_response(ROBOT, record)


def test_a_response_that_overflows_stops_with_axis_and_time():
    command = np.where(np.arange(50) > 20, 1e305, 0.0)
    record = Record.from_signals(np.arange(50) * 1e-3, {("thx", Tap.CMD): command}, {"thx": "rad"})
    with pytest.raises(PlantError, match=r"axis th[xy]: .*grows without bound at t = 0\.022"):
        simulate_nominal_response(ROBOT, record)
