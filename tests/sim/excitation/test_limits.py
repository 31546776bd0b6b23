"""Every excitation of every robot stays within the limits, and starts and ends at rest."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotemina.sim.errors import ExcitationRequestError, TrajectoryError
from rotemina.sim.excitation import (
    EXCITATION_KINDS,
    CapabilityShare,
    ChirpExcitation,
    DecayingTriangleExcitation,
    MultisineExcitation,
    SineExcitation,
    StaircaseExcitation,
    StepsExcitation,
    SweepsExcitation,
    TriangleExcitation,
    excite,
)
from rotemina.sim.excitation.staircase_steps_prbs import PrbsExcitation
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Tap, read_record, write_record
from rotemina.sim.robot_files import list_nominal_robots, load_robot
from rotemina.sim.trajectory.trajectory_excesses import find_violations

ROBOTS = {name: load_robot(name) for name in list_nominal_robots()}
PERIODIC = (SineExcitation, TriangleExcitation, MultisineExcitation, PrbsExcitation)

common_fields = {
    "amplitude": st.none() | st.floats(1e-3, 2.0).map(CapabilityShare),
    "offset": st.none() | st.floats(0.05, 0.95).map(CapabilityShare),
}
duration = st.floats(0.05, 3.0)
wave_fields = {**common_fields, "frequency_hz": st.floats(0.2, 60.0), "duration_s": duration}
STRATEGIES = {
    "sine": st.builds(SineExcitation, **wave_fields, periodic=st.booleans()),
    "triangle": st.builds(TriangleExcitation, **wave_fields, periodic=st.booleans()),
    "decaying-triangle": st.builds(
        DecayingTriangleExcitation, **wave_fields, growing=st.booleans()
    ),
    "staircase": st.builds(
        StaircaseExcitation, **common_fields, levels=st.integers(2, 9), hold_s=st.floats(1e-3, 0.2)
    ),
    "multisine": st.builds(
        MultisineExcitation,
        **common_fields,
        low_hz=st.floats(1.0, 20.0),
        high_hz=st.floats(25.0, 200.0),
        period_s=st.floats(0.2, 1.5),
        duration_s=duration,
        detection=st.sampled_from([0, 2, 4]),
        slope=st.floats(-2.0, 1.0),
        periodic=st.booleans(),
    ),
    "chirp": st.builds(
        ChirpExcitation,
        **common_fields,
        low_hz=st.floats(1.0, 20.0),
        high_hz=st.floats(20.0, 200.0),
        duration_s=st.floats(1.0, 4.0),
        spacing=st.sampled_from(["log", "linear"]),
    ),
    "prbs": st.builds(
        PrbsExcitation,
        **common_fields,
        frequency_hz=st.floats(20.0, 500.0),
        order=st.integers(3, 9),
        duration_s=duration,
        periodic=st.booleans(),
    ),
    "sweeps": st.builds(
        SweepsExcitation,
        **common_fields,
        speeds=st.lists(st.floats(0.05, 3.0).map(CapabilityShare), max_size=3).map(tuple),
        hold_s=st.floats(1e-3, 0.2),
    ),
    "steps": st.builds(
        StepsExcitation,
        **common_fields,
        rise_s=st.none() | st.floats(1e-3, 0.5),
        hold_s=st.floats(1e-3, 0.2),
        cycles=st.integers(1, 3),
    ),
}


def get_command(excitation, axis):
    return excitation.record.signal(axis, Tap.CMD)


def test_every_kind_has_a_strategy():
    assert set(STRATEGIES) == set(EXCITATION_KINDS)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("kind", EXCITATION_KINDS)
def test_defaults_suit_each_kind_of_axis_and_all_axes_together(kind, robot):
    model = ROBOTS[robot]
    one_of_each_kind = {(axis.kind, axis.unit): name for name, axis in model.axes.items()}
    for axes in [*((name,) for name in one_of_each_kind.values()), tuple(model.axes)]:
        excitation = excite(model, {name: EXCITATION_KINDS[kind]() for name in axes})
        assert excitation.record.axes == axes
        assert excitation.adjustments == ()
        assert find_violations(model, excitation.record) == ()
        assert excitation.record.metadata["excitation"] == kind
        assert excitation.record.duration_s < 300
        for name in axes:
            assert np.ptp(get_command(excitation, name)) > 1e-4 * model.axes[name].span
            assert excitation.record.metadata[f"excitation {name}"].startswith(
                f"{kind}; amplitude_"
            )


@pytest.mark.parametrize("kind", EXCITATION_KINDS)
@settings(max_examples=15)
@given(data=st.data())
def test_any_request_stays_within_all_limits(kind, data):
    model = ROBOTS[data.draw(st.sampled_from(list(ROBOTS)))]
    specification = data.draw(STRATEGIES[kind])
    axis = data.draw(st.sampled_from(list(model.axes)))
    rate = data.draw(st.sampled_from([1000.0, 1333.3, 2000.0, 20_000.0]))
    excitation = excite(
        model, {axis: specification}, rate_hz=rate, seed=data.draw(st.integers(0, 99))
    )
    assert find_violations(model, excitation.record) == ()
    repeated = excite(
        model, {axis: specification}, rate_hz=rate, seed=int(excitation.record.metadata["seed"])
    )
    np.testing.assert_array_equal(repeated.record.values, excitation.record.values)
    _check_ends(excitation, axis, specification)


def _check_ends(excitation, axis, specification):
    command = get_command(excitation, axis)
    low, high = command.min(), command.max()
    if getattr(specification, "periodic", False):
        period = excitation.record.period_samples
        assert excitation.record.history == "periodic"
        assert len(command) % period == 0
        np.testing.assert_array_equal(command[period:], command[:-period])
    else:
        assert excitation.record.history == "rest"
        assert command[-1] == pytest.approx(command[0], abs=1e-9 * (high - low))


@settings(max_examples=40)
@given(data=st.data())
def test_any_request_stays_within_the_limits_of_other_axes(data):
    speed = data.draw(st.none() | st.floats(1e-4, 10.0))
    acceleration = data.draw(st.none() | st.floats(1e-3, 1e3))
    start = data.draw(st.floats(-1.0, 1.0))
    robot = ROBOTS["rotemina"]
    axis = replace(
        robot.axes["x"],
        range=(start, start + data.draw(st.floats(1e-4, 0.1))),
        max_speed=speed,
        max_acceleration=acceleration,
        sensor=None,  # no tolerance for rounding
    )
    robot = replace(robot, axes={"x": axis}, couplings=())
    kind = data.draw(st.sampled_from(list(EXCITATION_KINDS)).filter(lambda name: name != "sweeps"))
    excitation = excite(robot, {"x": data.draw(STRATEGIES[kind])}, rate_hz=1000.0)
    assert find_violations(robot, excitation.record) == ()


@pytest.mark.parametrize("kind", ["sine", "staircase", "prbs"])
def test_an_excitation_stays_within_limits_after_writing_and_reading(kind, tmp_path):
    robot = ROBOTS["rotemina"]
    excitation = excite(robot, {axis: EXCITATION_KINDS[kind]() for axis in ("x", "thx", "zn")})
    units = {"x": "um", "thx": "urad", "zn": "nm"}
    write_record(excitation.record, tmp_path / "it.csv", units=units)
    record_of_file = read_record(tmp_path / "it.csv", robot=robot)
    assert find_violations(robot, record_of_file) == ()
    assert dict(record_of_file.metadata) == dict(excitation.record.metadata)


@pytest.mark.parametrize("kind", ["multisine", "prbs"])
def test_the_signal_depends_on_seed_and_axis(kind):
    robot = ROBOTS["rotemina"]
    both = excite(robot, {"thx": EXCITATION_KINDS[kind](), "thy": EXCITATION_KINDS[kind]()}, seed=4)
    alone = excite(robot, {"thy": EXCITATION_KINDS[kind]()}, seed=4)
    other = excite(robot, {"thy": EXCITATION_KINDS[kind]()}, seed=5)
    assert not np.array_equal(get_command(both, "thx"), get_command(both, "thy"))
    np.testing.assert_array_equal(get_command(both, "thy"), get_command(alone, "thy"))
    assert not np.array_equal(get_command(alone, "thy"), get_command(other, "thy"))


def test_each_axis_can_have_another_excitation_and_rests_afterwards():
    plan = {
        "thx": StepsExcitation(hold_s=0.1),
        "x": SineExcitation(amplitude=1e-3, frequency_hz=1.0, duration_s=4.0),
    }
    excitation = excite(ROBOTS["rotemina"], plan, rate_hz=1000.0)
    assert excitation.record.metadata["name"] == "steps, sine of thx, x"
    assert len(excitation.record.time_s) == 4001
    assert len(np.unique(get_command(excitation, "thx")[2000:])) == 1


def test_the_period_of_several_axes_is_their_common_one():
    def make_record(x_hz, thx_hz):
        plan = {
            "x": SineExcitation(amplitude=1e-3, frequency_hz=x_hz, duration_s=2.0, periodic=True),
            "thx": SineExcitation(frequency_hz=thx_hz, duration_s=2.0, periodic=True),
        }
        return excite(ROBOTS["rotemina"], plan, rate_hz=1000.0).record

    assert make_record(1.0, 5.0).period_samples == 1000
    assert make_record(2.5, 2.0).period_samples == 2000
    unequal = make_record(1.0, 3.3)
    assert unequal.history == "rest"
    assert unequal.period_samples is None


SPEED, ACCELERATION = "speed limit 10 mm/s", "acceleration limit 200"


@pytest.mark.parametrize(
    ("specification", "parameter", "used", "cause"),
    [
        (SineExcitation(amplitude=5e-3, frequency_hz=1.0), "amplitude", 1.5915e-3, SPEED),
        (SineExcitation(amplitude=5e-5, frequency_hz=20.0), "amplitude", 1.267e-5, ACCELERATION),
        (SineExcitation(amplitude=0.04, frequency_hz=0.01), "amplitude", 0.0275, "0 mm to 55 mm"),
        (TriangleExcitation(amplitude=5e-3, frequency_hz=1.0), "amplitude", 2.25e-3, SPEED),
        (SweepsExcitation(amplitude=5e-3, speeds=(0.02,)), "speed", 0.01, SPEED),
        (StepsExcitation(amplitude=1e-3, rise_s=0.1), "rise", 0.1875, SPEED),
        (PrbsExcitation(amplitude=1e-3, frequency_hz=25.0), "amplitude", 4e-5, ACCELERATION),
    ],
)
def test_a_request_beyond_a_limit_is_reduced_with_a_message_or_refused(
    specification, parameter, used, cause
):
    robot = ROBOTS["rotemina"]
    (adjustment,) = excite(robot, {"x": specification}, rate_hz=1000.0).adjustments
    assert (adjustment.axis, adjustment.parameter) == ("x", parameter)
    assert adjustment.used == pytest.approx(used, rel=1e-3)
    assert cause in adjustment.message
    with pytest.raises(
        ExcitationRequestError, match=f"axis x: {parameter} .* is beyond "
    ) as refusal:
        excite(robot, {"x": specification}, rate_hz=1000.0, strict=True)
    assert cause in str(refusal.value)


@pytest.mark.parametrize("kind", [SineExcitation, TriangleExcitation])
def test_a_periodic_record_starts_and_stops_within_the_acceleration_limit(kind):
    robot = ROBOTS["rotemina"]
    robot_without_sensor = replace(
        robot, axes={"x": replace(robot.axes["x"], sensor=None)}, couplings=()
    )
    specification = kind(amplitude=CapabilityShare(0.4), frequency_hz=10.0, periodic=True)
    excitation = excite(robot_without_sensor, {"x": specification}, rate_hz=1000.0)
    steps = np.diff(np.pad(get_command(excitation, "x"), 1, mode="edge"), n=2) * 1e6
    assert np.abs(steps).max() == pytest.approx(0.2, rel=1e-3)
    # Amplitudes at the bound: a/(2πf)², and a(T/2)²/8, reduced by a third for the stop.
    max_amplitude = 0.2 / (20 * np.pi) ** 2 if kind is SineExcitation else 0.2 / 1.5 * 0.05**2 / 8
    assert excitation.adjustments[0].used == pytest.approx(max_amplitude, rel=5e-3)


def test_the_predicted_motion_also_stays_in_the_range():
    specification = SineExcitation(
        amplitude=CapabilityShare(0.4), frequency_hz=1000.0, duration_s=0.2
    )  # at the resonance
    excitation = excite(ROBOTS["fsm"], {"m1": specification}, rate_hz=20_000.0)
    (adjustment,) = excitation.adjustments
    assert "the motion that the model predicts" in adjustment.message
    motion = simulate_nominal_response(ROBOTS["fsm"], excitation.record).signal("m1", Tap.REF)
    assert 4.5e-6 < np.abs(motion).max() < 5.05e-6  # 25 times the command
    with pytest.raises(ExcitationRequestError, match="the motion that the model predicts"):
        excite(ROBOTS["fsm"], {"m1": specification}, rate_hz=20_000.0, strict=True)


def test_strict_accepts_requests_within_the_limits():
    plan = {
        "x": SineExcitation(amplitude=1e-3, frequency_hz=1.0),
        "zn": TriangleExcitation(),
        "thx": PrbsExcitation(),
    }
    excitation = excite(ROBOTS["rotemina"], plan, rate_hz=2000.0, strict=True)
    assert excitation.adjustments == ()


def test_an_axis_without_dynamic_limits_may_have_few_rows():
    excitation = excite(ROBOTS["picma"], {"p": TriangleExcitation(frequency_hz=1.0)}, rate_hz=50.0)
    assert len(excitation.record.time_s) == 151


def test_the_voltage_range_also_limits_the_amplitude():
    excitation = excite(
        ROBOTS["picma"], {"p": SineExcitation(amplitude=CapabilityShare(0.5), frequency_hz=1.0)}
    )
    (adjustment,) = excitation.adjustments
    assert adjustment.used == pytest.approx(3.7 * 12.53e-6 / 2)
    assert get_command(excitation, "p").max() == pytest.approx(3.7 * 12.53e-6)


@pytest.mark.parametrize(
    ("plan", "keywords", "words"),
    [
        ({}, {}, "no axis"),
        ({"w": SineExcitation()}, {}, "'w'.*no such axis"),
        ({"x": SineExcitation()}, {"rate_hz": 0.0}, "rate 0 Hz"),
        ({"x": SineExcitation()}, {"rate_hz": float("nan")}, "rate nan Hz"),
        ({"x": SineExcitation()}, {"rate_hz": 500.0}, "axis x: rate 500 Hz is below 1000 Hz"),
        ({"x": SineExcitation()}, {"seed": -1}, "seed -1"),
        ({"x": SineExcitation(frequency_hz=-1.0)}, {}, "frequency_hz = -1"),
        (
            {"x": SineExcitation(frequency_hz=500.0)},
            {"rate_hz": 1000.0},
            "below half the rate, 500 Hz",
        ),
        ({"x": SineExcitation(frequency_hz=1e-9)}, {}, "rows"),
        ({"x": SineExcitation(amplitude=0.0)}, {}, "amplitude 0 m must be above 0"),
        ({"x": SineExcitation(amplitude=float("nan"))}, {}, "amplitude nan"),
        ({"x": SineExcitation(offset=0.055)}, {}, "offset 55 mm leaves no room"),
        ({"x": SineExcitation(offset=CapabilityShare(1.2))}, {}, "offset 120 % leaves no room"),
        ({"x": ChirpExcitation(low_hz=5.0, high_hz=2.0)}, {}, "ends below its beginning"),
        (
            {"x": ChirpExcitation(low_hz=1.0, high_hz=2.0, duration_s=0.1)},
            {},
            "less than one period",
        ),
        ({"x": MultisineExcitation(low_hz=2.1, high_hz=2.9)}, {}, "no odd multiple"),
        ({"x": MultisineExcitation(detection=1)}, {}, "detection = 1"),
        ({"x": MultisineExcitation(slope=float("inf"))}, {}, "slope = inf"),
        ({"x": PrbsExcitation(order=2)}, {}, "order = 2: must lie between 3 and 20"),
        ({"x": PrbsExcitation(frequency_hz=3000.0)}, {"rate_hz": 1000.0}, "clock 3000 Hz"),
        ({"x": StaircaseExcitation(levels=1)}, {}, "levels = 1"),
        ({"x": StaircaseExcitation(hold_s=1e9)}, {}, "rows"),
        ({"x": SweepsExcitation(speeds=(0.0,))}, {}, "speed 0 m/s must be above 0"),
        ({"x": SweepsExcitation(speeds=(1e-12,))}, {}, "rows"),
        ({"x": StepsExcitation(jerk=CapabilityShare(0.1))}, {}, "jerk"),
        ({"x": StepsExcitation(cycles=0)}, {}, "cycles = 0"),
    ],
)
def test_impossible_requests_are_refused(plan, keywords, words):
    with pytest.raises(ExcitationRequestError, match=words):
        excite(ROBOTS["rotemina"], plan, **keywords)


def test_a_force_axis_without_controller_is_refused():
    robot = ROBOTS["emps"]
    free = replace(robot, axes={"q": replace(robot.axes["q"], controller=None)})
    with pytest.raises(TrajectoryError, match="no controller"):
        excite(free, {"q": SineExcitation()})
