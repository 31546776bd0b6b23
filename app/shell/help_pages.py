"""The pages of the documentation that the program carries, and what their links lead to.

A page is named by its path below ``docs``, as ``safety.md`` or ``decisions/layers.md``, with
``#section`` behind it where a section is meant. A plugin by others may carry pages of its own:
``their_package:help.md``.
"""

import posixpath
import re
import textwrap
from dataclasses import dataclass
from importlib import resources

PACKAGE = "rotemina.docs"
CONTENTS = "index.md"
_SITE_ONLY = ("api/", "examples/", "site/")
_COMMENT = re.compile(r"<!--.*?-->\n*", re.DOTALL)
_FENCED = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)
_INDENTED = re.compile(r"(\n\n)((?: {4}.*\n|[ \t]*\n(?= {4}))+)")
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")


@dataclass(frozen=True, slots=True)
class Page:
    """A page, or a section of one: package, path in it, and anchor ("" for its beginning)."""

    package: str
    path: str
    anchor: str = ""

    @property
    def name(self) -> str:
        """What :func:`page` makes this of."""
        package = "" if self.package == PACKAGE else f"{self.package}:"
        anchor = f"#{self.anchor}" if self.anchor else ""
        return f"{package}{self.path}{anchor}"

    @property
    def exists(self) -> bool:
        """Whether it is carried."""
        return self.read_bytes() is not None

    def read_bytes(self) -> bytes | None:
        """Return what the file holds, or None if it is not carried."""
        if not self.path or self.path.startswith(("/", "../")) or "\\" in self.path:
            return None
        if self.package == PACKAGE and self.path.startswith(_SITE_ONLY):
            return None  # as they are in the source, they say nothing
        try:
            return resources.files(self.package).joinpath(self.path).read_bytes()
        except (OSError, ImportError, ValueError, TypeError):
            return None

    def text(self) -> str | None:
        """Return the page without what is for its makers only, or None if it is not carried."""
        data = self.read_bytes()
        if data is None:
            return None
        return _fenced(_COMMENT.sub("", data.decode("utf-8", "replace")))

    def beside(self, link: str) -> "Page":
        """Return what a link in this page leads to."""
        path, _, anchor = link.partition("#")
        if not path:
            return Page(self.package, self.path, anchor)
        folder = posixpath.dirname(self.path)
        return Page(self.package, posixpath.normpath(posixpath.join(folder, path)), anchor)


def page(name: str) -> Page:
    """Return the page of a name."""
    before, _, anchor = name.partition("#")
    package, colon, path = before.rpartition(":")
    return Page(package if colon else PACKAGE, path, anchor)


def contents() -> str:
    """Return the page that begins the documentation, with a list of all that are carried."""
    begun = page(CONTENTS).text() or "# Help"
    files = resources.files(PACKAGE).iterdir()
    names = sorted(item.name for item in files if item.name.endswith(".md"))
    listed = ((name, page(name).text() or "") for name in names if name != CONTENTS)
    rows = (f"- [{text.partition(chr(10))[0].lstrip('# ')}]({name})" for name, text in listed)
    return "\n".join([begun, "", "## All pages", "", *rows, ""])


def _fenced(text: str) -> str:
    """Put indented code between fences: Qt marks only such as code."""
    done, at = "", 0
    for fence in [*_FENCED.finditer(text), None]:
        end = fence.start() if fence else len(text)
        done += _INDENTED.sub(_fence, text[at:end])
        done, at = (done + fence[0], fence.end()) if fence else (done, end)
    return done


def _fence(found: re.Match[str]) -> str:
    return f"{found[1]}```\n{textwrap.dedent(found[2]).rstrip()}\n```\n\n"


def slug(heading: str) -> str:
    """Return the anchor of a heading: its letters, digits and hyphens, as sites make it."""
    plain = _LINK.sub(r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def anchors(text: str) -> set[str]:
    """Return the anchors of all headings of a page."""
    headings = re.findall(r"^#+ (.*)$", _FENCED.sub("", text), re.MULTILINE)
    return {slug(heading) for heading in headings}
