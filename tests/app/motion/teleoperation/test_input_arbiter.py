"""Conversations with the arbiter: readings at 100 Hz in, intents out."""

from math import nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.app.motion.teleoperation.axis_calibration import (
    AxisCalibration,
    Calibration,
    CalibrationError,
)
from rotemina.app.motion.teleoperation.input_arbiter import InputArbiter
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
)
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.drivers.inputs.device import InputIdentity, InputReading

ROBOT = ("x", "y", "z", "thx", "thy", "zn")
STEP_S = 0.01
REST = (0.0, 0.0)
BUTTONS = ("stop", "stage", "dead", "fine", "take")
ACTIONS = dict(
    zip(
        BUTTONS,
        (Action.STOP, Action.STAGE, Action.DEAD_MAN, Action.FINE, Action.TAKE_OVER),
        strict=True,
    )
)


def stick(key, streams=False, axes=("X", "Y"), buttons=BUTTONS):
    return PluggedDevice(InputIdentity(key, f"stick {key}", "hid"), axes, buttons, streams)


def mapping(key, seat=OperatorRole.TRAINER, without=(Action.DEAD_MAN,), drives=("x", "y")):
    axes = tuple(
        AxisMapping(control=control, drives=target)
        for control, target in zip("XY", drives, strict=False)
    )
    actions = tuple(
        ActionMapping(control=control, action=action)
        for control, action in ACTIONS.items()
        if action not in without
    )
    return DeviceMapping(key=key, seat=seat, axes=axes, actions=actions)


def profile(*devices):
    return Profile(name="Bench", devices=devices)


class Bench:
    """A arbiter, what its devices say at present, and the time."""

    def __init__(self, *mappings, devices=("a",), streams=False, calibration=None):
        self.arbiter = InputArbiter(ROBOT, profile(*(mappings or [mapping("a")])))
        self.now_s = 0.0
        self.state = {}
        for key in devices:
            self.arbiter.plug(stick(key, streams), calibration)
            self.state[key] = (REST, ())

    def say(self, key="a", axes=None, held=()):
        """Set what a device says from now on."""
        self.state[key] = (axes or self.state[key][0], held)
        return self

    def silence(self, key="a"):
        """Let a device say nothing any more."""
        del self.state[key]

    def step(self):
        """Return the intent one step later."""
        self.now_s += STEP_S
        readings = {
            key: [InputReading(self.now_s, axes, tuple(name in held for name in BUTTONS))]
            for key, (axes, held) in self.state.items()
        }
        return self.arbiter.step(readings, self.now_s)

    def run(self, seconds):
        """Return the intents of a while."""
        return [self.step() for _ in range(round(seconds / STEP_S))]

    def reasons(self, key="a"):
        views = {view.device.identity.key: view for view in self.arbiter.views}
        return [axis.reason for axis in views[key].axes]


def pressed(intents):
    return [action for intent in intents for action in sorted(intent.pressed)]


def lost(intents):
    return [intent.lost for intent in intents if intent.lost is not None]


# One device


def test_a_stick_at_rest_earns_trust_and_then_deflects():
    bench = Bench()
    assert bench.step().deflections == {}
    assert bench.run(0.2)[-1].deflections == {"x": 0.0, "y": 0.0}
    intent = bench.say(axes=(1.0, -1.0)).step()
    assert intent.deflections == {"x": 1.0, "y": -1.0}
    assert (intent.device, intent.host_time_s, intent.lost) == ("a", bench.now_s, None)


def test_a_stick_that_was_never_centred_moves_nothing_on_that_axis_only():
    bench = Bench().say(axes=(0.6, 0.0))
    assert bench.run(1.0)[-1].deflections == {"y": 0.0}
    assert "release it" in bench.reasons()[0]
    assert bench.reasons()[1] is None


def test_a_saturated_stick_is_named():
    bench = Bench().say(axes=(1.0, 0.0))
    assert "x" not in bench.run(1.0)[-1].deflections
    assert "at its end from the start" in bench.reasons()[0]


def test_a_jittering_axis_stops_acting_and_the_other_goes_on():
    bench = Bench()
    bench.run(0.2)
    for count in range(30):
        intent = bench.say(axes=(0.9 if count % 2 else -0.9, 0.5)).step()
    assert set(intent.deflections) == {"y"}
    assert "jitters" in bench.reasons()[0]


