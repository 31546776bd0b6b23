"""The robot in three dimensions, inside the window or in a browser."""

import os
import time
from collections.abc import Callable

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QDesktopServices, QGuiApplication
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S, Area, Panel
from rotemina.app.scene.notes import Words
from rotemina.app.scene.robot_scene import Colours, Ghost, Reading, RobotScene
from rotemina.app.scene.views import View
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow
from rotemina.plugins.view3d import embedding
from rotemina.plugins.view3d.embedding import WebProcess
from rotemina.plugins.view3d.serving import Serving
from rotemina.sim.kinematics.chain import ChainError
from rotemina.sim.robot.model import Robot

VIEWS = {
    View.BELOW: (marked("view3d", "From below"), marked("view3d", "View of the objective")),
    View.FRONT: (marked("view3d", "Front"), marked("view3d", "Along +y, z up")),
    View.TOP: (marked("view3d", "Top"), marked("view3d", "Along −z")),
    View.ISO: (marked("view3d", "Iso"), marked("view3d", "The whole robot from the side")),
    View.CELL: (
        marked("view3d", "Cell"),
        marked("view3d", "The cell, with the tip 0.3 mm beside it, to scale"),
    ),
}
GHOSTS = {
    marked("view3d", "Model and real"): (Ghost.MODEL, Ghost.REAL),
    marked("view3d", "Model"): (Ghost.MODEL,),
    marked("view3d", "Real"): (Ghost.REAL,),
}
FACTORS = (1, 10, 50, 100, 200)
INTRODUCTION = marked(
    "view3d",
    "The whole robot in three dimensions, as the model predicts it and as the "
    "sensors read it. This program draws it; nothing leaves this computer.",
)
STARTING = marked("view3d", "Starting the 3-D view …")
OWN_WINDOW = marked("view3d", "On this display the view opens in a window of its own.")
LOST = marked(
    "view3d",
    "The view has ended ({why}); the rest of the program continues. Show the "
    "view again, or use the browser.",
)
NO_BROWSER = marked(
    "view3d",
    "No browser could be opened. The address is on the clipboard: paste it into a browser on this "
    "computer.",
)


def factor_text(factor: int) -> str:
    """Return how an exaggeration is offered."""
    return (
        translate("view3d", "Nano motion to scale")
        if factor == 1
        else translate("view3d", "Nano motion × {factor}").format(factor=factor)
    )


