"""Tests that the pages name exist."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
NAMED_TEST = re.compile(r"[\w/]*/test_\w+\.py")


def test_each_test_that_a_page_names_exists():
    names = {
        (page.name, name)
        for page in (ROOT / "docs").glob("*.md")
        for name in NAMED_TEST.findall(page.read_text("utf-8"))
    }
    assert names
    missing = [
        (page, name)
        for page, name in sorted(names)
        if not any((folder / name).is_file() for folder in (ROOT, ROOT / "tests"))
    ]
    assert not missing
