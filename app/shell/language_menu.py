"""The language of the window in its menu; another one is spoken from the next start on."""

from collections.abc import Iterator

from PySide6.QtCore import QCoreApplication
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QMenu, QWidget

from rotemina.app.shell import language
from rotemina.app.shell.language import LANGUAGES, SETTING, SYSTEM, translate
from rotemina.app.shell.palette_entries import Entry
from rotemina.app.shell.workbench import Level, Workbench

# What is told in each language, for whoever reads only one of them.
_FROM_NEXT_START = {
    "en": "The window speaks {name} from the next start on.",
    "de": "Das Fenster spricht ab dem nächsten Start {name}.",
}


def choose(workbench: Workbench, asked: str) -> None:
    """Keep a language for the next start, and tell so in the one in use and in that one."""
    settings = workbench.settings
    settings.set(SETTING, asked)
    spoken, next_one = language.in_use(QCoreApplication.instance()), language.chosen(settings)
    if next_one != spoken:
        told = (
            _FROM_NEXT_START[name].format(name=LANGUAGES[next_one]) for name in (spoken, next_one)
        )
        workbench.notify(Level.INFO, " ".join(told), about="window.md#language")


def offered() -> Iterator[tuple[str, str]]:
    """Yield each setting with its name: the system's, then languages as they call themselves."""
    yield SYSTEM, translate("shell", "System language")
    yield from LANGUAGES.items()


def language_entries(workbench: Workbench) -> Iterator[Entry]:
    """Yield an entry of the command palette for each."""
    where = translate("shell", "Language")
    for asked, name in offered():
        yield Entry(where, name, "", None, lambda asked=asked: choose(workbench, asked))


class LanguageMenu(QMenu):
    """A menu of languages, of which one is checked."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(translate("shell", "La&nguage"), parent)
        self._settings = workbench.settings
        group = QActionGroup(self)
        for asked, name in offered():
            action = group.addAction(name)
            action.setData(asked)
            action.setCheckable(True)
            action.triggered.connect(lambda _=False, asked=asked: choose(workbench, asked))
        self.addActions(group.actions())
        self.aboutToShow.connect(self.mark)
        self.mark()

    def mark(self) -> None:
        """Check the one that is set."""
        asked = self._settings.get(SETTING, SYSTEM)
        for action in self.actions():
            action.setChecked(action.data() == (asked if asked in LANGUAGES else SYSTEM))
