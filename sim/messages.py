"""Sentences as data: a template, which a catalogue translates, and what stands in its fields.

Whoever finds something out, or refuses something, makes a :class:`Message`; whoever shows it
chooses a :class:`Wording`. A message is a text as well, in English: an error, an event or a file
takes it as it is.
"""

import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Self

from rotemina.sim.quantities import POINT, Number, rounded


def marked(context: str, text: str) -> str:
    """Return ``text`` as it is: it is found for translation here, and translated where shown."""
    return text


LONGEST_WORD = 255  # characters of a quoted value without blanks: a file's name may have as many
LONGEST_VALUE = 1000  # characters of a quoted value; lists of names have some hundreds
_BEGIN, _END = 100, 30  # characters that are left of a longer one
_LONG_WORD = re.compile(rf"\S{{{LONGEST_WORD + 1},}}")


_CUT = marked("engine", "{begin} … {end} ({count} characters)")


def _without_controls(value: str) -> str:
    if value.isprintable():
        return value
    return "".join(
        sign if sign.isprintable() or unicodedata.category(sign) == "Zs" else repr(sign)[1:-1]
        for sign in value
    )


class PlainText(str):
    """A sentence that is no message, and is shown as it is within another one."""

    __slots__ = ()


class SystemText(str):
    """What the operating system or a library says, in a language of its own."""

    __slots__ = ()


class AxisName(str):
    """An axis by its id; each wording has a name for it."""

    __slots__ = ()


class EffectName(str):
    """An effect by its id; each wording has a name for it, made from its title in English."""

    __slots__ = ("english",)
    english: str

    def __new__(cls, effect_id: str, english: str = "") -> Self:
        """Return it; without a title it is called by its id."""
        made = super().__new__(cls, effect_id)
        made.english = english
        return made

    def __reduce__(self) -> tuple[type["EffectName"], tuple[str, str]]:
        """Return what it is made of, for a copy or another process."""
        return EffectName, (str(self), self.english)


@dataclass(frozen=True, slots=True)
class Listed:
    """Several things as a sentence lists them: all of them, or one of them that holds."""

    items: tuple["Field", ...]
    one_of_them: bool = False


class Message(str):
    """A sentence or a part of one; as a text it is English.

    Attributes
    ----------
    context : str
        The catalogue's: the folder that shows it, or ``"engine"``.
    template : str
        English, with a name in braces for each field.
    fields : tuple of (str, Field)
        What stands there, by name.
    """

    __slots__ = ("context", "fields", "template")

    context: str
    template: str
    fields: tuple[tuple[str, "Field"], ...]

    def __new__(
        cls, context: str, template: str, fields: tuple[tuple[str, "Field"], ...] = ()
    ) -> Self:
        """Make it; one whose fields are still to be filled reads as its template.

        Raises
        ------
        KeyError
            If the template asks for a field that is not among those given.
        """
        made = super().__new__(cls, Wording().filled(template, fields) if fields else template)
        made.context, made.template, made.fields = context, template, fields
        return made

    def __reduce__(self) -> tuple[type["Message"], tuple[object, ...]]:
        """Return what it is made of, for a copy or another process."""
        return Message, (self.context, self.template, self.fields)

    def fill(self, **fields: "Field") -> "Message":
        """Return it with something in each of its fields."""
        return Message(self.context, self.template, tuple(fields.items()))


Field = str | float | PurePath | Listed


def message(context: str, template: str) -> Message:
    """Return a message without fields; its template is found for translation here."""
    return Message(context, template)


class Wording:
    """How messages read: here in English, with the ids of axes. Others override what differs."""

    @property
    def decimal_sign(self) -> str:
        """The sign with which numbers are written."""
        return POINT

    def text(self, context: str, template: str) -> str:
        """Return a template in this language."""
        return template

    def axis(self, name: str) -> str:
        """Return what an axis is called."""
        return name

    def effect(self, effect: EffectName) -> str:
        """Return an effect's name within a sentence; its id if it has no title."""
        if not effect.english:
            return str(effect)
        shown = self.text("effects", effect.english)
        return shown.lower() if shown == effect.english else shown

    def word(self, text: str) -> str:
        """Return a text that is no message; a language may know it as a word."""
        return text

    def foreign(self, text: str) -> str:
        """Return what the system or a library says; a language may quote it."""
        return text

    def conjunction(self, *, one_of_them: bool) -> str:
        """Return the conjunction before the last item of a list."""
        return "or" if one_of_them else "and"

    def of(self, message: Message) -> str:
        """Return a message as it is shown.

        Raises
        ------
        KeyError
            If the template asks for a field that the message lacks.
        """
        return self.filled(self.text(message.context, message.template), message.fields)

    def filled(self, text: str, fields: Sequence[tuple[str, Field]]) -> str:
        """Return a template, in this language, with its fields as they are shown."""
        return text.format_map({name: self._of_field(value) for name, value in fields})

    def _of_field(self, value: Field) -> str:
        """Return the text of a field; a value from outside as :meth:`quoted`."""
        if type(value) is str or isinstance(value, PurePath):
            return self.quoted(self.shown(value))
        return self.shown(value)

    def quoted(self, value: str) -> str:
        """Return a value of a file, a command line or a device as a message may quote it.

        A value of any length would bury the sentence, so of a long one both ends are shown.
        A control character would command the terminal, so it is written as Python does.
        """
        value = _LONG_WORD.sub(lambda word: self._cut(word[0]), _without_controls(value))
        return self._cut(value) if len(value) > LONGEST_VALUE else value

    def _cut(self, value: str) -> str:
        return self.text("engine", _CUT).format(
            begin=value[:_BEGIN], end=value[-_END:], count=len(value)
        )

    def shown(self, value: Field) -> str:
        """Return the text of a field."""
        match value:
            case Message():
                return self.of(value)
            case Listed(items, one_of_them):
                word = self.conjunction(one_of_them=one_of_them)
                return listed([self._of_field(item) for item in items], word)
            case AxisName():
                return self.axis(value)
            case EffectName():
                return self.effect(value)
            case SystemText():
                return self.foreign(self.quoted(value))
            case Number():
                return value.with_sign(self.decimal_sign)
            case str():
                return self.word(value)
            case float():
                return rounded(value, 6).with_sign(self.decimal_sign)
        return str(value)


def listed(names: Sequence[str], word: str = "and") -> str:
    """Return names as a sentence lists them."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {word} {names[-1]}"


def joined(messages: Iterable[str], between: str) -> Message:
    """Return messages as one, with a sign between them."""
    fields = tuple(
        (f"part{number}", PlainText(part) if type(part) is str else part)
        for number, part in enumerate(messages)
    )
    return Message("", between.join(f"{{{name}}}" for name, _ in fields), fields)


def lines(messages: Iterable[str]) -> Message:
    """Return messages below each other, as one."""
    return joined(messages, "\n")