def written() -> Words:
    """Return what is written over the picture."""
    return Words(
        model=translate("view3d", "model"),
        real=translate("view3d", "real"),
        unknown=translate("view3d", "{ghost}: position unknown, not drawn"),
        old=translate("view3d", "outdated: the last reading is {age_s:.1f} s old"),
        enlarged=translate(
            "view3d",
            "thx, thy, zn enlarged {factor:g} × about mid-range; the tip is not drawn in its place",
        ),
        silent=translate("view3d", "The program does not answer: the drawing is out of date."),
        quiet=translate("view3d", "No news from the program: the drawing is out of date."),
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
    """Asks first where to show the view: nothing is started before."""

    title = marked("panels", "3-D view")
    area = Area.BOTTOM
    order = 80
    help_page = "view3d.md#for-operators"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.robot_scene, self._unfit = scene_of(workbench.robot, workbench.theme)
        self.serving = None if self.robot_scene is None else Serving(self.robot_scene.scene)
        self._view: WebProcess | None = None
        self.own_window = False
        self.busy = False
        self._make_widgets()
        self._lay_out()
        self.show_state()
        workbench.shown.connect(self.refresh)
        workbench.theme_changed.connect(self._use_theme)
        workbench.closing.connect(self._close)

    @property
    def in_sight(self) -> bool:
        """Whether any of the panel can be seen; a dock behind another one counts as visible."""
        return self.isVisible() and not self.visibleRegion().isEmpty()

    # --- what is asked for ------------------------------------------------------------------------

    def open_here(self) -> None:
        """Show the view inside the window."""
        self._serve(self._embed)

    def open_in_browser(self) -> None:
        """Show the view in the browser of the desktop; several may look at once."""
        self._serve(self._browse)

    def close_view(self, wait: bool = False) -> None:
        """Take the view out of the window; browsers go on."""
        view, self._view = self._view, None
        self.stack.setCurrentIndex(0)
        if view is not None:
            view.release(wait)
        self.busy = self.own_window = False
        self.show_state()

    def look(self, view: View) -> None:
        """Look from there, in every viewer."""
        self._change(lambda scene: scene.look(view))

    def refresh(self, state: SessionState) -> None:
        """Hand the newest positions on, unless nobody sees them."""
        scene, server = self.robot_scene, self.serving and self.serving.server
        if scene is None or server is None:
            return
        hidden = self._view is not None and not self.own_window and not self.in_sight
        out_of_sight = 1 if hidden else 0
        if server.watching <= out_of_sight:
            return
        bench = self.workbench
        live = bench.source is bench.session
        scene.bound(bench.session.bounds.keep_out if live else None)
        scene.show(Reading(state.measured, state.model, state.age_s))
        scene.alive(time.monotonic())
        server.changed()

    # --- opening ----------------------------------------------------------------------------------

    def _serve(self, then: Callable[[], None]) -> None:
        """Start the server in the background, if there is none yet, and go on."""
        if self.serving is None or self.busy:
            return
        if self.serving.server is not None:
            then()
            return
        self.busy = True
        self.show_state()

        def done(_: None) -> None:
            self.busy = False
            then()
            self.show_state()

        def failed() -> None:
            self.busy = False
            self.show_state()

        self.workbench.work(
            "view3d", translate("view3d", STARTING), self.serving.start, done, failed
        )

    def _embed(self) -> None:
        server = self.serving and self.serving.server
        if server is None or self._view is not None:
            return
        self.busy = True
        self._view = view = WebProcess(self)
        view.made.connect(self._adopt)
        view.loaded.connect(self._came)
        view.ended.connect(self._ended)
        view.stop_asked.connect(self.workbench.stop)
        view.latch_asked.connect(self.workbench.emergency_stop)
        view.start(server.url)
        self.show_state()

    def _adopt(self, widget: QWidget | None) -> None:
        if widget is not None:
            widget.setAccessibleName(translate("view3d", "The robot in three dimensions"))
            self.stack.addWidget(widget)
            self.stack.setCurrentWidget(widget)
        self.own_window = widget is None

    def _came(self) -> None:
        self.busy = False
        self.show_state()

    def _ended(self, why: str) -> None:
        self.close_view()
        self.show_state(translate("view3d", LOST).format(why=why))

    def _browse(self) -> None:
        server = self.serving and self.serving.server
        if server is None:
            return
        if not QDesktopServices.openUrl(QUrl(server.url)):
            # The address is a secret: neither in a notice nor in the log.
            QGuiApplication.clipboard().setText(server.url)
            self.workbench.notify(Level.WARNING, translate("view3d", NO_BROWSER), about=self)

    def _close(self) -> None:
        self.close_view(wait=True)
        if self.serving is not None:
            self.serving.close()

    # --- inside -----------------------------------------------------------------------------------

    def _change(self, change: Callable[[RobotScene], None]) -> None:
        if self.robot_scene is None:
            return
        change(self.robot_scene)
        if self.serving is not None and self.serving.server is not None:
            self.serving.server.changed()

    def show_state(self, trouble: str = "") -> None:
        """Show what can be done now, and why not."""
        unfit = embedding.why_not(os.environ, embedding.user_number())
        busy = translate("view3d", "the view is being opened") if self.busy else None
        served = self.serving is not None and self.serving.server is not None
        lines = [self._unfit or translate("view3d", INTRODUCTION)]
        if self.busy:
            lines.append(translate("view3d", STARTING))
        elif self.own_window:
            lines.append(translate("view3d", OWN_WINDOW))
        elif self._unfit is None:
            lines += [unfit or "", trouble]
        self.words.setText("\n\n".join(line for line in lines if line))
        here = translate("view3d", "it is already open here") if self._view else None
        allow(
            self.here,
            self._unfit or unfit or busy or here,
            translate("view3d", "Show the view in this panel"),
        )
        allow(
            self.browser,
            self._unfit or busy,
            translate("view3d", "Show the view in the browser of this desktop"),
        )
        allow(
            self.end,
            None if self._view else translate("view3d", "it is not open here"),
            translate("view3d", "Close the view"),
        )
        closed = None if served else translate("view3d", "open the view first")
        for view, button in self.views.items():
            allow(button, closed, translate("view3d", VIEWS[view][1]))
        allow(self.ghosts, closed, translate("view3d", "Robots to draw"))
        allow(
            self.factor,
            closed,
            translate("view3d", "Enlarge the motion of thx, thy and zn about mid-range"),
        )

    def _make_widgets(self) -> None:
        self.views = {
            view: QPushButton(translate("view3d", text)) for view, (text, _) in VIEWS.items()
        }
        for view, button in self.views.items():
            button.clicked.connect(lambda _=False, view=view: self.look(view))
        self.ghosts = QComboBox()
        for name in GHOSTS:
            self.ghosts.addItem(translate("view3d", name))
        self.ghosts.setAccessibleName(translate("view3d", "Robots to draw"))
        drawn = tuple(GHOSTS.values())
        self.ghosts.currentIndexChanged.connect(
            lambda at: self._change(lambda scene: scene.choose(*drawn[at]))
        )
        self.factor = QComboBox()
        for factor in FACTORS:
            self.factor.addItem(factor_text(factor), factor)
        self.factor.setAccessibleName(translate("view3d", "Magnification of nano motion"))
        self.factor.currentIndexChanged.connect(
            lambda at: self._change(lambda scene: scene.exaggerate(float(FACTORS[at])))
        )
        self.here = QPushButton(translate("view3d", "Show here"))
        self.here.clicked.connect(self.open_here)
        self.browser = QPushButton(translate("view3d", "Open in the browser"))
        self.browser.clicked.connect(self.open_in_browser)
        self.end = QPushButton(translate("view3d", "Close"))
        self.end.clicked.connect(self.close_view)
        self.words = QLabel()
        self.words.setTextFormat(Qt.TextFormat.PlainText)
        self.words.setWordWrap(True)
        self.words.setAlignment(Qt.AlignmentFlag.AlignCenter)

    def _lay_out(self) -> None:
        above, below = QHBoxLayout(), QHBoxLayout()  # one row would widen a small window
        for button in self.views.values():
            above.addWidget(button)
        above.addStretch(1)
        for widget in (self.ghosts, self.factor):
            below.addWidget(widget)
        below.addStretch(1)
        for button in (self.here, self.browser, self.end):
            below.addWidget(button)
        self.stack = QStackedWidget()
        start = QWidget()
        column = QVBoxLayout(start)
        column.addStretch(1)
        column.addWidget(self.words)
        column.addStretch(1)
        self.stack.addWidget(start)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(10, 6, 10, 6)
        outer.addLayout(above)
        outer.addLayout(below)
        outer.addWidget(self.stack, 1)

    def _use_theme(self, theme: Theme) -> None:
        self._change(lambda scene: scene.paint(colours_of(theme)))


def scene_of(robot: Robot, theme: Theme) -> tuple[RobotScene | None, str | None]:
    """Return the scene of a robot, or why there is none."""
    try:
        colours, said = colours_of(theme), written()
        return RobotScene(robot, colours, old_s=STALE_S, words=said), None
    except ChainError as error:
        return None, translate("view3d", "There is nothing to draw. {error}").format(error=error)
