"""The input arbiter: readings at 100 Hz in, intents out."""

from math import nan

import pytest
from hypothesis import given, strategies as st

from rotemina.app.errors import InputCalibrationError, InputProfileError
from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputArbiter,
    InputAxisCalibration,
    InputCalibration,
    InputProfile,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
)
from rotemina.drivers.inputs import InputIdentity, InputReading

ROBOT = ("x", "y", "z", "thx", "thy", "zn")
STEP_S = 0.01
REST = (0.0, 0.0)
ACTIONS = {
    "stop": OperatorAction.STOP,
    "stage": OperatorAction.STAGE,
    "dead": OperatorAction.DEAD_MAN,
    "fine": OperatorAction.FINE,
    "take": OperatorAction.TAKE_OVER,
}
BUTTONS = tuple(ACTIONS)


def make_stick(key, streams=False, axes=("X", "Y"), buttons=BUTTONS):
    return PluggedDevice(InputIdentity(key, f"stick {key}", "hid"), axes, buttons, streams)


def make_mapping(
    key, seat=OperatorRole.TRAINER, excluded=(OperatorAction.DEAD_MAN,), drives=("x", "y")
):
    axes = tuple(
        AxisMapping(control=control, drives=target)
        for control, target in zip("XY", drives, strict=False)
    )
    actions = tuple(
        ActionMapping(control=control, action=action)
        for control, action in ACTIONS.items()
        if action not in excluded
    )
    return DeviceMapping(key=key, seat=seat, axes=axes, actions=actions)


def make_profile(*devices):
    return InputProfile(name="Bench", devices=devices)


class ArbiterBench:
    """An arbiter, the current reports of its devices, and the time."""

    def __init__(self, *mappings, devices=("a",), streams=False):
        self.arbiter = InputArbiter(ROBOT, make_profile(*(mappings or [make_mapping("a")])))
        self.now_s = 0.0
        self.state = {}
        for key in devices:
            self.arbiter.plug(make_stick(key, streams))
            self.state[key] = (REST, ())

    def report(self, key="a", axes=None, held=()):
        """Set the report that a device repeats from now on."""
        self.state[key] = (axes or self.state[key][0], held)
        return self

    def stop_reporting(self, key="a"):
        """Let a device send no more reports."""
        del self.state[key]

    def step(self):
        """Take one step and return its intent."""
        self.now_s += STEP_S
        readings = {
            key: [InputReading(self.now_s, axes, tuple(name in held for name in BUTTONS))]
            for key, (axes, held) in self.state.items()
        }
        return self.arbiter.step(readings, self.now_s)

    def run(self, seconds):
        """Return the intents of this period."""
        return [self.step() for _ in range(round(seconds / STEP_S))]

    def list_reasons(self, key="a"):
        views = {view.device.identity.key: view for view in self.arbiter.device_views}
        return [axis.reason for axis in views[key].axes]


def list_presses(intents):
    return [action for intent in intents for action in sorted(intent.pressed)]


def list_losses(intents):
    return [intent.loss_reason for intent in intents if intent.loss_reason is not None]


# One device


def test_only_the_axis_that_was_never_centred_stays_inactive():
    bench = ArbiterBench().report(axes=(0.6, 0.0))
    assert bench.run(1.0)[-1].deflections == {"y": 0.0}
    assert "release it" in bench.list_reasons()[0]
    assert bench.list_reasons()[1] is None


def test_a_swapped_stick_without_a_mapped_control_is_refused():
    bench = ArbiterBench()
    bench.run(0.2)
    bench.arbiter.unplug("a")
    bench.arbiter.plug(make_stick("a", axes=("X", "Rz")))
    assert bench.run(1.0)[-1].deflections == {}
    assert "has no axis 'Y'; it has X, Rz" in bench.arbiter.problems[0]
    assert bench.arbiter.device_views[0].problem == bench.arbiter.problems[0]


def test_plugging_in_a_device_twice_is_a_replug():
    bench = ArbiterBench()
    bench.report(axes=REST).run(0.2)
    bench.arbiter.plug(make_stick("a"))
    assert list_losses(bench.report(axes=(0.5, 0.0)).run(0.1)) == ["stick a: replugged"]
    assert bench.run(0.5)[-1].deflections == {"y": 0.0}


