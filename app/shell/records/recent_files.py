"""A menu of the files that were loaded most recently."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QMenu, QWidget

from rotemina.app.language import translate
from rotemina.app.settings import UserSettings

# Preference: one line per file with kind, tab and path, newest first.
_FILES_KEY = "files.recent"
# Each file gets a digit as its key.
MAX_FILES = 9


class RecentFilesMenu(QMenu):
    """Menu of recent files, newest first; a click opens one again.

    Parameters
    ----------
    settings : UserSettings
        Where the list is saved.
    use : mapping of str to (str, callable)
        For each kind, its name in the menu and the function that opens such a file.
    """

    def __init__(
        self,
        settings: UserSettings,
        use: dict[str, tuple[str, Callable[[Path], object]]],
        parent: QWidget,
    ) -> None:
        super().__init__(translate("shell", "Recent &files"), parent)
        self._settings, self._use = settings, use
        self.aboutToShow.connect(self.fill)
        self.fill()

    @property
    def entries(self) -> list[tuple[str, Path]]:
        """Kind and path of each file; damaged lines are ignored."""
        lines = (line.partition("\t") for line in self._settings.get(_FILES_KEY, "").splitlines())
        return [(kind, Path(path)) for kind, _, path in lines if kind in self._use and path]

    def add(self, kind: str, path: Path) -> None:
        """Put a file at the top of the list."""
        entry = kind, path.absolute()
        if not str(entry[1]).isprintable():
            # A line break in the name would split the entry.
            return
        entries = [entry, *(other for other in self.entries if other != entry)][:MAX_FILES]
        self._settings.set(
            _FILES_KEY, "\n".join(f"{file_kind}\t{file_path}" for file_kind, file_path in entries)
        )

    def fill(self) -> None:
        """List the files that still exist."""
        self.clear()
        existing = [(kind, path) for kind, path in self.entries if path.is_file()]
        for number, (kind, path) in enumerate(existing, start=1):
            kind_name, use = self._use[kind]
            name = path.name.replace("&", "&&")
            action = self.addAction(f"&{number}  {kind_name}: {name}")
            action.setToolTip(str(path))
            action.triggered.connect(lambda _=False, path=path, use=use: use(path))
        self.setToolTipsVisible(True)
        if not existing:
            self.addAction(translate("shell", "None")).setEnabled(False)
