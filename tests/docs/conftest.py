"""The pages of the documentation, and the blocks of code in them."""

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
# The example plugin has separate tests.
PAGES = (ROOT / "README.md", *sorted(path for path in (ROOT / "docs").rglob("*.md")
                                      if "examples" not in path.parts))  # fmt: skip
PROGRAMS = ("rotemina", "pip", "make", "pytest", "python", "sudo", "apt-get", "git", "cd")
NOT_RUN = re.compile(r"<!-- not run: (\S.*) -->")


@dataclass(frozen=True)
class CodeBlock:
    """Code in a page, with its language ("" if not stated) and the reason if it is not run."""

    line: int
    language: str
    text: str
    not_run: str = ""

    @property
    def commands(self) -> list[str]:
        """The commands: the lines after "$ " if there are any, otherwise all lines."""
        lines = [line.strip() for line in self.text.splitlines()]
        typed_commands = [line[2:] for line in lines if line.startswith("$ ")]
        return typed_commands or [line for line in lines if line and not line.startswith("#")]

    @property
    def kind(self) -> str:
        """The stated language, else "sh" if the block begins with a program, otherwise "text"."""
        if self.language or not self.commands:
            return self.language or "text"
        word = self.commands[0].split()[0]
        return "sh" if word in PROGRAMS or word.startswith(".venv/") else "text"


def find_blocks(text: str) -> list[CodeBlock]:
    """Return the fenced and indented blocks of a page, in order."""
    lines = text.splitlines()
    blocks: list[CodeBlock] = []
    index = 0
    while index < len(lines):
        first = index
        if lines[index].startswith("```"):
            index = lines.index("```", index + 1)
            body, language = lines[first + 1 : index], lines[first].removeprefix("```").strip()
        elif lines[index].startswith("    ") and (index == 0 or not lines[index - 1].strip()):
            while index + 1 < len(lines) and (
                lines[index + 1].startswith("    ") or not lines[index + 1].strip()
            ):
                index += 1
            body, language = [line[4:] for line in lines[first : index + 1]], ""
        else:
            index += 1
            continue
        line_above = next((line for line in reversed(lines[:first]) if line.strip()), "")
        reason = NOT_RUN.fullmatch(line_above.strip())
        block_text = "\n".join(body).strip("\n") + "\n"
        blocks.append(CodeBlock(first + 1, language, block_text, reason[1] if reason else ""))
        index += 1
    return blocks


def name_page(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


@pytest.fixture(scope="session")
def pages() -> tuple[Path, ...]:
    """All pages."""
    return PAGES


@pytest.fixture(scope="session")
def blocks_of_pages() -> dict[str, list[CodeBlock]]:
    """The blocks of each page, by its name."""
    return {name_page(page): find_blocks(page.read_text("utf-8")) for page in PAGES}


@pytest.fixture(scope="session")
def root() -> Path:
    """The folder of README.md."""
    return ROOT


@pytest.fixture(scope="session")
def parse_blocks():
    """The function that finds blocks, for its own tests."""
    return find_blocks


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Run tests with ``page_to_run`` for the name of each page with code or commands."""
    if "page_to_run" in metafunc.fixturenames:
        names = [
            name_page(page)
            for page in PAGES
            if any(
                block.kind in ("python", "sh") and not block.not_run
                for block in find_blocks(page.read_text("utf-8"))
            )
        ]
        metafunc.parametrize("page_to_run", names)
