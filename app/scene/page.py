"""The files that a viewer consists of: our page around the viewer of the package meshcat.

meshcat itself is never imported: that would start ZeroMQ, and its server listens on every network
interface. Of the package, one JavaScript file is read.
"""

from dataclasses import dataclass
from functools import cache
from importlib import resources
from importlib.util import find_spec
from pathlib import Path

from rotemina.app.scene.errors import ViewerError

_VIEWER = Path("viewer", "dist", "main.min.js")
_OWN = {
    "": ("viewer.html", "text/html; charset=utf-8"),
    "viewer.css": ("viewer.css", "text/css; charset=utf-8"),
    "viewer.js": ("viewer.js", "text/javascript; charset=utf-8"),
}


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
        If meshcat's viewer is not installed.
    """
    folder = resources.files("rotemina.app.scene")
    files = {
        name: PageFile(folder.joinpath(file).read_bytes(), kind)
        for name, (file, kind) in _OWN.items()
    }
    files["meshcat.js"] = PageFile(_meshcat_viewer(), "text/javascript; charset=utf-8")
    return files


def _meshcat_viewer() -> bytes:
    spec = find_spec("meshcat")
    if spec is None or spec.origin is None:
        raise ViewerError("the 3-D view needs the package meshcat: pip install meshcat")
    path = Path(spec.origin).parent / _VIEWER
    try:
        return path.read_bytes()
    except OSError as error:
        raise ViewerError(
            f"{path}: the viewer of the package meshcat cannot be read: {error.strerror}; install "
            "meshcat again"
        ) from error
