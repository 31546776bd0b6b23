"""Dialogs that ask for files, beside which the window, and its stop button, can still be used."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, QUrl
from PySide6.QtWidgets import QFileDialog, QWidget

from rotemina.app.shell.workbench import Workbench
from rotemina.resources import robots, trajectories

_FOLDER = "files.folder"  # the preference: where the last file was
EXAMPLES = Path(trajectories.__path__[0])
ROBOTS = Path(robots.__path__[0])


def ask_file(
    parent: QWidget, bench: Workbench, title: str, filters: str, use: Callable[[Path], object]
) -> None:
    """Ask for a file that is there, and hand it to ``use``."""
    dialog = _dialog(parent, bench, title, filters)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.fileSelected.connect(lambda name: use(_remembered(bench, name)))
    dialog.show()


def ask_files(
    parent: QWidget,
    bench: Workbench,
    title: str,
    filters: str,
    use: Callable[[list[Path]], object],
) -> None:
    """Ask for files that are there, and hand them to ``use``."""
    dialog = _dialog(parent, bench, title, filters)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFiles)
    dialog.filesSelected.connect(lambda names: use([_remembered(bench, each) for each in names]))
    dialog.show()


def ask_where(
    parent: QWidget,
    bench: Workbench,
    title: str,
    filters: str,
    name: str,
    use: Callable[[Path], object],
) -> None:
    """Ask where to save, ``name`` by default; the dialog asks before a file is replaced."""
    dialog = _dialog(parent, bench, title, filters)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix(Path(name).suffix[1:])
    dialog.selectFile(name)
    dialog.fileSelected.connect(lambda chosen: use(_remembered(bench, chosen)))
    dialog.show()


def _dialog(parent: QWidget, bench: Workbench, title: str, filters: str) -> QFileDialog:
    """Return a dialog where the last file was, or where the examples are."""
    folder = bench.settings.get(_FOLDER, "") or str(EXAMPLES)
    dialog = QFileDialog(parent, title, folder, filters)
    dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setSidebarUrls([QUrl.fromLocalFile(str(place)) for place in _places(bench)])
    return dialog


def _remembered(bench: Workbench, name: str) -> Path:
    """Return a chosen file; the next dialog begins where it is."""
    path = Path(name)
    bench.settings.set(_FOLDER, str(path.parent))
    return path


def _places(bench: Workbench) -> list[Path]:
    """Return the folders at a dialog's side: the user's own, and where the program's files are."""
    own = (bench.played_folder, bench.operation.recordings)
    return [Path.home(), *(place for place in own if place.is_dir()), EXAMPLES, ROBOTS]
