"""The robot in three dimensions, inside the window and in browsers."""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QDesktopServices, QGuiApplication
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S, Area, Panel, offer_in_palette
from rotemina.app.scene.robot_scene import Colours, Ghost, Reading, RobotScene
from rotemina.app.scene.scale_notes import Words
from rotemina.app.scene.views import View
from rotemina.app.shell.language import marked
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.plugins.view3d import mark, tr
from rotemina.plugins.view3d.canvas import Canvas
from rotemina.plugins.view3d.scene_server import Serving
from rotemina.sim.kinematics.chain import ChainError
from rotemina.sim.robot.model import Robot

if TYPE_CHECKING:
    from rotemina.app.scene.server import ViewServer

VIEWS = {
    View.BELOW: (mark("From below"), mark("View of the objective")),
    View.FRONT: (mark("Front"), mark("Along +y, z up")),
    View.TOP: (mark("Top"), mark("Along −z")),
    View.ISO: (mark("Iso"), mark("The whole robot from the side")),
    View.CELL: (mark("Cell"), mark("The cell, with the tip 0.3 mm beside it, to scale")),
}
GHOSTS = {
    mark("Model and real"): (Ghost.MODEL, Ghost.REAL),
    mark("Model"): (Ghost.MODEL,),
    mark("Real"): (Ghost.REAL,),
}
FACTORS = (1, 10, 50, 100, 200)
STARTING = mark("Starting the 3-D view …")
NO_BROWSER = mark(
    "No browser could be opened. The address is on the clipboard: paste it into a browser on this "
    "computer."
)


def factor_text(factor: int) -> str:
    """Return how an exaggeration is offered."""
    return (
        tr("Nano motion to scale")
        if factor == 1
        else tr("Nano motion × {factor}").format(factor=factor)
    )