@pytest.mark.parametrize("raw", [nan, 7.0])
def test_numbers_that_are_none_move_nothing(raw):
    bench = Bench()
    bench.run(0.2)
    assert set(bench.say(axes=(raw, 0.5)).step().deflections) == {"y"}
    assert bench.reasons()[0] is not None
    assert bench.arbiter.views[0].axes[0].deflection in (0.0, 1.0)


def test_a_swapped_stick_with_other_controls_is_refused_where_it_is_mapped():
    bench = Bench()
    bench.run(0.2)
    bench.arbiter.unplug("a")
    bench.arbiter.plug(stick("a", axes=("X", "Rz")))
    assert bench.run(1.0)[-1].deflections == {}
    assert "has no axis 'Y'; it has X, Rz" in bench.arbiter.problems[0]
    assert bench.arbiter.views[0].problem == bench.arbiter.problems[0]


def test_readings_of_another_shape_move_nothing():
    bench = Bench()
    bench.run(0.2)
    reading = InputReading(bench.now_s, (1.0,), ())
    assert bench.arbiter.step({"a": [reading]}, bench.now_s).deflections == {}
    assert "a reading has 1 axes and 0 buttons" in bench.reasons()[0]
    assert bench.run(0.2)[-1].deflections == {"x": 0.0, "y": 0.0}


def test_a_device_whose_readings_stop_matching_is_lost_once_and_wants_the_centre():
    bench = Bench()
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0), held=("fine",)).run(0.1)
    intents = []
    for _ in range(3):
        bench.now_s += STEP_S
        reading = InputReading(bench.now_s, (1.0,), ())
        intents.append(bench.arbiter.step({"a": [reading]}, bench.now_s))
    [why] = lost(intents)
    assert why.startswith("stick a: a reading has 1 axes and 0 buttons, but the device has 2")
    assert intents[0].lost == why
    assert intents[0].held == frozenset()
    [view] = bench.arbiter.views
    assert why.endswith(view.problem)
    assert view.newest is None
    assert bench.run(0.5)[-1].deflections == {"y": 0.0}  # it is still deflected
    assert bench.say(axes=REST).run(0.2)[-1].deflections["x"] == 0.0


def test_that_a_device_streams_may_turn_out_while_it_is_open():
    bench = Bench()
    bench.run(0.2)
    bench.silence()
    assert lost(bench.run(1.0)) == []
    bench.state["a"] = (REST, ())
    bench.run(0.2)
    bench.arbiter.inform("a", streams=True)
    bench.silence()
    assert len(lost(bench.run(1.0))) == 1


def test_a_view_has_what_was_said_and_the_buttons_that_are_down():
    bench = Bench()
    bench.say(axes=(0.5, 0.0), held=("fine", "take")).run(0.1)
    [view] = bench.arbiter.views
    assert view.lit == {"fine", "take"}
    assert view.newest.axes == (0.5, 0.0)
    assert view.calibration == Calibration(device="a")


def test_unplugging_is_said_once_and_replugging_wants_the_centre():
    bench = Bench()
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0)).run(0.1)
    bench.arbiter.unplug("a")
    intents = bench.run(0.2)
    assert lost(intents) == ["stick a: unplugged"]
    assert intents[0].lost is not None
    assert all(not intent.deflections for intent in intents)
    bench.arbiter.plug(stick("a"))
    assert "x" not in bench.run(0.5)[-1].deflections
    assert bench.say(axes=REST).run(0.2)[-1].deflections["x"] == 0.0


def test_plugging_in_what_is_there_already_is_a_replug():
    bench = Bench()
    bench.say(axes=REST).run(0.2)
    bench.arbiter.plug(stick("a"))
    assert lost(bench.say(axes=(0.5, 0.0)).run(0.1)) == ["stick a: replugged"]
    assert bench.run(0.5)[-1].deflections == {"y": 0.0}


