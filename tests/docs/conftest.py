"""The pages, and the blocks of code that stand in them."""

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
# The example of a plugin has tests of its own.
PAGES = (ROOT / "README.md", *sorted(path for path in (ROOT / "docs").rglob("*.md")
                                      if "examples" not in path.parts))  # fmt: skip
PROGRAMS = ("rotemina", "pip", "make", "pytest", "python", "sudo", "apt-get", "git", "cd")
NOT_RUN = re.compile(r"<!-- not run: (\S.*) -->")


@dataclass(frozen=True)
class Block:
    """Code in a page: its language ("" if it names none), and why it is not run, if so."""

    line: int
    language: str
    text: str
    not_run: str = ""

    @property
    def commands(self) -> list[str]:
        """Lines to be typed: those after "$ " if there are any, the rest being what is answered."""
        lines = [line.strip() for line in self.text.splitlines()]
        typed = [line[2:] for line in lines if line.startswith("$ ")]
        return typed or [line for line in lines if line and not line.startswith("#")]

    @property
    def kind(self) -> str:
        """Language of a fence; else "sh" for what begins with a program, "text" for the rest."""
        if self.language or not self.commands:
            return self.language or "text"
        word = self.commands[0].split()[0]
        return "sh" if word in PROGRAMS or word.startswith(".venv/") else "text"


def blocks_of(text: str) -> list[Block]:
    """Fenced and indented blocks of a page, in order; a tab of a site (===) indents nothing."""
    lines = text.splitlines()
    found: list[Block] = []
    at = 0
    while at < len(lines):
        begun = at
        if lines[at].startswith("```"):
            at = lines.index("```", at + 1)
            body, language = lines[begun + 1 : at], lines[begun].removeprefix("```").strip()
        elif lines[at].startswith("    ") and (at == 0 or not lines[at - 1].strip()):
            while at + 1 < len(lines) and (
                lines[at + 1].startswith("    ") or not lines[at + 1].strip()
            ):
                at += 1
            body, language = [line[4:] for line in lines[begun : at + 1]], ""
        else:
            at += 1
            continue
        above = next((line for line in reversed(lines[:begun]) if line.strip()), "")
        reason = NOT_RUN.fullmatch(above.strip())
        joined = "\n".join(body).strip("\n") + "\n"
        found.append(Block(begun + 1, language, joined, reason[1] if reason else ""))
        at += 1
    return found


@pytest.fixture(params=PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def page(request) -> Path:
    """Each page in turn."""
    return request.param


@pytest.fixture
def root() -> Path:
    """The folder of README.md."""
    return ROOT


@pytest.fixture
def blocks(page) -> list[Block]:
    """The blocks of the page."""
    return blocks_of(page.read_text("utf-8"))


@pytest.fixture(scope="session")
def parse_blocks():
    """The function that finds blocks, for tests of its own."""
    return blocks_of
