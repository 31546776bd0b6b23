"""Fixture: an effect that is not installed."""

import pytest

from rotemina.sim.effects import EVERY_KIND, Effect, EffectStage, Formulation, attachment


@pytest.fixture
def install_effect(monkeypatch):
    """Return a function that makes an effect of one formulation the only one, for any id."""

    def install(acts, *parameters, stage=EffectStage.MECHANICS, kinds=EVERY_KIND, **fields):
        formulation = Formulation(
            name="push",
            equation="y = f(x)",
            source="test",
            parameters=parameters,
            acts=acts,
            **fields,
        )
        effect = Effect(
            id="push",
            title="Push",
            summary="Pushes.",
            stage=stage,
            kinds=frozenset(kinds),
            formulations=(formulation,),
        )
        monkeypatch.setattr(attachment, "load_effect", lambda _id: effect)

    return install