def written() -> Words:
    """Return what is written over the picture."""
    return Words(
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


def colours_of(theme: Theme) -> Colours:
    """Return the scene's colours in a theme of the window."""
    return Colours(
        background=theme.surface,
        fixed=theme.command,
        model=theme.model,
        real=theme.real,
        forbidden=theme.danger,
    )


class View3dPanel(Panel):
    """Draws the robot, and serves it to browsers from the first that is requested."""

    title = marked("panels", "3-D view")
    area = Area.BOTTOM
    order = 80
    help_page = "view3d.md#for-operators"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.robot_scene, self._unfit = scene_of(workbench.robot, workbench.theme)
        scene = None if self.robot_scene is None else self.robot_scene.scene
        self.serving = None if scene is None else Serving(scene)
        self.canvas = None if scene is None else Canvas(scene, workbench.theme)
        self.busy = False
        self._make_widgets()
        self._lay_out()
        offer_in_palette(*self.views.values(), self.browser, safe_while_hidden=True)
        self.show_state()
        self.follow_frames(self.refresh, shown=True)
        workbench.theme_changed.connect(self._use_theme)
        workbench.closing.connect(self._close)

    # --- what is asked for ------------------------------------------------------------------------

    def open_in_browser(self) -> None:
        """Show the view in the browser of the desktop; several may look at once."""
        if self.serving is None or self.busy:
            text = tr("The view is not opened: {why}.")
            why = tr("it is being opened already") if self.busy else tr("there is no drawing")
            self.workbench.notify(Level.INFO, text.format(why=why), about=self)
            return
        if self.serving.server is not None:
            self._browse()
            return
        self._set_busy(True)

        def done(_: None) -> None:
            self._set_busy(False)
            self._browse()

        def failed() -> None:
            self._set_busy(False)

        self.workbench.work("view3d", tr(STARTING), self.serving.start, done, failed)

    def look(self, view: View) -> None:
        """Look from there, in every viewer."""
        self._change(lambda scene: scene.look(view))

    def refresh(self, state: SessionState) -> None:
        """Hand the newest positions on, unless nobody sees them."""
        scene, canvas, server = self.robot_scene, self.canvas, self._server
        if scene is None or canvas is None:
            return
        watched = server is not None and server.watching > 0
        if not watched and not canvas.in_sight:
            return
        bench = self.workbench
        live = bench.source is bench.session
        scene.bound(bench.session.bounds.keep_out if live else None)
        scene.show(Reading(state.measured, state.model, state.age_s))
        canvas.follow()
        if server is not None and watched:
            scene.alive(time.monotonic())
            server.changed()

    @property
    def _server(self) -> "ViewServer | None":
        return None if self.serving is None else self.serving.server

    # --- inside -----------------------------------------------------------------------------------

    def _browse(self) -> None:
        server = self._server
        if server is None:
            return
        if not QDesktopServices.openUrl(QUrl(server.url)):
            # The address is a secret: neither in a notice nor in the log.
            QGuiApplication.clipboard().setText(server.url)
            self.workbench.notify(Level.WARNING, tr(NO_BROWSER), about=self)

    def _close(self) -> None:
        if self.serving is not None:
            self.serving.close()

    def _change(self, change: Callable[[RobotScene], None]) -> None:
        if self.robot_scene is None or self.canvas is None:
            return
        change(self.robot_scene)
        self.canvas.follow()
        if self._server is not None:
            self._server.changed()

    def _set_busy(self, busy: bool) -> None:
        self.busy = busy
        self.show_state()

    def show_state(self) -> None:
        """Show what can be done now, and why not."""
        busy = tr("the view is being opened") if self.busy else None
        allow(self.browser, self._unfit or busy, tr("Show the view in the browser of this desktop"))
        for view, button in self.views.items():
            allow(button, self._unfit, tr(VIEWS[view][1]))
        allow(self.ghosts, self._unfit, tr("Robots to draw"))
        allow(self.factor, self._unfit, tr("Enlarge the motion of thx, thy and zn about mid-range"))

    def _make_widgets(self) -> None:
        self.views = {view: QPushButton(tr(text)) for view, (text, _) in VIEWS.items()}
        for view, button in self.views.items():
            button.clicked.connect(lambda _=False, view=view: self.look(view))
        self.ghosts = QComboBox()
        for name in GHOSTS:
            self.ghosts.addItem(tr(name))
        self.ghosts.setAccessibleName(tr("Robots to draw"))
        drawn = tuple(GHOSTS.values())
        self.ghosts.currentIndexChanged.connect(
            lambda at: self._change(lambda scene: scene.choose(*drawn[at]))
        )
        self.factor = QComboBox()
        for factor in FACTORS:
            self.factor.addItem(factor_text(factor), factor)
        self.factor.setAccessibleName(tr("Magnification of nano motion"))
        self.factor.currentIndexChanged.connect(
            lambda at: self._change(lambda scene: scene.exaggerate(float(FACTORS[at])))
        )
        self.browser = QPushButton(tr("Open in the browser"))
        self.browser.clicked.connect(self.open_in_browser)

    def _lay_out(self) -> None:
        above = in_row(*self.views.values(), 1)  # one row would widen a small window
        below = in_row(self.ghosts, self.factor, 1, self.browser)
        in_column(above, below, (self.canvas or self._reason(), 1), on=self, margins=(10, 6, 10, 6))

    def _reason(self) -> QLabel:
        words = plain_text(self._unfit, quiet=False, wrap=True)
        words.setAlignment(Qt.AlignmentFlag.AlignCenter)
        return words

    def _use_theme(self, theme: Theme) -> None:
        if self.canvas is not None:
            self.canvas.set_theme(theme)
        self._change(lambda scene: scene.paint(colours_of(theme)))


def scene_of(robot: Robot, theme: Theme) -> tuple[RobotScene | None, str | None]:
    """Return the scene of a robot, or why there is none."""
    try:
        colours, said = colours_of(theme), written()
        return RobotScene(robot, colours, old_s=STALE_S, words=said), None
    except ChainError as error:
        return None, tr("There is nothing to draw. {error}").format(error=error)
