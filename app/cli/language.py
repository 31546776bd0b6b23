"""The language of the command line: by default that of the window.

Files, logs and JSON are English; names of axes are those of the files.
"""

import os
from importlib import resources

from rotemina.app.settings import LANGUAGE, Settings
from rotemina.sim.messages import Wording

ENGLISH = "en"
#: Languages beside English, with their decimal signs.
LANGUAGES = {"de": ","}
_VARIABLES = ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG")  # the first that is set counts (POSIX)


class CatalogueWording(Wording):
    """Messages in a language, from the same catalogue as the window's."""

    def __init__(self, language: str) -> None:
        # Qt is loaded for another language only: it takes as long as a short command.
        from PySide6.QtCore import QTranslator

        file = resources.files("rotemina.resources.languages").joinpath(f"{language}.qm")
        self._data = file.read_bytes()  # Qt reads from it as long as it translates
        self._texts = QTranslator()
        self._texts.load(self._data)
        self._sign = LANGUAGES[language]

    @property
    def decimal_sign(self) -> str:
        """The sign of the language."""
        return self._sign

    def text(self, context: str, template: str) -> str:
        """Return a template in this language, itself where it has no translation."""
        return self._texts.translate(context, template) or template

    def word(self, text: str) -> str:
        """Return a word of the engine; another text as it is."""
        return self.text("engine", text) if text else text

    def conjunction(self, *, one_of_them: bool) -> str:
        """Return the conjunction before the last item of a list."""
        return self.text("engine", super().conjunction(one_of_them=one_of_them))


def wording(asked: str | None = None) -> Wording:
    """Return the wording of the requested language, else of the window's."""
    language = asked or chosen()
    if language not in LANGUAGES:
        return Wording()
    try:
        return CatalogueWording(language)
    except ImportError:  # `rotemina doctor` reports what Qt lacks
        return Wording()


def chosen() -> str:
    """Return the language of the window: as set, else the system's."""
    names = (Settings().get(LANGUAGE, ""), *(os.environ.get(name, "") for name in _VARIABLES))
    return next((name for name in names if name), ENGLISH)[:2]
