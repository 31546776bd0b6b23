"""Messages as data: whoever shows one says it in a language."""

from rotemina.sim.messages import AxisName, EffectName, Listed, Wording, message


def test_a_message_is_rendered_by_whoever_shows_it():
    class Loud(Wording):
        def text(self, context, template):
            return f"[{context}] {template.upper().replace('{WHO}', '{who}')}"

        def axis(self, name):
            return f"axis {name}"

        def conjunction(self, *, one_of_them):
            return "oder" if one_of_them else "und"

    who = Listed((AxisName("x"), EffectName("creep"), "nobody", message("a", "me")), True)
    said = message("b", "it was {who}").fill(who=who)
    assert Loud().of(said) == "[b] IT WAS axis x, creep, nobody oder [a] ME"
    assert str(said) == "it was x, creep, nobody or me"
    assert str(message("b", "{e}").fill(e=EffectName("of_a_plugin"))) == "of_a_plugin"
