"""The menu for the window's language; a change takes effect at the next start."""

from collections.abc import Iterator

from PySide6.QtCore import QCoreApplication
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QMenu, QWidget

from rotemina.app.language import (
    LANGUAGE_KEY,
    LANGUAGES,
    SYSTEM_LANGUAGE,
    language,
    translate,
)
from rotemina.app.shell.window.palette_entries import PaletteEntry
from rotemina.app.workbench import Level, Workbench

# Both languages, because the user may understand only one of them.
_NEXT_START_TEXTS = {
    "en": "The window will use {name} from the next start.",
    "de": "Das Fenster erscheint ab dem nächsten Start auf {name}.",
}


def set_language(workbench: Workbench, setting: str) -> None:
    """Save the language for the next start, and report that in the current and the new language."""
    settings = workbench.settings
    settings.set(LANGUAGE_KEY, setting)
    current_language, next_language = (
        language.get_language(QCoreApplication.instance()),
        language.determine_language(settings),
    )
    if next_language != current_language:
        sentences = (
            _NEXT_START_TEXTS[name].format(name=LANGUAGES[next_language])
            for name in (current_language, next_language)
        )
        workbench.notify(Level.INFO, " ".join(sentences), about="window.md#language")


def list_languages() -> Iterator[tuple[str, str]]:
    """Yield each setting with its name: the system's language first.

    The name of each language is in that language.
    """
    yield SYSTEM_LANGUAGE, translate("shell", "System language")
    yield from LANGUAGES.items()


def make_language_entries(workbench: Workbench) -> Iterator[PaletteEntry]:
    """Yield an entry of the command palette for each language."""
    group = translate("shell", "Language")
    for setting, name in list_languages():
        yield PaletteEntry(
            group, name, "", None, lambda setting=setting: set_language(workbench, setting)
        )


class LanguageMenu(QMenu):
    """Menu of languages, with a tick at the selected one."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(translate("shell", "La&nguage"), parent)
        self._settings = workbench.settings
        group = QActionGroup(self)
        for setting, name in list_languages():
            action = group.addAction(name)
            action.setData(setting)
            action.setCheckable(True)
            action.triggered.connect(
                lambda _=False, setting=setting: set_language(workbench, setting)
            )
        self.addActions(group.actions())
        self.aboutToShow.connect(self.check_current)
        self.check_current()

    def check_current(self) -> None:
        """Tick the language that is set."""
        setting = self._settings.get(LANGUAGE_KEY, SYSTEM_LANGUAGE)
        for action in self.actions():
            action.setChecked(
                action.data() == (setting if setting in LANGUAGES else SYSTEM_LANGUAGE)
            )