def test_a_stick_that_streams_is_lost_when_it_falls_silent_and_drops_what_it_held():
    bench = Bench(streams=True)
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0), held=("fine",)).run(0.1)
    bench.silence()
    intents = bench.run(1.0)
    [why] = lost(intents)
    assert why.startswith("stick a: silent: a streaming device")
    assert intents[20].deflections == {"x": 1.0, "y": 0.0}
    assert intents[-1].deflections == {}
    assert intents[-1].held == frozenset()
    assert "silent" in bench.reasons()[0]
    bench.state["a"] = ((1.0, 0.0), ("fine",))
    intent = bench.run(0.3)[-1]
    assert (intent.deflections, intent.held) == ({"y": 0.0}, frozenset())


def test_a_calibration_acts_at_once_and_wants_the_centre():
    bench = Bench()
    bench.say(axes=(0.5, 0.0)).run(0.2)
    axis = AxisCalibration(low=-0.9, centre=0.5, high=1.0, dead_zone=0.05, travel_m=0.02)
    bench.arbiter.calibrate("a", Calibration(device="a", axes={"X": axis}))
    assert lost([bench.step()]) == ["stick a: recalibrated"]
    assert bench.run(0.2)[-1].deflections == {"x": 0.0, "y": 0.0}
    assert bench.say(axes=(1.0, 0.0)).step().deflections["x"] == 1.0
    assert (bench.arbiter.travel_m("x"), bench.arbiter.travel_m("y")) == (0.02, None)
    with pytest.raises(CalibrationError, match="'b' is not plugged in"):
        bench.arbiter.calibrate("b", Calibration(device="b"))
    with pytest.raises(CalibrationError, match="is for 'b', not for 'a'"):
        bench.arbiter.calibrate("a", Calibration(device="b"))


def test_a_mapping_may_turn_an_axis_round():
    axes = (AxisMapping(control="X", drives="thx", inverted=True),)
    bench = Bench(DeviceMapping(key="a", axes=axes))
    bench.run(0.2)
    assert bench.say(axes=(1.0, 0.0)).step().deflections == {"thx": -1.0}


# Buttons


def test_a_press_is_told_once_and_a_hold_as_long_as_it_lasts():
    bench = Bench()
    bench.run(0.1)
    intents = bench.say(held=("stage",)).run(0.5)
    assert pressed(intents) == [Action.STAGE]
    assert all(intent.held == {Action.STAGE} for intent in intents)
    assert bench.say().run(0.1)[-1].held == frozenset()


def test_a_press_between_two_steps_is_not_missed():
    bench = Bench()
    bench.run(0.1)
    downs = [(0.002, True), (0.004, False), (0.006, True), (0.009, False)]
    readings = [
        InputReading(bench.now_s + after_s, REST, (False, down, False, False, False))
        for after_s, down in downs
    ]
    intent = bench.arbiter.step({"a": readings}, bench.now_s + 0.01)
    assert intent.pressed == {Action.STAGE}


def test_fine_is_held_and_never_pressed():
    bench = Bench()
    bench.run(0.1)
    intents = bench.say(held=("fine",)).run(0.1)
    assert pressed(intents) == []
    assert intents[-1].held == {Action.FINE}


def test_without_its_dead_man_a_stick_does_nothing():
    bench = Bench(mapping("a", without=()))
    bench.run(0.2)
    assert bench.say(axes=(1.0, 0.0)).step().deflections == {}
    assert bench.say(held=("dead",)).step().deflections == {"x": 1.0, "y": 0.0}
    bench.say().run(0.05)
    assert bench.step().deflections == {}


def test_a_dead_man_that_is_taped_down_does_nothing():
    bench = Bench(mapping("a", without=())).say(held=("dead",))
    assert bench.run(1.0)[-1].deflections == {}


def test_a_dead_man_on_another_device_that_is_missing_holds_all_back():
    pedal = DeviceMapping(
        key="pedal", actions=(ActionMapping(control="dead", action=Action.DEAD_MAN),)
    )
    bench = Bench(mapping("a"), pedal)
    assert bench.say(held=("dead",)).run(1.0)[-1].deflections == {}
    assert (
        "needs pedal, which is not connected; connected: stick a (a)" in bench.arbiter.problems[0]
    )
    bench.arbiter.plug(stick("pedal"))
    bench.state["pedal"] = (REST, ())
    bench.run(0.2)
    assert bench.say("pedal", held=("dead",)).step().deflections == {"x": 0.0, "y": 0.0}
    assert bench.arbiter.problems == ()


