"""Texts about devices that control, wait, watch or cannot be used."""

from dataclasses import replace

from rotemina.app.motion.inputs import InputDisplayState, OperatorAction
from rotemina.drivers.contract import DriverError
from rotemina.drivers.inputs import InputPad
from rotemina.plugins.inputs.words import (
    ACTION_NAMES,
    ACTION_TIPS,
    describe_control,
    list_device_entries,
    list_problems,
    make_udev_rule,
)


def list_statuses(bench):
    bench.run(0.05)
    return {
        entry.name: entry.status
        for entry in list_device_entries(bench.devices.view, bench.devices.hub)
    }


def test_every_action_has_a_name_and_a_tip():
    assert set(ACTION_NAMES) == set(ACTION_TIPS) == set(OperatorAction)
    assert len(set(ACTION_NAMES.values())) == len(ACTION_NAMES)


def test_a_deflected_device_waits_before_it_controls(make_bench, make_stick):
    stick = make_stick()
    stick.deflect("Y", 0.5)
    bench = make_bench(stick)
    assert list_statuses(bench) == {"stick": "trainer, waiting for Y"}
    stick.deflect("Y", 0.0)
    bench.run()
    assert list_statuses(bench) == {"stick": "trainer, in control"}
    assert describe_control(bench.devices.view, 0) == "stick may control the robot."
    bench.devices.open_mapping()
    assert list_statuses(bench) == {"stick": "trainer, being set up"}
    assert describe_control(bench.devices.view, 0) == "Set-up: no device controls the robot."


def test_a_device_that_cannot_be_opened_is_listed_with_a_remedy(make_bench, make_stick):
    stick = make_stick()
    permission = (
        "stick: no permission; put the rule into /etc/udev/rules.d/70-rotemina-inputs.rules"
    )

    def refuse(identity):
        raise DriverError(permission)

    stick.open = refuse
    bench = make_bench(stick)
    view, hub = bench.devices.view, bench.devices.hub
    [entry] = list_device_entries(view, hub)
    assert (entry.status, entry.problem) == ("cannot be used", permission)
    problems = list_problems(view, hub)
    assert problems[0].text == permission
    assert 'ATTRS{idVendor}=="046d", ATTRS{idProduct}=="c215"' in problems[0].remedy
    assert describe_control(view, 1) == "No input device is connected. One problem, see below."


def test_a_source_that_fails_is_named(make_bench, make_stick):
    stick = make_stick()

    def fail():
        raise RuntimeError("a bug")

    stick.devices = fail
    bench = make_bench(stick)
    problems = list_problems(bench.devices.view, bench.devices.hub)
    assert problems[0].text.startswith(f"{stick.key}: it cannot search for devices")
    assert make_udev_rule("keys:pad") is None  # only joysticks need one


def test_without_devices_the_text_says_so():
    view = InputDisplayState()
    assert describe_control(view, 0) == "No input device is connected."
    assert (
        describe_control(replace(view, is_mapping_open=True), 1)
        == "Set-up: no device controls the robot."
    )


def test_plugged_in_devices_are_listed_before_the_pad(make_bench, make_stick, clock):
    bench = make_bench(InputPad("pad", clock=clock), make_stick("a"), make_stick("b"))
    statuses = list_statuses(bench)
    assert list(statuses) == ["a", "b", "pad"]
    assert statuses["a"] == "trainer, in control"
    assert statuses["b"] == "not in the profile"
    assert statuses["pad"] == "trainee, watching"
