"""The documentation pages inside the program, and the resolution of links between them.

A page is named by its path below ``docs``, such as ``safety_at.md`` or ``decisions/layers.md``,
followed by ``#section`` for a section. A third-party plugin may contain its own pages:
``their_package:help.md``.
"""

import posixpath
import re
import textwrap
from dataclasses import dataclass
from importlib import resources

DOCS_PACKAGE = "rotemina.docs"
CONTENTS_PAGE = "index.md"
_SITE_ONLY_FOLDERS = ("api/", "examples/", "site/")
_COMMENT = re.compile(r"<!--.*?-->\n*", re.DOTALL)
_FENCED_CODE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)
_INDENTED_CODE = re.compile(r"(\n\n)((?: {4}.*\n|[ \t]*\n(?= {4}))+)")
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")


@dataclass(frozen=True, slots=True)
class DocumentationPage:
    """A page or a section of one.

    Attributes
    ----------
    package : str
    path : str
        Path in the package.
    anchor : str
        "" for the beginning of the page.
    """

    package: str
    path: str
    anchor: str = ""

    @property
    def name(self) -> str:
        """The name of this page, as :func:`parse_page_name` accepts it."""
        package = "" if self.package == DOCS_PACKAGE else f"{self.package}:"
        anchor = f"#{self.anchor}" if self.anchor else ""
        return f"{package}{self.path}{anchor}"

    @property
    def exists(self) -> bool:
        """Whether the package contains the page."""
        return self.read_bytes() is not None

    def read_bytes(self) -> bytes | None:
        """Return the content of the file, or None if the package does not contain it."""
        if not self.path or self.path.startswith(("/", "../")) or "\\" in self.path:
            return None
        if self.package == DOCS_PACKAGE and self.path.startswith(_SITE_ONLY_FOLDERS):
            # These folders are generated for the web site; their sources are not readable as pages.
            return None
        try:
            return resources.files(self.package).joinpath(self.path).read_bytes()
        except (OSError, ImportError, ValueError, TypeError):
            return None

    def text(self) -> str | None:
        """Return the page without authors' comments, or None if the package lacks it."""
        data = self.read_bytes()
        if data is None:
            return None
        return _fence_indented_code(_COMMENT.sub("", data.decode("utf-8", "replace")))

    def resolve_link(self, link: str) -> "DocumentationPage":
        """Return the page to which a link in this page leads."""
        path, _, anchor = link.partition("#")
        if not path:
            return DocumentationPage(self.package, self.path, anchor)
        folder = posixpath.dirname(self.path)
        return DocumentationPage(
            self.package, posixpath.normpath(posixpath.join(folder, path)), anchor
        )


def parse_page_name(name: str) -> DocumentationPage:
    """Return the page or section that a name such as ``safety_at.md#section`` refers to."""
    location, _, anchor = name.partition("#")
    package, colon, path = location.rpartition(":")
    return DocumentationPage(package if colon else DOCS_PACKAGE, path, anchor)


def make_contents() -> str:
    """Return the first page of the documentation, with a list of all pages."""
    introduction = parse_page_name(CONTENTS_PAGE).text() or "# Help"
    files = resources.files(DOCS_PACKAGE).iterdir()
    names = sorted(item.name for item in files if item.name.endswith(".md"))
    pages = ((name, parse_page_name(name).text() or "") for name in names if name != CONTENTS_PAGE)
    rows = (f"- [{text.partition(chr(10))[0].lstrip('# ')}]({name})" for name, text in pages)
    return "\n".join([introduction, "", "## All pages", "", *rows, ""])


def _fence_indented_code(text: str) -> str:
    """Put fences around indented code, because Qt marks only fenced code as such."""
    result, position = "", 0
    for fence in [*_FENCED_CODE.finditer(text), None]:
        end = fence.start() if fence else len(text)
        result += _INDENTED_CODE.sub(_make_fence, text[position:end])
        result, position = (result + fence[0], fence.end()) if fence else (result, end)
    return result


def _make_fence(match: re.Match[str]) -> str:
    return f"{match[1]}```\n{textwrap.dedent(match[2]).rstrip()}\n```\n\n"


def make_slug(heading: str) -> str:
    """Return the anchor of a heading: its letters, digits and hyphens, as on web sites."""
    plain = _LINK.sub(r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def find_anchors(text: str) -> set[str]:
    """Return the anchors of all headings of a page."""
    headings = re.findall(r"^#+ (.*)$", _FENCED_CODE.sub("", text), re.MULTILINE)
    return {make_slug(heading) for heading in headings}