def test_losing_the_pedal_of_a_seat_stops_its_stick():
    pedal = DeviceMapping(key="p", actions=(ActionMapping(control="stop", action=Action.STOP),))
    bench = Bench(mapping("a"), pedal, devices=("a", "p"))
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0)).step()
    bench.arbiter.unplug("p")
    intents = bench.run(0.5)
    assert lost(intents) == ["stick p: unplugged"]
    assert "x" not in intents[-1].deflections


def test_a_device_without_a_part_may_come_and_go():
    bench = Bench(devices=("a", "spare"))
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0)).step()
    bench.arbiter.unplug("spare")
    assert lost(bench.run(0.1)) == []
    assert bench.step().deflections["x"] == 1.0


def test_an_axis_beyond_a_threshold_is_a_button():
    actions = (
        ActionMapping(control="Y", action=Action.STOP, at=-0.9),
        ActionMapping(control="Y", action=Action.FINE, at=0.5),
    )
    bench = Bench(DeviceMapping(key="a", actions=actions))
    bench.run(0.1)
    assert bench.say(axes=(0.0, 0.8)).step().held == {Action.FINE}
    bench.say(axes=(0.0, 0.0)).run(0.1)
    assert pressed(bench.say(axes=(0.0, -1.0)).run(0.1)) == [Action.STOP]


def test_a_jittering_axis_presses_nothing():
    bench = Bench(
        DeviceMapping(key="a", actions=(ActionMapping(control="Y", action=Action.STAGE, at=0.5),))
    )
    intents = []
    for count in range(200):
        intents.append(bench.say(axes=(0.0, 1.0 if count % 2 else -1.0)).step())
    assert len(pressed(intents)) < 6
    assert pressed(intents[30:]) == []


# Mapping


def test_while_mappings_are_made_nothing_is_sent_but_stops():
    bench = Bench()
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0)).step()
    bench.arbiter.open_mapping()
    assert bench.arbiter.mapping_open
    intents = bench.run(0.2) + bench.say(held=("stage", "fine")).run(0.1)
    assert lost(intents) == ["input devices are being set up"]
    assert all((i.deflections, i.pressed, i.held) == ({}, set(), set()) for i in intents)
    intents = bench.say(held=("stop",)).run(0.1)
    assert pressed(intents) == [Action.STOP]
    assert intents[-1].held == {Action.STOP}
    assert bench.arbiter.views[0].axes[0].raw == 1.0


def test_afterwards_sticks_and_buttons_must_be_let_go_of():
    bench = Bench()
    bench.run(0.2)
    bench.arbiter.open_mapping()
    bench.say(axes=(1.0, 0.0), held=("stage",)).run(0.2)
    bench.arbiter.close_mapping()
    intents = bench.run(0.5)
    assert "x" not in intents[-1].deflections
    assert pressed(intents) == []
    bench.say(axes=REST).run(0.2)
    assert pressed(bench.say(held=("stage",)).run(0.1)) == [Action.STAGE]
    assert bench.step().deflections == {"x": 0.0, "y": 0.0}


@pytest.mark.parametrize(("raw", "acts"), [(0.02, True), (0.5, False)])
def test_one_that_speaks_only_of_changes_is_remembered_when_all_begins_anew(raw, acts):
    bench = Bench()
    bench.say(axes=(raw, 0.0), held=("stage", "stop")).run(0.2)
    bench.silence()
    bench.arbiter.open_mapping()
    bench.step()
    bench.arbiter.close_mapping()
    bench.arbiter.use(profile(mapping("a")))
    intents = bench.run(0.5)
    assert ("x" in intents[-1].deflections) is acts
    assert intents[-1].held == {Action.STOP}
    assert bench.arbiter.views[0].axes[0].raw == raw


def test_what_a_silent_stream_said_is_not_remembered():
    bench = Bench(streams=True)
    bench.run(0.2)
    bench.silence()
    bench.run(0.5)
    bench.arbiter.use(profile(mapping("a", drives=("thx", "thy"))))
    assert bench.run(0.1)[-1].deflections == {}


