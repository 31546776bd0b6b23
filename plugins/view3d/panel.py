"""Panel with the robot in three dimensions, which browsers can show as well."""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QDesktopServices, QGuiApplication
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton

from rotemina.app.language import marked
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    STALE_AGE_S,
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.scene import (
    GhostPositions,
    RobotGhost,
    RobotScene,
    SceneColours,
    SceneTexts,
    SceneViewpoint,
)
from rotemina.app.widgets.controls import enable_unless
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.style import Theme
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.view3d import mark, tr
from rotemina.plugins.view3d.canvas import SceneCanvas
from rotemina.plugins.view3d.scene_server import SceneServer
from rotemina.sim.errors import ChainError
from rotemina.sim.robot import Robot

if TYPE_CHECKING:
    from rotemina.app.scene import ViewServer

VIEW_TEXTS = {
    SceneViewpoint.BELOW: (mark("From below"), mark("View of the objective")),
    SceneViewpoint.FRONT: (mark("Front"), mark("Along +y, z up")),
    SceneViewpoint.TOP: (mark("Top"), mark("Along −z")),
    SceneViewpoint.ISO: (mark("Iso"), mark("The whole robot from the side")),
    SceneViewpoint.CELL: (mark("Cell"), mark("The cell, with the tip 0.3 mm next to it, to scale")),
}
GHOST_CHOICES = {
    mark("Model and real"): (RobotGhost.MODEL, RobotGhost.REAL),
    mark("Model"): (RobotGhost.MODEL,),
    mark("Real"): (RobotGhost.REAL,),
}
MAGNIFICATIONS = (1, 10, 50, 100, 200)
STARTING_TEXT = mark("Starting the 3-D view …")
NO_BROWSER_TEXT = mark(
    "No browser could be opened. The address is on the clipboard: paste it into a browser on this "
    "computer."
)


def format_magnification(factor: int) -> str:
    """Return the text of a magnification of nano motion."""
    return (
        tr("Nano motion to scale")
        if factor == 1
        else tr("Nano motion × {factor}").format(factor=factor)
    )


def make_scene_words() -> SceneTexts:
    """Return the texts over the picture in the language in use."""
    return SceneTexts(
        model=tr("model"),
        real=tr("real"),
        unknown=tr("{ghost}: position unknown, not drawn"),
        old=tr("outdated: the last reading is {age_s:.1f} s old"),
        enlarged=tr(
            "thx, thy, zn enlarged {factor:g} × about mid-range; the tip is not drawn in its place"
        ),
        silent=tr("The program does not answer: the drawing is out of date."),
        quiet=tr("No data from the program: the drawing is out of date."),
    )


def make_scene_colours(theme: Theme) -> SceneColours:
    """Return the colours of the scene for a theme of the window."""
    return SceneColours(
        background=theme.surface,
        fixed=theme.command,
        model=theme.model,
        real=theme.real,
        forbidden=theme.danger,
    )


