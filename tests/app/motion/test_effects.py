"""Effects of a simulated machine, set through the session."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.state import CommandRefused
from rotemina.drivers.contract import Driver
from rotemina.sim.effects import attachment
from rotemina.sim.errors import EffectError
from rotemina.sim.robot import AxisEffect

WIDE_HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 2e-4})


def test_an_effect_separates_reading_and_model(harness):
    harness.session.service.set_effects([WIDE_HYSTERESIS])
    harness.step()
    assert harness.session.service.effects == (WIDE_HYSTERESIS,)
    harness.session.go_to({"thx": 9e-4})
    harness.step_until_idle()
    harness.session.go_to({"thx": 6e-4})
    harness.step_until_idle()
    harness.step(0.5)
    state = harness.session.snapshot()
    assert abs(state.measured["thx"] - state.model["thx"]) > 2e-5
    harness.session.service.set_effects([])
    harness.step(0.01, times=100)
    state = harness.session.snapshot()
    assert abs(state.measured["thx"] - state.model["thx"]) < 3e-6


def test_a_bad_effect_is_refused_at_once(harness):
    with pytest.raises(EffectError, match="width = 1"):
        harness.session.service.set_effects(
            [AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.0})]
        )
    assert harness.session.service.effects == ()


def test_effects_need_a_connection(make_harness):
    with pytest.raises(RequestRefusedError, match="connect"):
        make_harness(connect=False).session.service.set_effects([WIDE_HYSTERESIS])


def test_effects_can_be_set_during_a_move_which_continues(harness):
    harness.session.go_to({"x": 0.03})
    harness.step(0.05)
    harness.session.service.set_effects([WIDE_HYSTERESIS])
    state = harness.step_until_idle()
    assert harness.list_events(CommandRefused) == []
    np.testing.assert_allclose(state.measured["x"], 0.03, atol=1e-6)


def test_a_stop_while_effects_are_being_set_halts_the_machine(harness, monkeypatch):
    start = harness.session.snapshot().measured["x"]
    harness.session.go_to({"x": start + 5e-3})
    harness.step(0.05)
    set_effects = harness.driver._set_effects

    def set_effects_after_stop(effects, permit):
        harness.session.stop()
        set_effects(effects, permit)

    monkeypatch.setattr(harness.driver, "_set_effects", set_effects_after_stop)
    harness.session.service.set_effects([WIDE_HYSTERESIS])
    state = harness.step_until_idle()
    assert harness.session.service.effects == ()  # requested before the stop
    assert 0.0 < state.measured["x"] - start < 4e-3


def test_an_effect_whose_code_fails_is_refused_and_the_machine_continues(harness, monkeypatch):
    hysteresis = attachment.load_effect("hysteresis")
    broken = replace(hysteresis.formulations[0], prepare=lambda values, _facts: 1.0 / 0.0)
    monkeypatch.setattr(
        attachment, "load_effect", lambda _: replace(hysteresis, formulations=(broken,))
    )
    harness.session.service.set_effects([WIDE_HYSTERESIS])
    harness.step()
    (refusal,) = harness.list_events(CommandRefused)
    assert "axis.thx.effect hysteresis" in refusal.message
    assert "ZeroDivisionError" in refusal.message
    assert harness.session.service.effects == ()
    assert harness.session.snapshot().lock_reason is None


def test_effects_of_a_real_machine_cannot_be_set(harness, monkeypatch):
    hooks = {name: lambda *_: None for name in Driver.__abstractmethods__}
    board = type("Board", (Driver,), {"name": "board", **hooks})(harness.session.robot)
    monkeypatch.setattr(harness.session._link, "driver", board)
    assert harness.session.service.effects is None
    with pytest.raises(RequestRefusedError, match="simulator"):
        harness.session.service.set_effects([WIDE_HYSTERESIS])
