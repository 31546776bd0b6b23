"""The files that were loaded last, in a menu."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QMenu, QWidget

from rotemina.app.settings import Settings
from rotemina.app.shell.language import translate

_KEY = "files.recent"  # lines of a kind, a tab and a path, the newest first
MOST = 9  # so that each has a digit


class RecentFiles(QMenu):
    """Files by kind, the newest first; a click uses one again.

    Parameters
    ----------
    settings : Settings
        Where they are kept.
    use : mapping of str to (str, callable)
        For each kind what the menu calls it, and what takes such a file.
    """

    def __init__(
        self,
        settings: Settings,
        use: dict[str, tuple[str, Callable[[Path], object]]],
        parent: QWidget,
    ) -> None:
        super().__init__(translate("shell", "Recent &files"), parent)
        self._settings, self._use = settings, use
        self.aboutToShow.connect(self.fill)
        self.fill()

    @property
    def listed(self) -> list[tuple[str, Path]]:
        """Kind and path of each; lines that are none are passed over."""
        lines = (line.partition("\t") for line in self._settings.get(_KEY, "").splitlines())
        return [(kind, Path(path)) for kind, _, path in lines if kind in self._use and path]

    def add(self, kind: str, path: Path) -> None:
        """Put a file in front of the others."""
        entry = kind, path.absolute()
        if not str(entry[1]).isprintable():
            return  # a line break in a name would make two of it
        kept = [entry, *(each for each in self.listed if each != entry)][:MOST]
        self._settings.set(_KEY, "\n".join(f"{each}\t{where}" for each, where in kept))

    def fill(self) -> None:
        """Offer those that are kept and still there."""
        self.clear()
        there = [(kind, path) for kind, path in self.listed if path.is_file()]
        for number, (kind, path) in enumerate(there, start=1):
            called, use = self._use[kind]
            name = path.name.replace("&", "&&")
            action = self.addAction(f"&{number}  {called}: {name}")
            action.setToolTip(str(path))
            action.triggered.connect(lambda _=False, path=path, use=use: use(path))
        self.setToolTipsVisible(True)
        if not there:
            self.addAction(translate("shell", "None")).setEnabled(False)