def test_a_calibration_acts_at_once_and_the_stick_must_be_centred():
    bench = ArbiterBench()
    bench.report(axes=(0.5, 0.0)).run(0.2)
    axis = InputAxisCalibration(low=-0.9, centre=0.5, high=1.0, dead_zone=0.05, travel_m=0.02)
    bench.arbiter.use_calibration("a", InputCalibration(device="a", axes={"X": axis}))
    assert list_losses([bench.step()]) == ["stick a: recalibrated"]
    assert bench.run(0.2)[-1].deflections == {"x": 0.0, "y": 0.0}
    assert bench.report(axes=(1.0, 0.0)).step().deflections["x"] == 1.0
    assert (bench.arbiter.find_travel_m("x"), bench.arbiter.find_travel_m("y")) == (0.02, None)
    with pytest.raises(InputCalibrationError, match="'b' is not plugged in"):
        bench.arbiter.use_calibration("b", InputCalibration(device="b"))
    with pytest.raises(InputCalibrationError, match="is for 'b', not for 'a'"):
        bench.arbiter.use_calibration("a", InputCalibration(device="b"))


def test_a_mapping_can_invert_an_axis():
    axes = (AxisMapping(control="X", drives="thx", inverted=True),)
    bench = ArbiterBench(DeviceMapping(key="a", axes=axes))
    bench.run(0.2)
    assert bench.report(axes=(1.0, 0.0)).step().deflections == {"thx": -1.0}


# Buttons


def test_a_press_counts_once_and_a_hold_as_long_as_it_lasts():
    bench = ArbiterBench()
    bench.run(0.1)
    intents = bench.report(held=("stage", "fine")).run(0.5)
    assert list_presses(intents) == [OperatorAction.STAGE]  # fine is only held
    assert all(intent.held == {OperatorAction.STAGE, OperatorAction.FINE} for intent in intents)
    assert bench.report().run(0.1)[-1].held == frozenset()


def test_a_press_between_two_steps_is_not_missed():
    bench = ArbiterBench()
    bench.run(0.1)
    states = [(0.002, True), (0.004, False), (0.006, True), (0.009, False)]
    readings = [
        InputReading(bench.now_s + offset_s, REST, (False, is_down, False, False, False))
        for offset_s, is_down in states
    ]
    intent = bench.arbiter.step({"a": readings}, bench.now_s + 0.01)
    assert intent.pressed == {OperatorAction.STAGE}


def test_without_its_dead_man_switch_a_stick_does_nothing():
    bench = ArbiterBench(make_mapping("a", excluded=())).report(held=("dead",))
    assert bench.run(1.0)[-1].deflections == {}  # it was held from the start
    bench.report(axes=REST).run(0.2)
    assert bench.report(axes=(1.0, 0.0)).step().deflections == {}
    assert bench.report(held=("dead",)).step().deflections == {"x": 1.0, "y": 0.0}
    bench.report().run(0.05)
    assert bench.step().deflections == {}


def test_a_missing_device_with_the_dead_man_switch_blocks_all_axes():
    pedal = DeviceMapping(
        key="pedal", actions=(ActionMapping(control="dead", action=OperatorAction.DEAD_MAN),)
    )
    bench = ArbiterBench(make_mapping("a"), pedal)
    assert bench.report(held=("dead",)).run(1.0)[-1].deflections == {}
    assert (
        "needs pedal, which is not connected; connected: stick a (a)" in bench.arbiter.problems[0]
    )
    bench.arbiter.plug(make_stick("pedal"))
    bench.state["pedal"] = (REST, ())
    bench.run(0.2)
    assert bench.report("pedal", held=("dead",)).step().deflections == {"x": 0.0, "y": 0.0}
    assert bench.arbiter.problems == ()


def test_losing_a_pedal_stops_the_stick_of_its_seat():
    pedal = DeviceMapping(
        key="p", actions=(ActionMapping(control="stop", action=OperatorAction.STOP),)
    )
    bench = ArbiterBench(make_mapping("a"), pedal, devices=("a", "p"))
    bench.run(0.2)
    bench.report(axes=(1.0, 0.0)).step()
    bench.arbiter.unplug("p")
    intents = bench.run(0.5)
    assert list_losses(intents) == ["stick p: unplugged"]
    assert "x" not in intents[-1].deflections


