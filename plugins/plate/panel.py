"""Panel of the holding plate, which is solved on demand and shown in 3-D."""

import time
from math import tau
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QTimer
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QComboBox, QPushButton, QWidget

from rotemina.app.language import marked
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.shell.records import ask_save_path
from rotemina.app.widgets.controls import enable_unless, set_property
from rotemina.app.widgets.layout import fix_width, make_column, make_row, make_scroll_area
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.plate import mark, tr
from rotemina.plugins.plate.background_solution import BackgroundPlateSolver
from rotemina.plugins.plate.canvas import PlateCanvas
from rotemina.plugins.plate.controls import PlateControls
from rotemina.plugins.plate.solution import SolvedPlate
from rotemina.plugins.plate.surface_picture import make_mode_picture, make_static_picture
from rotemina.plugins.plate.words import (
    EMPTY_TEXT,
    MESH_CHOICES,
    describe_plate,
    describe_pose,
    is_yielding,
    make_mode_titles,
)
from rotemina.sim.files import replace_file
from rotemina.sim.messages import format_fixed
from rotemina.sim.plate import write_vtu

FRAME_MS = 33
_MIN_CONTROLS_WIDTH_PX = 330

# Every mode is shown with this period, whatever its frequency.
SWING_PERIOD_S = 2.0
_NOT_SOLVED_TEXT = mark("no plate is solved yet")


