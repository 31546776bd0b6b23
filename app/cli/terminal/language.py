"""The language of the command line; by default that of the window.

Files, logs and JSON are always English, and axes have the names that they have in files.
"""

import os
from importlib import resources

from rotemina.app.settings import LANGUAGE_KEY, UserSettings
from rotemina.sim.messages import MessageWording

ENGLISH = "en"
#: Languages other than English, with their decimal signs.
DECIMAL_SIGNS = {"de": ","}
# The first of these variables that is set determines the language (POSIX).
_LANGUAGE_VARIABLES = ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG")


class CatalogueWording(MessageWording):
    """Wording of messages in a language, from the catalogue of the window."""

    def __init__(self, language: str) -> None:
        # Loading Qt takes as long as a short command, so it is not loaded for English.
        from PySide6.QtCore import QTranslator

        file = resources.files("rotemina.resources.languages").joinpath(f"{language}.qm")
        # QTranslator does not copy the data, so they must live as long as the translator.
        self._catalogue = file.read_bytes()
        self._translator = QTranslator()
        self._translator.load(self._catalogue)
        self._decimal_sign = DECIMAL_SIGNS[language]

    @property
    def decimal_sign(self) -> str:
        """The decimal sign of the language."""
        return self._decimal_sign

    def localize_text(self, context: str, template: str) -> str:
        """Return the translation of a template, or the template itself if it has none."""
        return self._translator.translate(context, template) or template

    def localize_word(self, text: str) -> str:
        """Return the translation of a word of the engine, or the text itself if it has none."""
        return self.localize_text("engine", text) if text else text

    def conjunction(self, *, one_of_them: bool) -> str:
        """Return the conjunction before the last item of a list."""
        return self.localize_text("engine", super().conjunction(one_of_them=one_of_them))


def load_wording(language: str | None = None) -> MessageWording:
    """Return the wording of a language; by default that of the window."""
    language = language or find_window_language()
    if language not in DECIMAL_SIGNS:
        return MessageWording()
    try:
        return CatalogueWording(language)
    except ImportError:
        # Qt cannot be loaded; `rotemina doctor` reports which libraries are missing.
        return MessageWording()


def find_window_language() -> str:
    """Return the language of the window: the user's preference, otherwise the system's language."""
    names = (
        UserSettings().get(LANGUAGE_KEY, ""),
        *(os.environ.get(name, "") for name in _LANGUAGE_VARIABLES),
    )
    return next((name for name in names if name), ENGLISH)[:2]