def test_a_device_without_a_mapping_may_come_and_go():
    bench = ArbiterBench(devices=("a", "spare"))
    bench.run(0.2)
    bench.report(axes=(1.0, 0.0)).step()
    bench.arbiter.unplug("spare")
    assert list_losses(bench.run(0.1)) == []
    assert bench.step().deflections["x"] == 1.0


def test_an_axis_beyond_a_threshold_is_a_button():
    actions = (
        ActionMapping(control="Y", action=OperatorAction.STOP, at=-0.9),
        ActionMapping(control="Y", action=OperatorAction.FINE, at=0.5),
    )
    bench = ArbiterBench(DeviceMapping(key="a", actions=actions))
    bench.run(0.1)
    assert bench.report(axes=(0.0, 0.8)).step().held == {OperatorAction.FINE}
    bench.report(axes=(0.0, 0.0)).run(0.1)
    assert list_presses(bench.report(axes=(0.0, -1.0)).run(0.1)) == [OperatorAction.STOP]


def test_a_jittering_axis_presses_nothing():
    bench = ArbiterBench(
        DeviceMapping(
            key="a", actions=(ActionMapping(control="Y", action=OperatorAction.STAGE, at=0.5),)
        )
    )
    intents = []
    for count in range(200):
        intents.append(bench.report(axes=(0.0, 1.0 if count % 2 else -1.0)).step())
    assert len(list_presses(intents)) < 6
    assert list_presses(intents[30:]) == []


# Mapping


def test_while_the_mapping_is_open_only_stops_are_sent_and_then_all_must_be_released():
    bench = ArbiterBench()
    bench.run(0.2)
    bench.report(axes=(1.0, 0.0)).step()
    bench.arbiter.open_mapping()
    assert bench.arbiter.is_mapping_open
    intents = bench.run(0.2) + bench.report(held=("stage", "fine")).run(0.1)
    assert list_losses(intents) == ["input devices are being set up"]
    assert all((i.deflections, i.pressed, i.held) == ({}, set(), set()) for i in intents)
    intents = bench.report(held=("stop",)).run(0.1)
    assert list_presses(intents) == [OperatorAction.STOP]
    assert intents[-1].held == {OperatorAction.STOP}
    assert bench.arbiter.device_views[0].axes[0].raw == 1.0
    bench.report(held=("stage",)).run(0.2)
    bench.arbiter.close_mapping()
    intents = bench.run(0.5)
    assert "x" not in intents[-1].deflections
    assert list_presses(intents) == []
    bench.report(axes=REST).run(0.2)
    assert list_presses(bench.report(held=("stage",)).run(0.1)) == [OperatorAction.STAGE]
    assert bench.step().deflections == {"x": 0.0, "y": 0.0}


@pytest.mark.parametrize(("raw", "acts"), [(0.02, True), (0.5, False)])
def test_the_state_of_a_device_that_reports_changes_survives_a_new_profile(raw, acts):
    bench = ArbiterBench()
    bench.report(axes=(raw, 0.0), held=("stage", "stop")).run(0.2)
    bench.stop_reporting()
    bench.arbiter.open_mapping()
    bench.step()
    bench.arbiter.close_mapping()
    bench.arbiter.use_profile(make_profile(make_mapping("a")))
    intents = bench.run(0.5)
    assert ("x" in intents[-1].deflections) is acts
    assert intents[-1].held == {OperatorAction.STOP}
    assert bench.arbiter.device_views[0].axes[0].raw == raw


def test_the_state_of_a_silent_stream_is_forgotten():
    bench = ArbiterBench(streams=True)
    bench.run(0.2)
    bench.stop_reporting()
    bench.run(0.5)
    bench.arbiter.use_profile(make_profile(make_mapping("a", drives=("thx", "thy"))))
    assert bench.run(0.1)[-1].deflections == {}


