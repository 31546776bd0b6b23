"""Messages as data: a template, which a catalogue translates, and the values of its fields.

Code that reports or refuses something makes a :class:`Message`. Code that shows it chooses a
:class:`MessageWording`. A message is also a string in English, so that errors, events and files
can use it without conversion.
"""

import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Self

from rotemina.sim.messages.number_text import (
    POINT,
    NumberText,
    format_rounded,
)


def marked(context: str, text: str) -> str:
    """Return ``text`` unchanged; the call marks it for the extraction of translatable texts.

    The text is translated where it is shown.
    """
    return text


# Longest word that is quoted in full, in characters. A file name may be this long.
MAX_WORD_LENGTH = 255
# Longest value that is quoted in full, in characters. Lists of names have a few hundred.
MAX_VALUE_LENGTH = 1000
# Lengths of the start and the end of a longer value that are shown, in characters.
_SHOWN_START_LENGTH, _SHOWN_END_LENGTH = 100, 30
_LONG_WORD = re.compile(rf"\S{{{MAX_WORD_LENGTH + 1},}}")

_SHORTENED_TEMPLATE = marked("engine", "{begin} … {end} ({count} characters)")


def _escape_control_characters(value: str) -> str:
    if value.isprintable():
        return value
    return "".join(
        character
        if character.isprintable() or unicodedata.category(character) == "Zs"
        else repr(character)[1:-1]
        for character in value
    )


class PlainText(str):
    """A sentence that is shown unchanged within a message, because it is not a message itself."""

    __slots__ = ()


class SystemText(str):
    """A text of the operating system or a library, in the language of its source."""

    __slots__ = ()


class AxisName(str):
    """The id of an axis; each wording shows its own name for it."""

    __slots__ = ()


class EffectName(str):
    """The id of an effect; each wording makes a name from the effect's English title."""

    __slots__ = ("english",)
    english: str

    def __new__(cls, effect_id: str, english: str = "") -> Self:
        """Return the name of an effect; without a title, its id is shown."""
        name = super().__new__(cls, effect_id)
        name.english = english
        return name

    def __reduce__(self) -> tuple[type["EffectName"], tuple[str, str]]:
        """Return the arguments that recreate the name, for copying and pickling."""
        return EffectName, (str(self), self.english)


@dataclass(frozen=True, slots=True)
class FieldList:
    """Several fields that a sentence lists, joined by "and", or by "or" if ``one_of_them``."""

    items: tuple["Field", ...]
    one_of_them: bool = False


class Message(str):
    """A sentence or a part of one; as a string it is English.

    Attributes
    ----------
    context : str
        Context in the translation catalogue: the folder that shows the message, or ``"engine"``.
    template : str
        English text with a name in braces for each field.
    fields : tuple of (str, Field)
        Name and value of each field.
    """

    __slots__ = ("context", "fields", "template")

    context: str
    template: str
    fields: tuple[tuple[str, "Field"], ...]

    def __new__(
        cls, context: str, template: str, fields: tuple[tuple[str, "Field"], ...] = ()
    ) -> Self:
        """Return a message; if it has no fields yet, its text is the template.

        Raises
        ------
        KeyError
            If the template contains a field that is not in ``fields``.
        """
        text = super().__new__(
            cls, MessageWording().fill_template(template, fields) if fields else template
        )
        text.context, text.template, text.fields = context, template, fields
        return text

    def __reduce__(self) -> tuple[type["Message"], tuple[object, ...]]:
        """Return the arguments that recreate the message, for copying and pickling."""
        return Message, (self.context, self.template, self.fields)

    def fill(self, **fields: "Field") -> "Message":
        """Return the message with values for its fields."""
        return Message(self.context, self.template, tuple(fields.items()))


Field = str | float | PurePath | FieldList


def message(context: str, template: str) -> Message:
    """Return a message without fields; the call marks the template for translation."""
    return Message(context, template)


