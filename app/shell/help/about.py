"""The About box: version, licence and folders of the program."""

import platform
from importlib.metadata import version

from PySide6.QtCore import Qt, qVersion
from PySide6.QtWidgets import QMessageBox, QWidget

from rotemina.app.language import translate
from rotemina.app.workbench import Workbench


def show_about(parent: QWidget, bench: Workbench) -> None:
    """Show the About box without blocking the window."""
    box = QMessageBox(parent)
    box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    box.setWindowModality(Qt.WindowModality.NonModal)
    box.setWindowTitle(translate("shell", "About RoTeMiNa"))
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setText(
        translate(
            "shell",
            "RoTeMiNa {version}\nOperator's window of a hybrid robot for cell "
            "manipulation, with diagnosis of the gap between model and machine.",
        ).format(version=version("rotemina"))
    )
    box.setInformativeText(
        translate(
            "shell",
            "Licence: MIT\nRobot: {robot}\nDriver: {driver}\nPython {python}, Qt {qt}\n"
            "Records: {records}\nPreferences: {settings}",
        ).format(
            robot=bench.robot.name,
            driver=bench.session.driver.name,
            python=platform.python_version(),
            qt=qVersion(),
            records=bench.played_folder.parent,
            settings=bench.settings.folder,
        )
    )
    box.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    box.show()
