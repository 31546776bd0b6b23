"""The structure of the source: the page that shows it, and no modules that import each other."""

import runpy


def test_the_page_and_the_picture_name_every_folder(root):
    drawing = runpy.run_path(str(root / ".ci" / "structure.py"))
    page = (root / "docs" / "structure.md").read_text("utf-8")
    assert drawing["table"]() in page, "make structure"
    picture = (root / "docs" / "structure.svg").read_text("utf-8")
    for layer in drawing["LAYERS"]:
        rooms = {
            drawing["room_of"](path.relative_to(root).as_posix())
            for path in drawing["sources"](layer)
        }
        assert [
            one for one in rooms if "/" in one and f">{one.split('/')[1]}<" not in picture
        ] == []


def test_no_modules_import_each_other(root):
    """Imports for types, and those inside functions, count as any others."""
    structure = runpy.run_path(str(root / ".ci" / "structure.py"))
    assert structure["cycles"]() == []
