"""Every excitation of every robot stays inside the limits, from rest to rest, and comes again."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotemina.sim.excitation.generator import KINDS, excite
from rotemina.sim.excitation.quantity import ExcitationError, Share
from rotemina.sim.excitation.sines_and_chirps import Chirp, Multisine, Sine
from rotemina.sim.excitation.staircase_steps_prbs import Prbs, Staircase, Steps
from rotemina.sim.excitation.triangles_and_sweeps import DecayingTriangle, Sweeps, Triangle
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot, nominal_robots
from rotemina.sim.trajectory.trajectory_excesses import TrajectoryError, find_violations

ROBOTS = {name: load_robot(name) for name in nominal_robots()}
PERIODIC = (Sine, Triangle, Multisine, Prbs)

places = {
    "amplitude": st.none() | st.floats(1e-3, 2.0).map(Share),
    "offset": st.none() | st.floats(0.05, 0.95).map(Share),
}
frequency = st.floats(0.2, 60.0)
duration = st.floats(0.05, 3.0)
STRATEGIES = {
    "sine": st.builds(
        Sine, **places, frequency_hz=frequency, duration_s=duration, periodic=st.booleans()
    ),
    "triangle": st.builds(
        Triangle, **places, frequency_hz=frequency, duration_s=duration, periodic=st.booleans()
    ),
    "decaying-triangle": st.builds(
        DecayingTriangle,
        **places,
        frequency_hz=frequency,
        duration_s=duration,
        growing=st.booleans(),
    ),
    "staircase": st.builds(
        Staircase, **places, levels=st.integers(2, 9), hold_s=st.floats(1e-3, 0.2)
    ),
    "multisine": st.builds(
        Multisine,
        **places,
        low_hz=st.floats(1.0, 20.0),
        high_hz=st.floats(25.0, 200.0),
        period_s=st.floats(0.2, 1.5),
        duration_s=duration,
        detection=st.sampled_from([0, 2, 4]),
        slope=st.floats(-2.0, 1.0),
        periodic=st.booleans(),
    ),
    "chirp": st.builds(
        Chirp,
        **places,
        low_hz=st.floats(1.0, 20.0),
        high_hz=st.floats(20.0, 200.0),
        duration_s=st.floats(1.0, 4.0),
        spacing=st.sampled_from(["log", "linear"]),
    ),
    "prbs": st.builds(
        Prbs,
        **places,
        frequency_hz=st.floats(20.0, 500.0),
        order=st.integers(3, 9),
        duration_s=duration,
        periodic=st.booleans(),
    ),
    "sweeps": st.builds(
        Sweeps,
        **places,
        speeds=st.lists(st.floats(0.05, 3.0).map(Share), max_size=3).map(tuple),
        hold_s=st.floats(1e-3, 0.2),
    ),
    "steps": st.builds(
        Steps,
        **places,
        rise_s=st.none() | st.floats(1e-3, 0.5),
        hold_s=st.floats(1e-3, 0.2),
        cycles=st.integers(1, 3),
    ),
}


def cmd(excitation, axis):
    return excitation.record.signal(axis, Tap.CMD)


def test_every_kind_is_tried():
    assert set(STRATEGIES) == set(KINDS)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("kind", KINDS)
def test_defaults_suit_every_axis_alone_and_all_at_once(kind, robot):
    model = ROBOTS[robot]
    for axes in [*((name,) for name in model.axes), tuple(model.axes)]:
        made = excite(model, {name: KINDS[kind]() for name in axes})
        assert made.record.axes == axes
        assert made.adjustments == ()
        assert find_violations(model, made.record) == ()
        assert made.record.metadata["excitation"] == kind
        assert made.record.duration_s < 300
        for name in axes:
            assert np.ptp(cmd(made, name)) > 1e-4 * model.axes[name].span
            assert made.record.metadata[f"excitation {name}"].startswith(f"{kind}; amplitude_")


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=15)
@given(data=st.data())
def test_whatever_is_asked_stays_inside_every_limit(kind, robot, data):
    model = ROBOTS[robot]
    asked = data.draw(STRATEGIES[kind])
    axis = data.draw(st.sampled_from(list(model.axes)))
    rate = data.draw(st.sampled_from([1000.0, 1333.3, 2000.0, 20_000.0]))
    made = excite(model, {axis: asked}, rate_hz=rate, seed=data.draw(st.integers(0, 99)))
    assert find_violations(model, made.record) == ()
    again = excite(model, {axis: asked}, rate_hz=rate, seed=int(made.record.metadata["seed"]))
    np.testing.assert_array_equal(again.record.values, made.record.values)
    _check_ends(made, axis, asked)


def _check_ends(made, axis, asked):
    command = cmd(made, axis)
    low, high = command.min(), command.max()
    if getattr(asked, "periodic", False):
        period = made.record.period_samples
        assert made.record.history == "periodic"
        assert len(command) % period == 0
        np.testing.assert_array_equal(command[period:], command[:-period])
    else:
        assert made.record.history == "rest"
        assert command[-1] == pytest.approx(command[0], abs=1e-9 * (high - low))


@settings(max_examples=60)
@given(data=st.data())
def test_so_it_does_on_axes_of_other_makes(data):
    speed = data.draw(st.none() | st.floats(1e-4, 10.0))
    acceleration = data.draw(st.none() | st.floats(1e-3, 1e3))
    start = data.draw(st.floats(-1.0, 1.0))
    robot = ROBOTS["rotemina"]
    axis = replace(
        robot.axes["x"],
        range=(start, start + data.draw(st.floats(1e-4, 0.1))),
        max_speed=speed,
        max_acceleration=acceleration,
        sensor=None,  # nothing is forgiven for rounding
    )
    robot = replace(robot, axes={"x": axis}, couplings=())
    kind = data.draw(st.sampled_from(list(KINDS)).filter(lambda name: name != "sweeps"))
    made = excite(robot, {"x": data.draw(STRATEGIES[kind])}, rate_hz=1000.0)
    assert find_violations(robot, made.record) == ()


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_of_it_may_still_be_played(kind, tmp_path):
    robot = ROBOTS["rotemina"]
    made = excite(robot, {"x": KINDS[kind](), "thx": KINDS[kind](), "zn": KINDS[kind]()})
    units = {"x": "um", "thx": "urad", "zn": "nm"}
    write_record(made.record, tmp_path / "it.csv", units=units)
    read = read_record(tmp_path / "it.csv", robot=robot)
    assert find_violations(robot, read) == ()
    assert dict(read.metadata) == dict(made.record.metadata)


@pytest.mark.parametrize("kind", ["multisine", "prbs"])
def test_the_seed_and_the_axis_make_the_signal(kind):
    robot = ROBOTS["rotemina"]
    both = excite(robot, {"thx": KINDS[kind](), "thy": KINDS[kind]()}, seed=4)
    alone = excite(robot, {"thy": KINDS[kind]()}, seed=4)
    other = excite(robot, {"thy": KINDS[kind]()}, seed=5)
    assert not np.array_equal(cmd(both, "thx"), cmd(both, "thy"))
    np.testing.assert_array_equal(cmd(both, "thy"), cmd(alone, "thy"))
    assert not np.array_equal(cmd(alone, "thy"), cmd(other, "thy"))


def test_each_axis_has_its_own_excitation_and_rests_when_it_is_done():
    plan = {"thx": Steps(hold_s=0.1), "x": Sine(amplitude=1e-3, frequency_hz=1.0, duration_s=4.0)}
    made = excite(ROBOTS["rotemina"], plan, rate_hz=1000.0)
    assert made.record.metadata["name"] == "steps, sine of thx, x"
    assert len(made.record.time_s) == 4001
    assert len(np.unique(cmd(made, "thx")[2000:])) == 1


def test_axes_of_different_periods_are_periodic_in_the_common_one():
    def record(x_hz, thx_hz):
        plan = {
            "x": Sine(amplitude=1e-3, frequency_hz=x_hz, duration_s=2.0, periodic=True),
            "thx": Sine(frequency_hz=thx_hz, duration_s=2.0, periodic=True),
        }
        return excite(ROBOTS["rotemina"], plan, rate_hz=1000.0).record

    assert record(1.0, 5.0).period_samples == 1000
    assert record(2.5, 2.0).period_samples == 2000
    unequal = record(1.0, 3.3)
    assert unequal.history == "rest"
    assert unequal.period_samples is None


@pytest.mark.parametrize(
    ("asked", "parameter", "used", "cause"),
    [
        (Sine(amplitude=5e-3, frequency_hz=1.0), "amplitude", 1.5915e-3, "speed limit 10 mm/s"),
        (Sine(amplitude=5e-5, frequency_hz=20.0), "amplitude", 1.267e-5, "acceleration limit 200"),
        (Sine(amplitude=0.04, frequency_hz=0.01), "amplitude", 0.0275, "range 0 mm to 55 mm"),
        (Triangle(amplitude=5e-3, frequency_hz=1.0), "amplitude", 2.25e-3, "speed limit 10 mm/s"),
        (
            Sweeps(amplitude=5e-3, speeds=(0.02,)),
            "speed",
            0.01,
            "speed limit 10 mm/s",
        ),
        (Steps(amplitude=1e-3, rise_s=0.1), "rise", 0.1875, "speed limit 10 mm/s"),
        (Prbs(amplitude=1e-3, frequency_hz=25.0), "amplitude", 4e-5, "acceleration limit 200"),
    ],
)
def test_what_is_beyond_a_limit_is_reduced_and_said_or_refused(asked, parameter, used, cause):
    robot = ROBOTS["rotemina"]
    (adjustment,) = excite(robot, {"x": asked}, rate_hz=1000.0).adjustments
    assert (adjustment.axis, adjustment.parameter) == ("x", parameter)
    assert adjustment.used == pytest.approx(used, rel=1e-3)
    assert cause in adjustment.message
    with pytest.raises(ExcitationError, match=f"axis x: {parameter} .* is beyond ") as refusal:
        excite(robot, {"x": asked}, rate_hz=1000.0, strict=True)
    assert cause in str(refusal.value)


@pytest.mark.parametrize("kind", [Sine, Triangle])
def test_a_periodic_record_may_start_and_stop_at_the_greatest_acceleration(kind):
    robot = ROBOTS["rotemina"]
    exact = replace(robot, axes={"x": replace(robot.axes["x"], sensor=None)}, couplings=())
    asked = kind(amplitude=Share(0.4), frequency_hz=10.0, periodic=True)
    made = excite(exact, {"x": asked}, rate_hz=1000.0)
    steps = np.diff(np.pad(cmd(made, "x"), 1, mode="edge"), n=2) * 1e6
    assert np.abs(steps).max() == pytest.approx(0.2, rel=1e-3)
    # Their amplitudes at the bound: a/(2πf)², and a(T/2)²/8 with a third less for the stop.
    most = 0.2 / (20 * np.pi) ** 2 if kind is Sine else 0.2 / 1.5 * 0.05**2 / 8
    assert made.adjustments[0].used == pytest.approx(most, rel=5e-3)


def test_the_motion_that_the_model_predicts_stays_in_the_range_too():
    asked = Sine(amplitude=Share(0.4), frequency_hz=1000.0, duration_s=0.2)  # at the resonance
    made = excite(ROBOTS["fsm"], {"m1": asked}, rate_hz=20_000.0)
    (adjustment,) = made.adjustments
    assert "the motion that the model predicts" in adjustment.message
    motion = nominal_response(ROBOTS["fsm"], made.record).signal("m1", Tap.REF)
    assert 4.5e-6 < np.abs(motion).max() < 5.05e-6  # 25 times as far as the command
    with pytest.raises(ExcitationError, match="the motion that the model predicts"):
        excite(ROBOTS["fsm"], {"m1": asked}, rate_hz=20_000.0, strict=True)


def test_a_strict_run_accepts_what_fits():
    plan = {"x": Sine(amplitude=1e-3, frequency_hz=1.0), "zn": Triangle(), "thx": Prbs()}
    made = excite(ROBOTS["rotemina"], plan, rate_hz=2000.0, strict=True)
    assert made.adjustments == ()


def test_an_axis_without_speed_and_acceleration_may_have_few_rows():
    made = excite(ROBOTS["picma"], {"p": Triangle(frequency_hz=1.0)}, rate_hz=50.0)
    assert len(made.record.time_s) == 151


def test_the_voltage_bounds_the_room_too():
    made = excite(ROBOTS["picma"], {"p": Sine(amplitude=Share(0.5), frequency_hz=1.0)})
    (adjustment,) = made.adjustments
    assert adjustment.used == pytest.approx(3.7 * 12.53e-6 / 2)
    assert cmd(made, "p").max() == pytest.approx(3.7 * 12.53e-6)


@pytest.mark.parametrize(
    ("plan", "keywords", "words"),
    [
        ({}, {}, "no axis"),
        ({"w": Sine()}, {}, "'w'.*no such axis"),
        ({"x": Sine()}, {"rate_hz": 0.0}, "rate 0 Hz"),
        ({"x": Sine()}, {"rate_hz": float("nan")}, "rate nan Hz"),
        ({"x": Sine()}, {"rate_hz": 500.0}, "axis x: rate 500 Hz is below 1000 Hz"),
        ({"x": Sine()}, {"seed": -1}, "seed -1"),
        ({"x": Sine(frequency_hz=-1.0)}, {}, "frequency_hz = -1"),
        ({"x": Sine(frequency_hz=500.0)}, {"rate_hz": 1000.0}, "below half the rate, 500 Hz"),
        ({"x": Sine(frequency_hz=1e-9)}, {}, "rows"),
        ({"x": Sine(amplitude=0.0)}, {}, "amplitude 0 m must be above 0"),
        ({"x": Sine(amplitude=float("nan"))}, {}, "amplitude nan"),
        ({"x": Sine(offset=0.055)}, {}, "offset 55 mm leaves no room"),
        ({"x": Sine(offset=Share(1.2))}, {}, "offset 120 % leaves no room"),
        ({"x": Chirp(low_hz=5.0, high_hz=2.0)}, {}, "ends below its beginning"),
        ({"x": Chirp(low_hz=1.0, high_hz=2.0, duration_s=0.1)}, {}, "less than one period"),
        ({"x": Multisine(low_hz=2.1, high_hz=2.9)}, {}, "no odd multiple"),
        ({"x": Multisine(detection=1)}, {}, "detection = 1"),
        ({"x": Multisine(slope=float("inf"))}, {}, "slope = inf"),
        ({"x": Prbs(order=2)}, {}, "order = 2: must lie between 3 and 20"),
        ({"x": Prbs(frequency_hz=3000.0)}, {"rate_hz": 1000.0}, "clock 3000 Hz"),
        ({"x": Staircase(levels=1)}, {}, "levels = 1"),
        ({"x": Staircase(hold_s=1e9)}, {}, "rows"),
        ({"x": Sweeps(speeds=(0.0,))}, {}, "speed 0 m/s must be above 0"),
        ({"x": Sweeps(speeds=(1e-12,))}, {}, "rows"),
        ({"x": Steps(jerk=Share(0.1))}, {}, "jerk"),
        ({"x": Steps(cycles=0)}, {}, "cycles = 0"),
    ],
)
def test_the_impossible_is_refused(plan, keywords, words):
    with pytest.raises(ExcitationError, match=words):
        excite(ROBOTS["rotemina"], plan, **keywords)


def test_a_force_that_nothing_holds_is_not_excited():
    robot = ROBOTS["emps"]
    free = replace(robot, axes={"q": replace(robot.axes["q"], controller=None)})
    with pytest.raises(TrajectoryError, match="no controller"):
        excite(free, {"q": Sine()})
