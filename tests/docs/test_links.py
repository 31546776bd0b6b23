"""Links inside README and docs have targets, and pictures are not empty."""

import re
from functools import cache
from xml.etree import ElementTree

from PIL import Image

from rotemina.sim.effects import load_all_effects

_LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]+)\)")
_CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.DOTALL | re.MULTILINE)


def make_anchor(heading):
    """Return the anchor of a heading as on GitHub and on the site: letters, digits, hyphens."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


@cache
def find_anchors(path):
    text = re.sub(r"^```.*?^```$", "", path.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    return {make_anchor(heading) for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)}


def find_targets(page):
    for picture_mark, target in _LINK.findall(_CODE.sub("", page.read_text("utf-8"))):
        if not target.startswith(("http://", "https://")):
            file, _, anchor = target.partition("#")
            yield bool(picture_mark), target, page.parent / file if file else page, anchor


def test_links_have_targets(pages):
    broken_links = [
        f"{page.name}: {target}"
        for page in pages
        for _, target, path, anchor in find_targets(page)
        if not path.exists() or (anchor and anchor not in find_anchors(path))
    ]
    assert broken_links == []


def test_pictures_are_not_empty(pages):
    paths = {path for page in pages for mark, _, path, _ in find_targets(page) if mark}
    assert len(paths) > 10
    for path in paths:
        if path.suffix == ".svg":
            assert len(list(ElementTree.parse(path).iter())) > 10, path  # noqa: S314 - our own
            continue
        with Image.open(path) as picture:
            assert min(picture.size) >= 200, path
            assert any(low != high for low, high in picture.convert("RGB").getextrema()), path


def test_every_page_is_linked_from_another(root, pages):
    docs = root / "docs"
    linked = {
        path.resolve() for page in pages for _, _, path, _ in find_targets(page) if path != page
    }
    navigation = (docs / "site" / "mkdocs.yml").read_text("utf-8")
    unlinked_pages = [
        page
        for page in pages
        if page.is_relative_to(docs)
        and page.resolve() not in linked
        and f" {page.relative_to(docs)}" not in navigation
    ]
    assert unlinked_pages == []


def test_physics_shows_the_equations_of_every_effect_unchanged(root):
    page = (root / "docs" / "physics.md").read_text("utf-8")
    for effect in load_all_effects()[0].values():
        _, _, section = page.partition(f"### {effect.title}\n")
        for formulation in effect.formulations:
            line = f"- **{formulation.name}**: `{formulation.equation}`."
            assert line in section, effect.id
            source = section.partition(line)[2].partition("Source: ")[2]
            assert source.startswith(f"{formulation.source}."), effect.id
