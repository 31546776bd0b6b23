"""Dialogs that ask for files while the window and its stop button stay usable."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, QUrl
from PySide6.QtWidgets import QFileDialog, QWidget

from rotemina.app.workbench import Workbench
from rotemina.resources import robots, trajectories

# Preference: the folder of the last chosen file.
_FOLDER_KEY = "files.folder"
EXAMPLES_FOLDER = Path(trajectories.__path__[0])
ROBOTS_FOLDER = Path(robots.__path__[0])


def ask_file(
    parent: QWidget, bench: Workbench, title: str, filters: str, use: Callable[[Path], object]
) -> None:
    """Ask for an existing file and pass it to ``use``."""
    dialog = _make_dialog(parent, bench, title, filters)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.fileSelected.connect(lambda name: use(_remember_folder(bench, name)))
    dialog.show()


def ask_files(
    parent: QWidget,
    bench: Workbench,
    title: str,
    filters: str,
    use: Callable[[list[Path]], object],
) -> None:
    """Ask for existing files and pass them to ``use``."""
    dialog = _make_dialog(parent, bench, title, filters)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFiles)
    dialog.filesSelected.connect(
        lambda names: use([_remember_folder(bench, name) for name in names])
    )
    dialog.show()


def ask_save_path(
    parent: QWidget,
    bench: Workbench,
    title: str,
    filters: str,
    name: str,
    use: Callable[[Path], object],
) -> None:
    """Ask where to save; the suggestion is ``name``. The dialog asks before it replaces a file."""
    dialog = _make_dialog(parent, bench, title, filters)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix(Path(name).suffix[1:])
    dialog.selectFile(name)
    dialog.fileSelected.connect(lambda path_text: use(_remember_folder(bench, path_text)))
    dialog.show()


def _make_dialog(parent: QWidget, bench: Workbench, title: str, filters: str) -> QFileDialog:
    folder = bench.settings.get(_FOLDER_KEY, "") or str(EXAMPLES_FOLDER)
    dialog = QFileDialog(parent, title, folder, filters)
    dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setSidebarUrls(
        [QUrl.fromLocalFile(str(folder_path)) for folder_path in _find_sidebar_folders(bench)]
    )
    return dialog


def _remember_folder(bench: Workbench, name: str) -> Path:
    """Return the path of a chosen file; the next dialog opens in its folder."""
    path = Path(name)
    bench.settings.set(_FOLDER_KEY, str(path.parent))
    return path


def _find_sidebar_folders(bench: Workbench) -> list[Path]:
    user_folders = (bench.played_folder, bench.operation.recordings)
    return [
        Path.home(),
        *(folder for folder in user_folders if folder.is_dir()),
        EXAMPLES_FOLDER,
        ROBOTS_FOLDER,
    ]
