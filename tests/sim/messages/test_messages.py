"""Messages as data, which are translated where they are shown."""

from pathlib import Path

import pytest

from rotemina.sim.messages import (
    AxisName,
    EffectName,
    FieldList,
    MessageWording,
    join_lines,
    message,
)
from rotemina.sim.messages.messages import MAX_VALUE_LENGTH, MAX_WORD_LENGTH


def test_a_message_is_formatted_by_the_wording_of_its_display():
    class UpperCaseWording(MessageWording):
        def localize_text(self, context, template):
            return f"[{context}] {template.upper().replace('{WHO}', '{who}')}"

        def name_axis(self, name):
            return f"axis {name}"

        def conjunction(self, *, one_of_them):
            return "oder" if one_of_them else "und"

    who = FieldList((AxisName("x"), EffectName("creep"), "nobody", message("a", "me")), True)
    text = message("b", "it was {who}").fill(who=who)
    assert UpperCaseWording().format_message(text) == "[b] IT WAS axis x, creep, nobody oder [a] ME"
    assert str(text) == "it was x, creep, nobody or me"
    assert str(message("b", "{e}").fill(e=EffectName("of_a_plugin"))) == "of_a_plugin"


def test_a_long_value_is_cut_but_not_the_message():
    sentence = message("a", "at {where}, " + "long " * 300 + "{value} is wrong")
    text = str(sentence.fill(where="line 1", value=repr("b" * 100_000)))
    end = f"'{'b' * 99} … {'b' * 29}' (100002 characters) is wrong"
    assert text == "at line 1, " + "long " * 300 + end
    nested = message("a", "{why}; correct it").fill(why=sentence.fill(where="x", value="y"))
    assert str(nested) == "at x, " + "long " * 300 + "y is wrong; correct it"


def test_the_length_of_a_cut_value_is_translated():
    class GermanWording(MessageWording):
        def localize_text(self, context, template):
            return template.replace("characters", "Zeichen")

    text = message("a", "{value}").fill(value="d" * 300)
    assert GermanWording().format_message(text).endswith("(300 Zeichen)")


def test_a_value_is_not_cut_up_to_its_maximum_length():
    names = ", ".join(f"name_{number}" for number in range(100))
    assert len(names) < MAX_VALUE_LENGTH
    for value in ("c" * MAX_WORD_LENGTH, names):
        assert str(message("a", "{value}").fill(value=value)) == value
    for value in ("c" * (MAX_WORD_LENGTH + 1), f"see {'c' * 5000}.", "c " * MAX_VALUE_LENGTH):
        text = str(message("a", "{value}").fill(value=value))
        assert " characters)" in text
        assert len(text) < 180


@pytest.mark.parametrize("value", ["a\nb", "a\rb", "\x1b[31m", "\x9b", "\u202e", "\ud800", "\0"])
def test_control_characters_of_a_value_are_escaped(value):
    quote = message("a", "{value}")
    for field in (value, Path(value), FieldList((value, "b")), quote.fill(value=value)):
        text = str(quote.fill(value=field))
        assert text.isprintable()
        assert "\\" in text
    assert str(quote.fill(value="10\u202fµm")) == "10\u202fµm"


def test_joined_lines_are_not_cut():
    sentences = ["one " * 500, "two"]
    assert str(join_lines(sentences)) == "\n".join(sentences)
