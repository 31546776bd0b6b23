"""Effects of a simulated machine, switched through the session."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.state import CommandRefused
from rotemina.drivers.driver import Driver
from rotemina.sim.effects import attachment
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.robot.model import AxisEffect

WIDE = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 2e-4})


def test_an_effect_parts_the_reading_from_the_model(stepped):
    stepped.session.service.set_effects([WIDE])
    stepped.step()
    assert stepped.session.service.effects == (WIDE,)
    stepped.session.go_to({"thx": 9e-4})
    stepped.until_idle()
    stepped.session.go_to({"thx": 6e-4})
    stepped.until_idle()
    stepped.step(0.5)
    state = stepped.session.snapshot()
    assert abs(state.measured["thx"] - state.model["thx"]) > 2e-5
    stepped.session.service.set_effects([])
    stepped.step(0.01, times=100)
    state = stepped.session.snapshot()
    assert abs(state.measured["thx"] - state.model["thx"]) < 3e-6


def test_a_bad_effect_is_refused_at_once(stepped):
    with pytest.raises(EffectError, match="width = 1"):
        stepped.session.service.set_effects(
            [AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.0})]
        )
    assert stepped.session.service.effects == ()


def test_effects_need_a_connection(make_stepped):
    with pytest.raises(RefusedError, match="connect"):
        make_stepped(connect=False).session.service.set_effects([WIDE])


def test_effects_are_set_while_the_machine_moves_and_plays_on(stepped):
    stepped.session.go_to({"x": 0.03})
    stepped.step(0.05)
    stepped.session.service.set_effects([WIDE])
    state = stepped.until_idle()
    assert stepped.told(CommandRefused) == []
    np.testing.assert_allclose(state.measured["x"], 0.03, atol=1e-6)


def test_a_stop_that_comes_while_effects_are_put_in_place_halts_the_machine(stepped, monkeypatch):
    start = stepped.session.snapshot().measured["x"]
    stepped.session.go_to({"x": start + 5e-3})
    stepped.step(0.05)
    put = stepped.driver._set_effects

    def put_slowly(effects, permit):
        stepped.session.stop()
        put(effects, permit)

    monkeypatch.setattr(stepped.driver, "_set_effects", put_slowly)
    stepped.session.service.set_effects([WIDE])
    state = stepped.until_idle()
    assert stepped.session.service.effects == ()  # asked for before the stop
    assert 0.0 < state.measured["x"] - start < 4e-3


def test_an_effect_whose_code_fails_is_refused_and_the_machine_goes_on(stepped, monkeypatch):
    whole = attachment.effect_named("hysteresis")
    broken = replace(whole.formulations[0], prepare=lambda values, _facts: 1.0 / 0.0)
    monkeypatch.setattr(
        attachment, "effect_named", lambda _: replace(whole, formulations=(broken,))
    )
    stepped.session.service.set_effects([WIDE])
    stepped.step()
    (refused,) = stepped.told(CommandRefused)
    assert "axis.thx.effect hysteresis" in refused.message
    assert "ZeroDivisionError" in refused.message
    assert stepped.session.service.effects == ()
    assert stepped.session.snapshot().locked is None


def test_a_real_machine_has_effects_of_its_own(stepped, monkeypatch):
    hooks = {name: lambda *_: None for name in Driver.__abstractmethods__}
    board = type("Board", (Driver,), {"name": "board", **hooks})(stepped.session.robot)
    monkeypatch.setattr(stepped.session._link, "driver", board)
    assert stepped.session.service.effects is None
    with pytest.raises(RefusedError, match="simulator"):
        stepped.session.service.set_effects([WIDE])
