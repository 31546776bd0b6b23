"""What is said of devices that drive, wait, look on, or cannot be used."""

from dataclasses import replace

import pytest

from rotemina.app.motion.teleoperation.input_arbiter import DevicesView
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.pad import Pad
from rotemina.plugins.inputs.words import (
    ACTION_TIPS,
    ACTIONS,
    axis_targets,
    entries,
    headline,
    target_name,
    troubles,
    udev_rule,
)


def standings(bench):
    bench.run(0.05)
    return {one.name: one.standing for one in entries(bench.devices.view, bench.devices.hub)}


def test_every_action_has_its_words():
    assert set(ACTIONS) == set(ACTION_TIPS) == set(Action)
    assert len(set(ACTIONS.values())) == len(ACTIONS)


def test_axes_that_the_stick_moves_are_not_offered_twice():
    targets = axis_targets(("x", "y", "z", "thx", "thy", "zn"))
    assert targets == ("x", "y", "z", "thx", "thy", "zn")
    assert [target_name(target) for target in targets[2:4]] == ["Stick Z", "θx"]


def test_a_device_waits_and_then_drives(make_bench, make_stick):
    stick = make_stick()
    stick.deflect("Y", 0.5)
    bench = make_bench(stick)
    assert standings(bench) == {"stick": "trainer, waiting for Y"}
    stick.deflect("Y", 0.0)
    bench.run()
    assert standings(bench) == {"stick": "trainer, in control"}
    assert headline(bench.devices.view, 0) == "stick may control the robot."
    bench.devices.open_mapping()
    assert standings(bench) == {"stick": "trainer, being set up"}
    assert headline(bench.devices.view, 0) == "Set-up: no device controls the robot."


def test_one_that_the_profile_lacks_does_nothing(make_bench, make_stick):
    bench = make_bench(make_stick("a"), make_stick("b"))
    assert standings(bench) == {"a": "trainer, in control", "b": "not in the profile"}


def test_one_that_cannot_be_opened_is_there_with_what_to_do(make_bench, make_stick):
    stick = make_stick()
    permission = (
        "stick: no permission; put the rule into /etc/udev/rules.d/70-rotemina-inputs.rules"
    )

    def refuse(identity):
        raise DriverError(permission)

    stick.open = refuse
    bench = make_bench(stick)
    view, hub = bench.devices.view, bench.devices.hub
    [entry] = entries(view, hub)
    assert (entry.standing, entry.problem) == ("cannot be used", permission)
    told = troubles(view, hub)
    assert told[0].text == permission
    assert 'ATTRS{idVendor}=="046d", ATTRS{idProduct}=="c215"' in told[0].remedy
    assert headline(view, 1) == "No input device is connected. One problem, see below."


def test_a_source_that_fails_is_named(make_bench, make_stick):
    stick = make_stick()

    def broken():
        raise RuntimeError("a bug")

    stick.devices = broken
    bench = make_bench(stick)
    told = troubles(bench.devices.view, bench.devices.hub)
    assert told[0].text.startswith(f"{stick.key}: it cannot look for devices")


@pytest.mark.parametrize("key", ["keys:pad", "board:simulator", "hid:x"])
def test_no_rule_helps_what_is_no_joystick(key):
    assert udev_rule(key) is None


def test_nothing_is_told_of_nothing():
    view = DevicesView()
    assert headline(view, 0) == "No input device is connected."
    assert headline(replace(view, setting_up=True), 1) == "Set-up: no device controls the robot."


def test_what_was_plugged_in_comes_before_the_pad(make_bench, make_stick, clock):
    bench = make_bench(Pad("pad", clock=clock), make_stick())
    assert list(standings(bench)) == ["stick", "pad"]
    assert standings(bench)["pad"] == "trainee, watching"
