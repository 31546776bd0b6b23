"""Choices and words of the 3-D panel."""

from rotemina.app.scene.robot_scene import Colours, Ghost
from rotemina.app.scene.views import View
from rotemina.app.shell.theme import Theme

VIEWS = {
    View.BELOW: ("From below", "As the objective sees it"),
    View.FRONT: ("Front", "Along +y, z up"),
    View.TOP: ("Top", "Along −z"),
    View.ISO: ("Iso", "The whole robot, from aside"),
    View.CELL: ("Cell", "The cell and the tip beside it, 0.3 mm away, true to scale"),
}
GHOSTS = {
    "Model and real": (Ghost.MODEL, Ghost.REAL),
    "Model": (Ghost.MODEL,),
    "Real": (Ghost.REAL,),
}
FACTORS = (1, 10, 50, 100, 200)
INTRODUCTION = (
    "The whole robot in three dimensions, where the model says it is and where the readings say "
    "it is. It is drawn by this program alone; nothing leaves this computer."
)
STARTING = "Starting the 3-D view …"
OWN_WINDOW = "On this display the view stands in a window of its own."
LOST = (
    "The view has ended ({}). The rest of the program goes on; show it again, or use the browser."
)
NO_BROWSER = (
    "No browser could be opened. The address is on the clipboard: paste it into a browser on this "
    "computer."
)


def factor_text(factor: int) -> str:
    """Return how an exaggeration is offered."""
    return "Nano motion to scale" if factor == 1 else f"Nano motion × {factor}"


def colours_of(theme: Theme) -> Colours:
    """Return the scene's colours in a theme of the window."""
    return Colours(
        background=theme.surface,
        fixed=theme.command,
        model=theme.model,
        real=theme.real,
        forbidden=theme.danger,
    )
