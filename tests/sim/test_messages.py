"""Messages as data: whoever shows one says it in a language."""

from pathlib import Path

import pytest

from rotemina.sim.messages import (
    LONGEST_VALUE,
    LONGEST_WORD,
    AxisName,
    EffectName,
    Listed,
    Wording,
    lines,
    message,
)


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


def test_a_quoted_value_is_cut_and_the_message_is_not():
    sentence = message("a", "at {where}, " + "long " * 300 + "{value} is wrong")
    text = str(sentence.fill(where="line 1", value=repr("b" * 100_000)))
    end = f"'{'b' * 99} … {'b' * 29}' (100002 characters) is wrong"
    assert text == "at line 1, " + "long " * 300 + end
    nested = message("a", "{why}; correct it").fill(why=sentence.fill(where="x", value="y"))
    assert str(nested) == "at x, " + "long " * 300 + "y is wrong; correct it"


def test_a_quoted_value_is_whole_up_to_its_bound():
    names = ", ".join(f"name_{number}" for number in range(100))
    assert len(names) < LONGEST_VALUE
    for value in ("c" * LONGEST_WORD, names):
        assert str(message("a", "{value}").fill(value=value)) == value
    for value in ("c" * (LONGEST_WORD + 1), f"see {'c' * 5000}.", "c " * LONGEST_VALUE):
        text = str(message("a", "{value}").fill(value=value))
        assert " characters)" in text
        assert len(text) < 180


@pytest.mark.parametrize("value", ["a\nb", "a\rb", "\x1b[31m", "\x9b", "\u202e", "\ud800", "\0"])
def test_no_control_character_of_a_value_reaches_the_terminal(value):
    quote = message("a", "{value}")
    for field in (value, Path(value), Listed((value, "b")), quote.fill(value=value)):
        text = str(quote.fill(value=field))
        assert text.isprintable()
        assert "\\" in text
    assert str(quote.fill(value="10\u202fµm")) == "10\u202fµm"


def test_sentences_in_lines_are_not_values():
    sentences = ["one " * 500, "two"]
    assert str(lines(sentences)) == "\n".join(sentences)


def test_a_cut_value_is_worded_in_a_language():
    class Other(Wording):
        def text(self, context, template):
            return template.replace("characters", "Zeichen")

    long = message("a", "{value}").fill(value="d" * 300)
    assert Other().of(long).endswith("(300 Zeichen)")