def test_another_profile_acts_after_centring_and_a_bad_one_not_at_all():
    bench = ArbiterBench()
    bench.run(0.2)
    bench.report(axes=(1.0, 0.0)).step()
    with pytest.raises(InputProfileError, match="two owners"):
        bench.arbiter.use_profile(make_profile(make_mapping("a", drives=("z", "zn"))))
    with pytest.raises(InputProfileError, match="has no button 'nine'"):
        bench.arbiter.use_profile(
            make_profile(
                DeviceMapping(
                    key="*", actions=(ActionMapping(control="nine", action=OperatorAction.STOP),)
                )
            )
        )
    assert bench.step().deflections == {"x": 1.0, "y": 0.0}
    bench.arbiter.use_profile(make_profile(make_mapping("a", drives=("thx", "thy"))))
    assert list_losses([bench.step()]) == ["another profile is now in use"]
    assert bench.step().deflections == {}
    assert bench.report(axes=REST).run(0.2)[-1].deflections == {"thx": 0.0, "thy": 0.0}


def test_without_a_profile_nothing_moves_and_a_bad_one_is_refused_at_once():
    arbiter = InputArbiter(ROBOT)
    arbiter.plug(make_stick("a"))
    intent = arbiter.step({"a": [InputReading(0.0, REST, (True,) * 5)]}, 0.0)
    assert (intent.deflections, intent.pressed, intent.device) == ({}, set(), "")
    assert "no profile" in arbiter.problems[0]
    with pytest.raises(InputProfileError):
        InputArbiter(("x",), make_profile(make_mapping("a", drives=("phi",))))


def test_readings_of_an_unplugged_device_are_ignored():
    bench = ArbiterBench()
    bench.arbiter.unplug("a")
    bench.arbiter.unplug("a")
    assert bench.run(0.1)[-1].deflections == {}


# Trainer and trainee


@pytest.fixture
def training_bench():
    """Return a bench at which trainer ``a`` drives and trainee ``b`` watches."""
    bench = ArbiterBench(
        make_mapping("a"), make_mapping("b", OperatorRole.TRAINEE), devices=("a", "b")
    )
    bench.run(0.2)
    return bench


def give_control_to_trainee(bench):
    bench.report("b", held=("take",)).run(0.1)
    return bench.report("b", axes=REST).run(0.2)


def test_the_trainee_cannot_drive_but_can_stop(training_bench):
    intents = training_bench.report("b", axes=(1.0, 0.0), held=("stage", "fine")).run(0.2)
    assert intents[-1].deflections == {"x": 0.0, "y": 0.0}
    assert (list_presses(intents), intents[-1].held, intents[-1].device) == ([], set(), "a")
    assert list_presses(training_bench.report("b", held=("stop",)).run(0.1)) == [
        OperatorAction.STOP
    ]


def test_the_trainee_takes_over_with_the_button_and_from_rest(training_bench):
    intents = training_bench.report("b", axes=(1.0, 0.0), held=("take",)).run(0.2)
    assert list_losses(intents) == ["the trainee has taken over"]
    assert list_presses(intents) == [OperatorAction.TAKE_OVER]
    assert "x" not in intents[-1].deflections
    training_bench.report("b", axes=REST).run(0.2)
    intent = training_bench.report("b", axes=(0.0, 1.0)).step()
    assert (intent.deflections, intent.device) == ({"x": 0.0, "y": 1.0}, "b")
    assert [view.is_driving for view in training_bench.arbiter.device_views] == [False, True]


@pytest.mark.parametrize("report", [{"axes": (0.4, 0.0)}, {"held": ("take",)}])
def test_the_trainer_takes_over_at_once_by_moving_or_by_the_button(training_bench, report):
    give_control_to_trainee(training_bench)
    training_bench.report("b", axes=(1.0, 0.0)).step()
    intents = training_bench.report("a", **report).run(0.5)
    assert intents[0].loss_reason == "the trainer has taken over"
    assert all(intent.deflections.get("x", 0.0) == 0.0 for intent in intents)
    assert training_bench.arbiter.driving_seat is OperatorRole.TRAINER
    if "axes" in report:
        assert "release it first" in training_bench.list_reasons("a")[0]
    assert training_bench.report("a", axes=REST).run(0.2)[-1].deflections == {"x": 0.0, "y": 0.0}


def test_a_touch_of_the_trainers_stick_does_not_take_over(training_bench):
    give_control_to_trainee(training_bench)
    assert list_losses(training_bench.report("a", axes=(0.2, 0.0)).run(0.5)) == []
    assert training_bench.arbiter.driving_seat is OperatorRole.TRAINEE


