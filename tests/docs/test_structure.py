"""The page that shows the structure of the source is current, and no imports are cyclic."""

import runpy

import pytest


@pytest.fixture
def structure(root):
    return runpy.run_path(str(root / ".ci" / "structure.py"))


@pytest.fixture
def page(root):
    return (root / "docs" / "structure.md").read_text("utf-8")


def test_the_page_is_current(structure, page):
    assert page.endswith(structure["table"]()), "make structure"


def test_the_page_names_every_folder(structure, page):
    folders = structure["find_folders"]()
    assert {"plugins", "app/motion/session", "sim/gap/compare", "resources/robots"} < {*folders}
    assert [folder for folder in folders if page.count(f"`{folder}/`") != 1] == []


def test_the_page_has_at_most_thirty_rows(page):
    rows = [line for line in page.splitlines() if line.startswith("| ")]
    headings = [line for line in rows if line.startswith("| area ")]
    assert 10 < len(rows) - len(headings) <= 30


def test_the_picture_names_every_area(root, structure):
    picture = (root / "docs" / "structure.svg").read_text("utf-8")
    assert [area for area in structure["AREAS"] if f">{area}<" not in picture] == []


def test_a_folder_that_belongs_to_no_area_or_to_several_is_reported(structure, monkeypatch):
    areas = structure["AREAS"]
    monkeypatch.setitem(areas, "Settings", ("", "app/settings"))
    monkeypatch.setitem(areas, "Robots", ("", "sim/robots"))
    monkeypatch.setitem(areas, "Resources", ("", "resources"))
    structure["areas"].cache_clear()
    with pytest.raises(SystemExit) as error:
        structure["areas"]()
    structure["areas"].cache_clear()
    problems = str(error.value).splitlines()
    assert "app/settings/ belongs to Language and settings and Settings" in problems
    assert "resources/icons/ belongs to no area" in problems
    assert "sim/robots of Robots is no folder" in problems


def test_a_name_is_found_in_the_module_that_defines_it(structure):
    find_module = structure["find_module"]
    assert find_module("sim/records", "Record") == "sim/records/record"
    assert find_module("drivers", "Driver") == "drivers/contract/driver"
    assert find_module("app/widgets/style", "theme") == "app/widgets/style/theme"
    assert find_module("sim/records/record", "Record") == "sim/records/record"
    assert find_module("plugins/control", "tr") == "plugins/control/__init__"


def test_no_modules_import_each_other(structure):
    """Imports for types only and imports inside functions count too."""
    assert structure["cycles"]() == []