class View3dPanel(Panel):
    """Panel that draws the robot and, once requested, serves the view to browsers."""

    title = marked("panels", "3-D view")
    area = PanelArea.BOTTOM
    order = 80
    help_page = "view3d.md#for-operators"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.robot_scene, self._scene_problem = make_scene(workbench.robot, workbench.theme)
        scene = None if self.robot_scene is None else self.robot_scene.scene
        self.scene_server = None if scene is None else SceneServer(scene)
        self.canvas = None if scene is None else SceneCanvas(scene, workbench.theme)
        self.busy = False
        self._make_widgets()
        self._lay_out()
        offer_in_palette(*self.views.values(), self.browser, safe_while_hidden=True)
        self.show_state()
        self.follow_frames(self.refresh, shown=True)
        workbench.theme_changed.connect(self._use_theme)
        workbench.closing.connect(self._close)

    def open_in_browser(self) -> None:
        """Show the view in the browser of the desktop. Several browsers may show it at once."""
        if self.scene_server is None or self.busy:
            text = tr("The view is not opened: {why}.")
            reason = tr("it is being opened already") if self.busy else tr("there is no drawing")
            self.workbench.notify(Level.INFO, text.format(why=reason), about=self)
            return
        if self.scene_server.server is not None:
            self._open_browser()
            return
        self._set_busy(True)

        def on_started(_: None) -> None:
            self._set_busy(False)
            self._open_browser()

        def on_failed() -> None:
            self._set_busy(False)

        self.workbench.work(
            "view3d", tr(STARTING_TEXT), self.scene_server.start, on_started, on_failed
        )

    def show_view(self, view: SceneViewpoint) -> None:
        """Show the scene from a view in the window and in all browsers."""
        self._change_scene(lambda scene: scene.set_viewpoint(view))

    def refresh(self, state: SessionState) -> None:
        """Pass the newest positions to the scene if the window or a browser shows it."""
        scene, canvas, server = self.robot_scene, self.canvas, self._server
        if scene is None or canvas is None:
            return
        has_viewers = server is not None and server.viewer_count > 0
        if not has_viewers and not canvas.is_in_sight:
            return
        workbench = self.workbench
        is_live = workbench.source is workbench.session
        scene.show_bounds(workbench.session.bounds.keep_out if is_live else None)
        scene.show_positions(GhostPositions(state.measured, state.model, state.age_s))
        canvas.redraw_if_changed()
        if server is not None and has_viewers:
            scene.signal_alive(time.monotonic())
            server.send_changes()

    @property
    def _server(self) -> "ViewServer | None":
        return None if self.scene_server is None else self.scene_server.server

    def _open_browser(self) -> None:
        server = self._server
        if server is None:
            return
        if not QDesktopServices.openUrl(QUrl(server.url)):
            # The address is secret, so it must appear neither in a notice nor in the log.
            QGuiApplication.clipboard().setText(server.url)
            self.workbench.notify(Level.WARNING, tr(NO_BROWSER_TEXT), about=self)

    def _close(self) -> None:
        if self.scene_server is not None:
            self.scene_server.close()

    def _change_scene(self, change: Callable[[RobotScene], None]) -> None:
        if self.robot_scene is None or self.canvas is None:
            return
        change(self.robot_scene)
        self.canvas.redraw_if_changed()
        if self._server is not None:
            self._server.send_changes()

    def _set_busy(self, busy: bool) -> None:
        self.busy = busy
        self.show_state()

    def show_state(self) -> None:
        """Enable the actions that are possible now. Tooltips say why the others are not."""
        busy_objection = tr("the view is being opened") if self.busy else None
        enable_unless(
            self.browser,
            self._scene_problem or busy_objection,
            tr("Show the view in the browser of this desktop"),
        )
        for view, button in self.views.items():
            enable_unless(button, self._scene_problem, tr(VIEW_TEXTS[view][1]))
        enable_unless(self.ghosts, self._scene_problem, tr("Robots to draw"))
        enable_unless(
            self.magnification,
            self._scene_problem,
            tr("Enlarge the motion of thx, thy and zn about mid-range"),
        )

    def _make_widgets(self) -> None:
        self.views = {view: QPushButton(tr(text)) for view, (text, _) in VIEW_TEXTS.items()}
        for view, button in self.views.items():
            button.clicked.connect(lambda _=False, view=view: self.show_view(view))
        self.ghosts = QComboBox()
        for name in GHOST_CHOICES:
            self.ghosts.addItem(tr(name))
        self.ghosts.setAccessibleName(tr("Robots to draw"))
        choices = tuple(GHOST_CHOICES.values())
        self.ghosts.currentIndexChanged.connect(
            lambda index: self._change_scene(lambda scene: scene.choose_ghosts(*choices[index]))
        )
        self.magnification = QComboBox()
        for factor in MAGNIFICATIONS:
            self.magnification.addItem(format_magnification(factor), factor)
        self.magnification.setAccessibleName(tr("Magnification of nano motion"))
        self.magnification.currentIndexChanged.connect(
            lambda index: self._change_scene(
                lambda scene: scene.exaggerate(float(MAGNIFICATIONS[index]))
            )
        )
        self.browser = QPushButton(tr("Open in the browser"))
        self.browser.clicked.connect(self.open_in_browser)

    def _lay_out(self) -> None:
        # Two rows, because a single one would be too wide for a small window.
        top_row = make_row(*self.views.values(), 1)
        bottom_row = make_row(self.ghosts, self.magnification, 1, self.browser)
        make_column(
            top_row,
            bottom_row,
            (self.canvas or self._make_problem_label(), 1),
            on=self,
            margins=(10, 6, 10, 6),
        )

    def _make_problem_label(self) -> QLabel:
        problem_label = make_plain_label(self._scene_problem, quiet=False, wrap=True)
        problem_label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        return problem_label

    def _use_theme(self, theme: Theme) -> None:
        if self.canvas is not None:
            self.canvas.set_theme(theme)
        self._change_scene(lambda scene: scene.paint(make_scene_colours(theme)))


def make_scene(robot: Robot, theme: Theme) -> tuple[RobotScene | None, str | None]:
    """Return the scene of a robot, or why there is none."""
    try:
        colours, texts = make_scene_colours(theme), make_scene_words()
        return RobotScene(robot, colours, max_age_s=STALE_AGE_S, texts=texts), None
    except ChainError as error:
        return None, tr("There is nothing to draw. {error}").format(error=error)
