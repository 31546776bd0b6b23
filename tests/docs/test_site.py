"""The site is built without a warning, and loads nothing from other servers."""

import re
import subprocess
import sys
from importlib.util import find_spec

import pytest


@pytest.mark.slow
@pytest.mark.skipif(find_spec("mkdocs") is None, reason="no mkdocs: `make test-slow` installs it")
def test_the_site_is_complete_and_needs_no_network(root, tmp_path):
    configuration = root / "docs" / "site" / "mkdocs.yml"
    process = subprocess.run(
        [
            sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict",
            "--config-file", str(configuration), "--site-dir", str(tmp_path / "site"),
        ],
        capture_output=True, text=True, check=False, env={"NO_MKDOCS_2_WARNING": "1"},
    )  # fmt: skip
    assert process.returncode == 0, process.stderr
    driver = (tmp_path / "site" / "api" / "drivers.html").read_text("utf-8")
    assert "move_to" in driver
    for page in (tmp_path / "site").rglob("*.html"):
        external_resources = re.findall(
            r"<(?:script|img|link rel=.stylesheet.)[^>]*(?:src|href)=.https?:[^>]*",
            page.read_text("utf-8"),
        )
        assert external_resources == [], page.name