def test_the_trainer_cannot_give_up_control_with_the_same_button(training_bench):
    training_bench.report("a", held=("take",)).run(0.1)
    assert training_bench.arbiter.driving_seat is OperatorRole.TRAINER


def test_the_trainee_gets_no_control_while_the_trainer_moves(training_bench):
    training_bench.report("a", axes=(1.0, 0.0)).step()
    assert list_losses(training_bench.report("b", held=("take",)).run(0.2)) == []
    assert training_bench.step().deflections["x"] == 1.0


def test_the_trainee_does_not_regain_control_by_moving(training_bench):
    give_control_to_trainee(training_bench)
    training_bench.report("a", held=("take",)).run(0.1)
    training_bench.report("a").run(0.1)
    assert list_losses(training_bench.report("b", axes=(1.0, 1.0)).run(0.5)) == []
    assert training_bench.arbiter.driving_seat is OperatorRole.TRAINER


def test_without_the_trainer_the_trainee_does_not_drive(training_bench):
    give_control_to_trainee(training_bench)
    training_bench.report("b", axes=(1.0, 0.0)).step()
    training_bench.arbiter.unplug("a")
    intents = training_bench.run(0.2)
    assert "the trainee cannot drive alone" in list_losses(intents)[0]
    assert intents[-1].deflections == {}
    assert list_losses(training_bench.report("b", held=("take",)).run(0.2)) == []


def test_a_dead_man_switch_guards_only_its_own_seat():
    trainer, trainee = make_mapping("a"), make_mapping("b", OperatorRole.TRAINEE, excluded=())
    bench = ArbiterBench(trainer, trainee, devices=("a", "b"))
    bench.run(0.2)
    assert bench.step().deflections == {"x": 0.0, "y": 0.0}
    give_control_to_trainee(bench)
    assert bench.run(0.2)[-1].deflections == {}
    assert bench.report("b", held=("dead",)).step().deflections == {"x": 0.0, "y": 0.0}


def test_control_does_not_change_while_the_mapping_is_open(training_bench):
    training_bench.arbiter.open_mapping()
    training_bench.report("b", held=("take",)).run(0.1)
    training_bench.arbiter.close_mapping()
    training_bench.run(0.1)
    assert training_bench.arbiter.driving_seat is OperatorRole.TRAINER


# Any sequence of events

RAW = st.sampled_from([0.0, 0.02, 0.3, -0.7, 1.0, -1.0, nan, 3.0])
EVENTS = st.one_of(
    st.tuples(
        st.just("report"),
        st.sampled_from("ab"),
        st.tuples(RAW, RAW),
        st.sets(st.sampled_from(BUTTONS)),
    ),
    st.tuples(st.sampled_from(["unplug", "plug"]), st.sampled_from("ab")),
    st.tuples(st.sampled_from(["open_mapping", "close_mapping"])),
)


@given(st.lists(st.tuples(EVENTS, st.sampled_from([1, 3, 20])), max_size=30), st.booleans())
def test_invariants_hold_for_any_sequence_of_events(events, streams):
    """Deflections need trust, the dead-man switch and a closed mapping; a stop always acts."""
    bench = ArbiterBench(
        make_mapping("a", excluded=()),
        make_mapping("b", OperatorRole.TRAINEE),
        devices=("a", "b"),
        streams=streams,
    )
    for (name, *details), steps in events:
        if name == "report":
            bench.report(*details)
        elif name == "plug":
            bench.arbiter.plug(make_stick(details[0], streams))
        else:
            getattr(bench.arbiter, name)(*details)
        for intent in bench.run(steps * STEP_S):
            assert intent.pressed <= intent.held
        views = bench.arbiter.device_views
        states = [bench.state[view.device.identity.key] for view in views]
        if steps == 20:
            assert (OperatorAction.STOP in intent.held) is any("stop" in held for _, held in states)
        if intent.deflections:
            assert not bench.arbiter.is_mapping_open
            assert (
                bench.arbiter.driving_seat is OperatorRole.TRAINEE
                or OperatorAction.DEAD_MAN in intent.held
            )
            (view,) = (view for view in views if view.is_driving)
            assert set(intent.deflections) == {axis.drives for axis in view.axes if not axis.reason}
            assert all(abs(value) <= 1.0 for value in intent.deflections.values())