def test_another_profile_acts_after_the_centre_and_a_bad_one_not_at_all():
    bench = Bench()
    bench.run(0.2)
    bench.say(axes=(1.0, 0.0)).step()
    with pytest.raises(ProfileError, match="two owners"):
        bench.arbiter.use(profile(mapping("a", drives=("z", "zn"))))
    with pytest.raises(ProfileError, match="has no button 'nine'"):
        bench.arbiter.use(
            profile(
                DeviceMapping(key="*", actions=(ActionMapping(control="nine", action=Action.STOP),))
            )
        )
    assert bench.step().deflections == {"x": 1.0, "y": 0.0}
    bench.arbiter.use(profile(mapping("a", drives=("thx", "thy"))))
    assert lost([bench.step()]) == ["another profile is now in use"]
    assert bench.step().deflections == {}
    assert bench.say(axes=REST).run(0.2)[-1].deflections == {"thx": 0.0, "thy": 0.0}


def test_a_profile_for_another_device_drives_nothing_and_says_so():
    bench = Bench(mapping("hid:046d:*"))
    assert bench.run(1.0)[-1].deflections == {}
    assert bench.arbiter.problems == (
        "profile 'Bench' needs hid:046d:*, which is not connected; connected: stick a (a). "
        "Connect it, or choose or create another profile",
    )


def test_without_a_profile_nothing_is_driven_and_a_bad_one_is_refused_at_once():
    arbiter = InputArbiter(ROBOT)
    arbiter.plug(stick("a"))
    intent = arbiter.step({"a": [InputReading(0.0, REST, (True,) * 5)]}, 0.0)
    assert (intent.deflections, intent.pressed, intent.device) == ({}, set(), "")
    assert "no profile" in arbiter.problems[0]
    with pytest.raises(ProfileError):
        InputArbiter(("x",), profile(mapping("a", drives=("phi",))))


def test_readings_of_a_device_that_has_gone_are_passed_over():
    bench = Bench()
    bench.arbiter.unplug("a")
    bench.arbiter.unplug("a")
    assert bench.run(0.1)[-1].deflections == {}


# Trainer and trainee


@pytest.fixture
def school():
    """Return a bench at which trainer ``a`` drives, and trainee ``b`` looks on."""
    bench = Bench(mapping("a"), mapping("b", OperatorRole.TRAINEE), devices=("a", "b"))
    bench.run(0.2)
    return bench


def give_to_the_trainee(bench):
    bench.say("b", held=("take",)).run(0.1)
    return bench.say("b", axes=REST).run(0.2)


def test_the_trainee_looks_on_but_may_stop(school):
    intents = school.say("b", axes=(1.0, 0.0), held=("stage", "fine")).run(0.2)
    assert intents[-1].deflections == {"x": 0.0, "y": 0.0}
    assert (pressed(intents), intents[-1].held, intents[-1].device) == ([], set(), "a")
    assert pressed(school.say("b", held=("stop",)).run(0.1)) == [Action.STOP]


def test_the_trainee_takes_over_by_the_button_and_from_rest(school):
    intents = school.say("b", axes=(1.0, 0.0), held=("take",)).run(0.2)
    assert lost(intents) == ["the trainee has taken over"]
    assert pressed(intents) == [Action.TAKE_OVER]
    assert "x" not in intents[-1].deflections
    school.say("b", axes=REST).run(0.2)
    intent = school.say("b", axes=(0.0, 1.0)).step()
    assert (intent.deflections, intent.device) == ({"x": 0.0, "y": 1.0}, "b")
    assert [view.drives for view in school.arbiter.views] == [False, True]


@pytest.mark.parametrize("how", [{"axes": (0.4, 0.0)}, {"held": ("take",)}])
def test_the_trainer_takes_over_at_once_by_moving_or_by_the_button(school, how):
    give_to_the_trainee(school)
    school.say("b", axes=(1.0, 0.0)).step()
    intent = school.say("a", **how).step()
    assert intent.lost == "the trainer has taken over"
    assert "x" not in intent.deflections or how.get("held")
    assert 1.0 not in intent.deflections.values()
    assert school.arbiter.driving is OperatorRole.TRAINER
    assert school.say("a", axes=REST).run(0.2)[-1].deflections == {"x": 0.0, "y": 0.0}


def test_a_trainer_who_takes_over_by_moving_drives_from_rest_only(school):
    give_to_the_trainee(school)
    intents = school.say("a", axes=(0.9, 0.0)).run(1.0)
    assert all("x" not in intent.deflections for intent in intents)
    assert "release it first" in school.reasons("a")[0]