class MessageWording:
    """Conversion of messages to text.

    This class writes English and names axes by their ids. Subclasses override the methods
    that their language needs.
    """

    @property
    def decimal_sign(self) -> str:
        """The decimal sign of numbers."""
        return POINT

    def localize_text(self, context: str, template: str) -> str:
        """Return a template in the language of this wording."""
        return template

    def name_axis(self, name: str) -> str:
        """Return the name of an axis."""
        return name

    def name_effect(self, effect: EffectName) -> str:
        """Return the name of an effect within a sentence, or its id if it has no title."""
        if not effect.english:
            return str(effect)
        localized_title = self.localize_text("effects", effect.english)
        return localized_title.lower() if localized_title == effect.english else localized_title

    def localize_word(self, text: str) -> str:
        """Return a text that is not a message; a subclass may translate it."""
        return text

    def quote_system_text(self, text: str) -> str:
        """Return a text of the system or a library; a subclass may put it in quotation marks."""
        return text

    def conjunction(self, *, one_of_them: bool) -> str:
        """Return the conjunction before the last item of a list."""
        return "or" if one_of_them else "and"

    def format_message(self, message: Message) -> str:
        """Return the text of a message.

        Raises
        ------
        KeyError
            If the template contains a field that the message lacks.
        """
        return self.fill_template(
            self.localize_text(message.context, message.template), message.fields
        )

    def fill_template(self, text: str, fields: Sequence[tuple[str, Field]]) -> str:
        """Return a template, which is already in this language, with the text of its fields."""
        if not fields:
            return text
        return text.format_map({name: self._format_nested_field(value) for name, value in fields})

    def _format_nested_field(self, value: Field) -> str:
        """Return the text of a field; plain strings come from outside, so they are quoted."""
        if type(value) is str or isinstance(value, PurePath):
            return self.quote(self.format_field(value))
        return self.format_field(value)

    def quote(self, value: str) -> str:
        """Return a value from a file, a command line or a device, made safe to show in a message.

        A very long value would hide the sentence, so only its two ends are shown. A control
        character could control the terminal, so it is written as a Python escape.
        """
        value = _LONG_WORD.sub(
            lambda word: self._shorten(word[0]), _escape_control_characters(value)
        )
        return self._shorten(value) if len(value) > MAX_VALUE_LENGTH else value

    def _shorten(self, value: str) -> str:
        return self.localize_text("engine", _SHORTENED_TEMPLATE).format(
            begin=value[:_SHOWN_START_LENGTH], end=value[-_SHOWN_END_LENGTH:], count=len(value)
        )

    def format_field(self, value: Field) -> str:
        """Return the text of a field, by the kind of its value."""
        match value:
            case Message():
                return self.format_message(value)
            case FieldList(items, one_of_them):
                word = self.conjunction(one_of_them=one_of_them)
                return join_names([self._format_nested_field(item) for item in items], word)
            case AxisName():
                return self.name_axis(value)
            case EffectName():
                return self.name_effect(value)
            case SystemText():
                return self.quote_system_text(self.quote(value))
            case NumberText():
                return value.with_sign(self.decimal_sign)
            case str():
                return self.localize_word(value)
            case float():
                return format_rounded(value, 6).with_sign(self.decimal_sign)
        return str(value)


def join_names(names: Sequence[str], word: str = "and") -> str:
    """Return names as a list in a sentence: ``a, b and c``."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} {word} {names[-1]}"


def join_messages(messages: Iterable[str], separator: str) -> Message:
    """Return several messages as one, with a separator between them."""
    fields = tuple(
        (f"part{index}", PlainText(text) if type(text) is str else text)
        for index, text in enumerate(messages)
    )
    return Message("", separator.join(f"{{{name}}}" for name, _ in fields), fields)


def join_lines(messages: Iterable[str]) -> Message:
    """Return several messages as one, each on its own line."""
    return join_messages(messages, "\n")
