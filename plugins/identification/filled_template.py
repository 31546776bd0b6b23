"""Texts in English for files, and in the window's language for display."""

from typing import Self

from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.identification import tr
from rotemina.sim.messages import Message


class FilledTemplate(str):
    """A marked template, filled: itself is the English text; :func:`localized` tells the other."""

    __slots__ = ("template", "values")
    template: str
    values: dict[str, object]

    def __new__(cls, template: str, **values: object) -> Self:
        """Fill a template's named fields."""
        made = super().__new__(cls, template.format(**values))
        made.template, made.values = template, values
        return made


def localized(text: str) -> str:
    """Return a text, a marked or a filled one or anyone's, in the language of the window."""
    if isinstance(text, FilledTemplate):
        filled = {
            name: localized(value) if isinstance(value, str) else value
            for name, value in text.values.items()
        }
        return tr(text.template).format(**filled)
    if isinstance(text, Message):
        return spoken(text)
    return tr(text) if text else text
