"""The files of the browser viewer: the program's page, and the viewer of meshcat."""

from dataclasses import dataclass
from functools import cache
from importlib import resources

from rotemina.app.errors import ViewerError
from rotemina.sim.errors import (
    describe_exception,
)

_OWN_FILES = {
    "": ("viewer.html", "text/html; charset=utf-8"),
    "viewer.css": ("viewer.css", "text/css; charset=utf-8"),
    "viewer.js": ("viewer.js", "text/javascript; charset=utf-8"),
}


@dataclass(frozen=True, slots=True)
class PageFile:
    """A file that the server sends: its content and its MIME type."""

    content: bytes
    content_type: str


@cache
def load_page_files() -> dict[str, PageFile]:
    """Return all files that the server may send, by name.

    Raises
    ------
    ViewerError
        If a file cannot be read.
    """
    folder = resources.files("rotemina.app.scene")
    sources = {
        name: (folder.joinpath(file), content_type)
        for name, (file, content_type) in _OWN_FILES.items()
    }
    viewer = resources.files("rotemina.resources.meshcat").joinpath("main.min.js")
    sources["meshcat.js"] = (viewer, "text/javascript; charset=utf-8")
    try:
        return {
            name: PageFile(file.read_bytes(), content_type)
            for name, (file, content_type) in sources.items()
        }
    except OSError as error:
        raise ViewerError(
            "{filename}: this file of the 3-D view cannot be read: {strerror}; install "
            "RoTeMiNa again",
            filename=error.filename,
            strerror=describe_exception(error),
        ) from error
