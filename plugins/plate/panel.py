"""The holding plate: solved on demand, shown in 3-D over its range and in its modes."""

import time
from math import tau
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QTimer
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QComboBox, QPushButton, QWidget

from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.file_dialog import ask_where
from rotemina.app.shell.language import marked
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, set_property
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import keeping_width, scrolled
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.background_solution import Solving
from rotemina.plugins.plate.canvas import Canvas
from rotemina.plugins.plate.controls import Controls
from rotemina.plugins.plate.solution import Solved
from rotemina.plugins.plate.surface_picture import mode_picture, static_picture
from rotemina.plugins.plate.words import EMPTY, MESHES, mode_titles, plate_text, pose_lines, yields
from rotemina.sim.plate.export import write_vtu
from rotemina.sim.quantities import fixed
from rotemina.sim.whole_files import replaced

FRAME_MS = 33
_WIDTH = 330  # of the choices at least, px
SWING_S = 2.0  # a mode is shown slowly, whatever its frequency
_UNSOLVED = mark("no plate is solved yet")


class PlatePanel(Panel):
    """Choices on the left, the plate on the right, its figures below."""

    title = marked("panels", "Holding plate")
    area = Area.BOTTOM
    order = 90
    help_page = "plate.md#the-panel"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.solved: Solved | None = None
        self.solving = Solving(self)
        self.canvas, self.controls = Canvas(workbench.theme), Controls()
        self._frames = QTimer(self, interval=FRAME_MS)
        self._make_parts()
        self._lay_out()
        self._connect()
        offer_in_palette(self.start, self.stop, self.vtu, self.png, safe_while_hidden=True)
        self._show_state()

    # --- parts ------------------------------------------------------------------------------------

    def _make_parts(self) -> None:
        self.mesh = QComboBox()
        self.mesh.setAccessibleName(tr("Mesh"))
        for title, divisions in MESHES:
            self.mesh.addItem(tr(title), divisions)
        self.mesh.setCurrentIndex(1)
        self.start, self.stop = QPushButton(tr("Solve")), QPushButton(tr("Stop"))
        self.start.setProperty("primary", True)
        self.vtu, self.png = QPushButton(tr("Save VTU …")), QPushButton(tr("Save PNG …"))
        self.doing = plain_text(wrap=True)
        self.pose_text, self.plate_text = (plain_text(quiet=False, wrap=True) for _ in range(2))
        self.pose_text.setAccessibleName(tr("In this pose"))
        self.plate_text.setAccessibleName(tr("The plate as a whole"))

    def _lay_out(self) -> None:
        top, saving = in_row(self.mesh, self.start, self.stop), in_row(self.vtu, self.png)
        left = QWidget()
        parts = top, self.doing, self.controls, self.plate_text, saving, 1
        in_column(*parts, on=left, margins=(0, 0, 8, 0), spacing=6)
        scroll = keeping_width(scrolled(left, least=_WIDTH))
        right = in_column((self.canvas, 1), self.pose_text)
        in_row(scroll, (right, 1), on=self, margins=(10, 6, 10, 6))

    def _connect(self) -> None:
        self.start.clicked.connect(lambda _: self.solve())
        self.stop.clicked.connect(lambda _: self.end())
        self.vtu.clicked.connect(lambda _: self._ask("vtu"))
        self.png.clicked.connect(lambda _: self._ask("png"))
        self.controls.changed.connect(self._show)
        self.controls.mesh.toggled.connect(self.canvas.show_mesh)
        self.solving.progressed.connect(self._show_stage)
        self.solving.finished.connect(self.take)
        self.solving.failed.connect(self._fail)
        self._frames.timeout.connect(self._show)
        self.workbench.closing.connect(self.solving.close)
        self.workbench.theme_changed.connect(self.canvas.set_theme)

    # --- solving ----------------------------------------------------------------------------------

    def solve(self) -> None:
        """Solve the robot's plate; what is shown stays until there is an answer."""
        self.solving.start(self.workbench.robot, self.mesh.currentData())
        self._show_stage(mark("waiting"))
        self._show_state()

    def end(self) -> None:
        """Discard the answer."""
        self.solving.stop()
        self.doing.setText(tr("Stopped."))
        self._show_state()

    def take(self, solved: Solved) -> None:
        """Show a solved plate."""
        self.workbench.settled.emit(self)
        self.solved = solved
        self.plate_text.setText(plate_text(solved))
        triangles = solved.mesh.triangles.shape[1]
        text = tr("{triangles} triangles, {unknowns} unknowns.")
        unknowns = solved.solutions.unknowns
        self.doing.setText(text.format(triangles=triangles, unknowns=unknowns))
        self.controls.offer(solved.ranges, mode_titles(solved))
        self._show_state()
        self._show()

    def _fail(self, message: str) -> None:
        self.doing.setText(tr("Failed."))
        self.workbench.notify(Level.ERROR, message, about=self, subject=self)
        self._show_state()

    def _show_stage(self, name: str) -> None:
        self.doing.setText(tr("Solving: {stage} …").format(stage=tr(name)))

    # --- what is shown ----------------------------------------------------------------------------

    def _show_state(self) -> None:
        running = self.solving.running
        busy = tr("the plate is being computed; stop that first") if running else None
        allow(self.start, busy, tr("Compute the plate of the robot file; motion continues"))
        allow(self.mesh, busy, tr("A finer mesh is more accurate and takes longer"))
        idle = None if running else tr("nothing is being computed")
        allow(self.stop, idle, tr("Cancel the computation; motion continues"))
        why_not = None if self.solved is not None else tr(_UNSOLVED)
        allow(
            self.vtu,
            why_not,
            tr("Mesh, displacement, stress and modes for ParaView and similar programs"),
        )
        allow(self.png, why_not, tr("The displayed picture"))
        allow(self.controls, why_not, "")
        if self.solved is None:
            self.canvas.show_picture(None, tr(EMPTY))

    def _show(self) -> None:
        """Draw the plate as the controls say; a mode swings while it is in sight."""
        solved, controls = self.solved, self.controls
        if solved is None:
            return
        if controls.mode is None:
            pose = controls.pose
            picture = static_picture(solved, pose, controls.quantity, controls.magnification)
            controls.scale_text.setText(f"{fixed(picture.magnified, 0)} ×")
            self.pose_text.setText(pose_lines(solved, pose))
            self._mark(yields(solved, pose))
        else:
            phase = tau * (time.monotonic() % SWING_S) / SWING_S
            picture = mode_picture(solved, controls.mode, phase, controls.magnification)
            controls.scale_text.setText(f"{controls.scale.value()} %")
            self.pose_text.setText(picture.title)
            self._mark(False)
        self.canvas.show_picture(picture)
        swings = controls.mode is not None and self.isVisible()
        if swings != self._frames.isActive():
            (self._frames.start if swings else self._frames.stop)()

    def _mark(self, bad: bool) -> None:
        set_property(self.pose_text, "bad", bad)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Let a mode swing again."""
        super().showEvent(event)
        self._show()

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw nothing that nobody sees."""
        super().hideEvent(event)
        self._frames.stop()

    # --- files ------------------------------------------------------------------------------------

    def save_vtu(self, path: Path) -> None:
        """Write mesh, fields at the pose that is shown, and modes."""
        solved, pose = self.solved, self.controls.pose
        assert solved is not None
        self.workbench.write_file(
            "plate vtu", path, lambda: write_vtu(path, solved.solutions, pose, solved.modes)
        )

    def save_png(self, path: Path) -> None:
        """Write the picture as it is shown."""
        buffer = QBuffer()
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        self.canvas.grab().save(buffer, "PNG")
        picture = bytes(buffer.data().data())

        def write() -> None:
            with replaced(path) as file:
                file.write(picture)

        self.workbench.write_file("plate png", path, write)

    def _ask(self, suffix: str) -> None:
        every = tr("All files (*)")
        kinds = f"{suffix.upper()} (*.{suffix});;{every}"
        save = {"vtu": self.save_vtu, "png": self.save_png}[suffix]
        title = tr("Save the plate")
        ask_where(self, self.workbench, title, kinds, f"plate.{suffix}", save)
