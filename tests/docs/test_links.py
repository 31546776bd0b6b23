"""Links inside README and docs lead somewhere, and pictures show something."""

import re
from xml.etree import ElementTree

import pytest
from PIL import Image

from rotemina.sim.effects.registry import all_effects

_LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]+)\)")
_CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.DOTALL | re.MULTILINE)


def slug(heading):
    """The anchor of a heading, where GitHub and the site agree: letters, digits, hyphens."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def anchors_of(path):
    text = re.sub(r"^```.*?^```$", "", path.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    return {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)}


def targets_of(page):
    for mark, target in _LINK.findall(_CODE.sub("", page.read_text("utf-8"))):
        if not target.startswith(("http://", "https://")):
            file, _, anchor = target.partition("#")
            yield bool(mark), target, page.parent / file if file else page, anchor


def test_links_lead_somewhere(page):
    lost = [
        target
        for _, target, path, anchor in targets_of(page)
        if not path.exists() or (anchor and anchor not in anchors_of(path))
    ]
    assert lost == []


def test_pictures_show_something(page):
    for is_picture, target, path, _ in targets_of(page):
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
        for _, _, path, _ in targets_of(page)
        if path != page
    }
    named = (docs / "site" / "mkdocs.yml").read_text("utf-8")
    lost = [
        one
        for one in pages
        if one.resolve() not in linked and f" {one.relative_to(docs)}" not in named
    ]
    assert lost == []


@pytest.mark.parametrize("effect", all_effects()[0].values(), ids=lambda effect: effect.id)
def test_physics_has_the_equations_of_every_effect_as_they_are(effect, root):
    page = (root / "docs" / "physics.md").read_text("utf-8")
    _, _, section = page.partition(f"### {effect.title}\n")
    for one in effect.formulations:
        line = f"- **{one.name}**: `{one.equation}`."
        assert line in section
        assert section.partition(line)[2].partition("Source: ")[2].startswith(f"{one.source}.")
