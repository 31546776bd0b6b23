"""Every interleaving of requests, stops and connections in the model.

For two other actors, and for the session, see test_gate_traces.
"""

import pytest
from tests.app.motion.gate_model import FLAWS, Model

OTHERS = ("stop", "emergency", "release", "disconnect", "reconnect", "use", "lose", "wait")


@pytest.mark.parametrize("request_name", ["move", "speed", "clear"])
@pytest.mark.parametrize("other", OTHERS)
def test_no_violation_with_one_other_actor(request_name, other):
    walk = Model(request_name, other).walk()
    assert walk.states > 10
    assert not walk.faults


@pytest.mark.parametrize("flaw", FLAWS)
def test_the_walk_finds_each_flaw(flaw):
    assert Model(*FLAWS[flaw], flaw=flaw).walk().faults
