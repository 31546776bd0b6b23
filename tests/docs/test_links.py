"""Links inside README and docs have targets, and pictures are not empty."""

import re
from xml.etree import ElementTree

import pytest
from PIL import Image

from rotemina.sim.effects import load_all_effects

_LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]+)\)")
_CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.DOTALL | re.MULTILINE)


def make_anchor(heading):
    """Return the anchor of a heading as on GitHub and on the site: letters, digits, hyphens."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def find_anchors(path):
    text = re.sub(r"^```.*?^```$", "", path.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    return {make_anchor(heading) for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)}


def find_targets(page):
    for picture_mark, target in _LINK.findall(_CODE.sub("", page.read_text("utf-8"))):
        if not target.startswith(("http://", "https://")):
            file, _, anchor = target.partition("#")
            yield bool(picture_mark), target, page.parent / file if file else page, anchor


def test_links_have_targets(page):
    broken_links = [
        target
        for _, target, path, anchor in find_targets(page)
        if not path.exists() or (anchor and anchor not in find_anchors(path))
    ]
    assert broken_links == []


def test_pictures_are_not_empty(page):
    for is_picture, target, path, _ in find_targets(page):
        if not is_picture:
            continue
        if path.suffix == ".svg":
            assert len(list(ElementTree.parse(path).iter())) > 10, target  # noqa: S314 - our own
            continue
        with Image.open(path) as picture:
            assert min(picture.size) >= 200, target
            assert any(low != high for low, high in picture.convert("RGB").getextrema()), target


def test_every_page_is_linked_from_another(root):
    docs = root / "docs"
    pages = [path for path in docs.rglob("*.md") if "examples" not in path.parts]
    linked = {
        path.resolve()
        for page in (*pages, root / "README.md")
        for _, _, path, _ in find_targets(page)
        if path != page
    }
    navigation = (docs / "site" / "mkdocs.yml").read_text("utf-8")
    unlinked_pages = [
        page
        for page in pages
        if page.resolve() not in linked and f" {page.relative_to(docs)}" not in navigation
    ]
    assert unlinked_pages == []


@pytest.mark.parametrize("effect", load_all_effects()[0].values(), ids=lambda effect: effect.id)
def test_physics_shows_the_equations_of_every_effect_unchanged(effect, root):
    page = (root / "docs" / "physics.md").read_text("utf-8")
    _, _, section = page.partition(f"### {effect.title}\n")
    for formulation in effect.formulations:
        line = f"- **{formulation.name}**: `{formulation.equation}`."
        assert line in section
        assert (
            section.partition(line)[2].partition("Source: ")[2].startswith(f"{formulation.source}.")
        )