class PlatePanel(Panel):
    """Panel with controls on the left, the plate on the right, and its figures below."""

    title = marked("panels", "Holding plate")
    area = PanelArea.BOTTOM
    order = 90
    help_page = "plate.md#the-panel"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.solved: SolvedPlate | None = None
        self.solver = BackgroundPlateSolver(self)
        self.canvas, self.controls = PlateCanvas(workbench.theme), PlateControls()
        self._frames = QTimer(self, interval=FRAME_MS)
        self._make_parts()
        self._lay_out()
        self._connect()
        offer_in_palette(self.start, self.stop, self.vtu, self.png, safe_while_hidden=True)
        self._update_buttons()

    def _make_parts(self) -> None:
        self.mesh = QComboBox()
        self.mesh.setAccessibleName(tr("Mesh"))
        for title, divisions in MESH_CHOICES:
            self.mesh.addItem(tr(title), divisions)
        self.mesh.setCurrentIndex(1)
        self.start, self.stop = QPushButton(tr("Solve")), QPushButton(tr("Stop"))
        self.start.setProperty("primary", True)
        self.vtu, self.png = QPushButton(tr("Save VTU …")), QPushButton(tr("Save PNG …"))
        self.doing = make_plain_label(wrap=True)
        self.pose_text, self.plate_text = (
            make_plain_label(quiet=False, wrap=True) for _ in range(2)
        )
        self.pose_text.setAccessibleName(tr("In this pose"))
        self.plate_text.setAccessibleName(tr("The plate as a whole"))

    def _lay_out(self) -> None:
        top, saving = make_row(self.mesh, self.start, self.stop), make_row(self.vtu, self.png)
        left = QWidget()
        parts = top, self.doing, self.controls, self.plate_text, saving, 1
        make_column(*parts, on=left, margins=(0, 0, 8, 0), spacing=6)
        scroll = fix_width(make_scroll_area(left, min_width=_MIN_CONTROLS_WIDTH_PX))
        right = make_column((self.canvas, 1), self.pose_text)
        make_row(scroll, (right, 1), on=self, margins=(10, 6, 10, 6))

    def _connect(self) -> None:
        self.start.clicked.connect(lambda _: self.solve())
        self.stop.clicked.connect(lambda _: self.stop_solving())
        self.vtu.clicked.connect(lambda _: self._ask_save_path("vtu"))
        self.png.clicked.connect(lambda _: self._ask_save_path("png"))
        self.controls.changed.connect(self._draw_plate)
        self.controls.mesh.toggled.connect(self.canvas.show_mesh)
        self.solver.progressed.connect(self._show_stage)
        self.solver.finished.connect(self.take_solution)
        self.solver.failed.connect(self._on_failed)
        self._frames.timeout.connect(self._draw_plate)
        self.workbench.closing.connect(self.solver.close)
        self.workbench.theme_changed.connect(self.canvas.set_theme)

    def solve(self) -> None:
        """Solve the plate of the robot. The last solution stays until there is a new one."""
        self.solver.start(self.workbench.robot, self.mesh.currentData())
        self._show_stage(mark("waiting"))
        self._update_buttons()

    def stop_solving(self) -> None:
        """Stop solving."""
        self.solver.stop()
        self.doing.setText(tr("Stopped."))
        self._update_buttons()

    def take_solution(self, solved: SolvedPlate) -> None:
        """Show a solved plate."""
        self.workbench.settled.emit(self)
        self.solved = solved
        self.plate_text.setText(describe_plate(solved))
        triangles = solved.mesh.triangles.shape[1]
        text = tr("{triangles} triangles, {unknowns} unknowns.")
        unknowns = solved.solutions.unknowns
        self.doing.setText(text.format(triangles=triangles, unknowns=unknowns))
        self.controls.offer_solution(solved.ranges, make_mode_titles(solved))
        self._update_buttons()
        self._draw_plate()

    def _on_failed(self, message: str) -> None:
        self.doing.setText(tr("Failed."))
        self.workbench.notify(Level.ERROR, message, about=self, subject=self)
        self._update_buttons()

    def _show_stage(self, name: str) -> None:
        self.doing.setText(tr("Solving: {stage} …").format(stage=tr(name)))

    def _update_buttons(self) -> None:
        running = self.solver.running
        running_objection = tr("the plate is being computed; stop that first") if running else None
        enable_unless(
            self.start,
            running_objection,
            tr("Compute the plate of the robot file; motion continues"),
        )
        enable_unless(
            self.mesh, running_objection, tr("A finer mesh is more accurate and takes longer")
        )
        idle_objection = None if running else tr("nothing is being computed")
        enable_unless(self.stop, idle_objection, tr("Cancel the computation; motion continues"))
        objection = None if self.solved is not None else tr(_NOT_SOLVED_TEXT)
        enable_unless(
            self.vtu,
            objection,
            tr("Mesh, displacement, stress and modes for ParaView and similar programs"),
        )
        enable_unless(self.png, objection, tr("The displayed picture"))
        enable_unless(self.controls, objection, "")
        if self.solved is None:
            self.canvas.show_picture(None, tr(EMPTY_TEXT))

    def _draw_plate(self) -> None:
        solved, controls = self.solved, self.controls
        if solved is None:
            return
        if controls.mode is None:
            pose = controls.pose
            picture = make_static_picture(solved, pose, controls.quantity, controls.magnification)
            controls.scale_text.setText(f"{format_fixed(picture.magnification, 0)} ×")
            self.pose_text.setText(describe_pose(solved, pose))
            self._mark_pose(is_yielding(solved, pose))
        else:
            phase = tau * (time.monotonic() % SWING_PERIOD_S) / SWING_PERIOD_S
            picture = make_mode_picture(solved, controls.mode, phase, controls.magnification)
            controls.scale_text.setText(f"{controls.scale.value()} %")
            self.pose_text.setText(picture.title)
            self._mark_pose(False)
        self.canvas.show_picture(picture)
        is_animated = controls.mode is not None and self.isVisible()
        if is_animated != self._frames.isActive():
            (self._frames.start if is_animated else self._frames.stop)()

    def _mark_pose(self, is_yielding: bool) -> None:
        set_property(self.pose_text, "bad", is_yielding)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Continue the animation of a mode."""
        super().showEvent(event)
        self._draw_plate()

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 (Qt's name)
        """Stop the animation of a mode while it is not visible."""
        super().hideEvent(event)
        self._frames.stop()

    def save_vtu(self, path: Path) -> None:
        """Write the mesh, the fields at the shown pose, and the modes to a file."""
        solved, pose = self.solved, self.controls.pose
        assert solved is not None
        self.workbench.write_file(
            "plate vtu", path, lambda: write_vtu(path, solved.solutions, pose, solved.modes)
        )

    def save_png(self, path: Path) -> None:
        """Write the shown picture to a file."""
        buffer = QBuffer()
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        self.canvas.grab().save(buffer, "PNG")
        picture = bytes(buffer.data().data())

        def write() -> None:
            with replace_file(path) as file:
                file.write(picture)

        self.workbench.write_file("plate png", path, write)

    def _ask_save_path(self, suffix: str) -> None:
        all_files = tr("All files (*)")
        file_filter = f"{suffix.upper()} (*.{suffix});;{all_files}"
        save = {"vtu": self.save_vtu, "png": self.save_png}[suffix]
        title = tr("Save the plate")
        ask_save_path(self, self.workbench, title, file_filter, f"plate.{suffix}", save)
