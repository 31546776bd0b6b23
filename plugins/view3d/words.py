"""Choices and words of the 3-D panel."""

from rotemina.app.scene.notes import Words
from rotemina.app.scene.robot_scene import Colours, Ghost
from rotemina.app.scene.views import View
from rotemina.app.shell.language import marked, translate
from rotemina.app.shell.theme import Theme

VIEWS = {
    View.BELOW: (marked("view3d", "From below"), marked("view3d", "As the objective sees it")),
    View.FRONT: (marked("view3d", "Front"), marked("view3d", "Along +y, z up")),
    View.TOP: (marked("view3d", "Top"), marked("view3d", "Along −z")),
    View.ISO: (marked("view3d", "Iso"), marked("view3d", "The whole robot, from aside")),
    View.CELL: (
        marked("view3d", "Cell"),
        marked("view3d", "The cell and the tip beside it, 0.3 mm away, true to scale"),
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
    "The whole robot in three dimensions, where the model says it is and where the readings say "
    "it is. It is drawn by this program alone; nothing leaves this computer.",
)
STARTING = marked("view3d", "Starting the 3-D view …")
OWN_WINDOW = marked("view3d", "On this display the view stands in a window of its own.")
LOST = marked(
    "view3d",
    "The view has ended ({why}). The rest of the program goes on; show it again, or use the "
    "browser.",
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
        old=translate("view3d", "old: the last reading came in {age_s:.1f} s ago"),
        enlarged=translate(
            "view3d",
            "thx, thy, zn drawn {factor:g} × too large from mid-range; "
            "the tip is not where it is drawn",
        ),
        silent=translate("view3d", "The program does not answer: what is drawn is old."),
        quiet=translate("view3d", "No news from the program: what is drawn is old."),
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