def test_a_touch_of_the_trainers_stick_does_not_take_over(school):
    give_to_the_trainee(school)
    assert lost(school.say("a", axes=(0.2, 0.0)).run(0.5)) == []
    assert school.arbiter.driving is OperatorRole.TRAINEE


def test_the_trainer_never_gives_the_drive_away_by_the_same_button(school):
    school.say("a", held=("take",)).run(0.1)
    assert school.arbiter.driving is OperatorRole.TRAINER


def test_the_trainee_does_not_get_it_while_the_trainer_moves(school):
    school.say("a", axes=(1.0, 0.0)).step()
    assert lost(school.say("b", held=("take",)).run(0.2)) == []
    assert school.step().deflections["x"] == 1.0


def test_the_trainee_does_not_get_it_back_by_moving(school):
    give_to_the_trainee(school)
    school.say("a", held=("take",)).run(0.1)
    school.say("a").run(0.1)
    assert lost(school.say("b", axes=(1.0, 1.0)).run(0.5)) == []
    assert school.arbiter.driving is OperatorRole.TRAINER


def test_without_the_trainer_the_trainee_does_not_drive(school):
    give_to_the_trainee(school)
    school.say("b", axes=(1.0, 0.0)).step()
    school.arbiter.unplug("a")
    intents = school.run(0.2)
    assert "the trainee cannot drive alone" in lost(intents)[0]
    assert intents[-1].deflections == {}
    assert lost(school.say("b", held=("take",)).run(0.2)) == []


def test_a_dead_man_guards_its_own_seat_only():
    trainer, trainee = mapping("a"), mapping("b", OperatorRole.TRAINEE, without=())
    bench = Bench(trainer, trainee, devices=("a", "b"))
    bench.run(0.2)
    assert bench.step().deflections == {"x": 0.0, "y": 0.0}
    give_to_the_trainee(bench)
    assert bench.run(0.2)[-1].deflections == {}
    assert bench.say("b", held=("dead",)).step().deflections == {"x": 0.0, "y": 0.0}


def test_the_drive_does_not_change_while_mappings_are_made(school):
    school.arbiter.open_mapping()
    school.say("b", held=("take",)).run(0.1)
    school.arbiter.close_mapping()
    school.run(0.1)
    assert school.arbiter.driving is OperatorRole.TRAINER


# Whatever happens

RAW = st.sampled_from([0.0, 0.02, 0.3, -0.7, 1.0, -1.0, nan, 3.0])
EVENTS = st.one_of(
    st.tuples(
        st.just("say"),
        st.sampled_from("ab"),
        st.tuples(RAW, RAW),
        st.sets(st.sampled_from(BUTTONS)),
    ),
    st.tuples(st.sampled_from(["unplug", "plug"]), st.sampled_from("ab")),
    st.tuples(st.sampled_from(["open_mapping", "close_mapping"])),
)


@given(st.lists(st.tuples(EVENTS, st.sampled_from([1, 3, 20])), max_size=30), st.booleans())
def test_what_no_conversation_can_bring_about(events, streams):
    """No deflection without trust, dead-man and a closed mapping; a stop is always heard."""
    bench = Bench(
        mapping("a", without=()),
        mapping("b", OperatorRole.TRAINEE),
        devices=("a", "b"),
        streams=streams,
    )
    for (name, *details), steps in events:
        if name == "say":
            bench.say(*details)
        elif name == "plug":
            bench.arbiter.plug(stick(details[0], streams))
        else:
            getattr(bench.arbiter, name)(*details)
        for intent in bench.run(steps * STEP_S):
            assert intent.pressed <= intent.held
        views = bench.arbiter.views
        said = [bench.state[view.device.identity.key] for view in views]
        if steps == 20:
            assert (Action.STOP in intent.held) is any("stop" in held for _, held in said)
        if intent.deflections:
            assert not bench.arbiter.mapping_open
            assert bench.arbiter.driving is OperatorRole.TRAINEE or Action.DEAD_MAN in intent.held
            (view,) = (view for view in views if view.drives)
            assert set(intent.deflections) == {axis.drives for axis in view.axes if not axis.reason}
            assert all(abs(value) <= 1.0 for value in intent.deflections.values())
