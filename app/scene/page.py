"""The files of a browser's viewer: our page around the included viewer of meshcat."""

from dataclasses import dataclass
from functools import cache
from importlib import resources

from rotemina.sim.errors import InputError, reason_of
from rotemina.sim.messages import message

_OWN = {
    "": ("viewer.html", "text/html; charset=utf-8"),
    "viewer.css": ("viewer.css", "text/css; charset=utf-8"),
    "viewer.js": ("viewer.js", "text/javascript; charset=utf-8"),
}


class ViewerError(InputError):
    """The viewer cannot be served or shown."""


@dataclass(frozen=True, slots=True)
class PageFile:
    """What is sent under one name."""

    content: bytes
    kind: str


@cache
def page_files() -> dict[str, PageFile]:
    """Return every file of the viewer by name; there are no others.

    Raises
    ------
    ViewerError
        If one of them is missing.
    """
    folder = resources.files("rotemina.app.scene")
    sources = {name: (folder.joinpath(file), kind) for name, (file, kind) in _OWN.items()}
    viewer = resources.files("rotemina.resources.meshcat").joinpath("main.min.js")
    sources["meshcat.js"] = (viewer, "text/javascript; charset=utf-8")
    try:
        return {name: PageFile(file.read_bytes(), kind) for name, (file, kind) in sources.items()}
    except OSError as error:
        raise ViewerError(
            message(
                "engine",
                "{filename}: this file of the 3-D view cannot be read: {strerror}; install "
                "RoTeMiNa again",
            ).fill(filename=error.filename, strerror=reason_of(error))
        ) from error
