"""Names and words stay plain: limits for the whole program, and names that must not come back."""

import ast
import csv
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[1]
LAYERS = ("app", "drivers", "plugins", "resources", "sim")
# These folders will be rewritten. Until then they do not count.
UNMEASURED = ("sim/gap/compare/", "sim/gap/noise/", "sim/gap/fit/")

MAX_SHARED_CLASS_SHARE = 0.04
MAX_ONE_WORD_CLASS_SHARE = 0.10
MAX_UNFINISHED_CONSTANTS = 50
MAX_PARTICIPLE_SHARE = 0.01

IRREGULAR_PARTICIPLES = re.compile(
    "broken|built|bought|chosen|drawn|driven|found|given|heard|held|hidden|kept|known|laid|left"
    "|made|said|seen|sent|shown|sought|taken|thrown|told|worn|written"
)
NOUNS_IN_ED = frozenset(("bed", "embed", "feed", "need", "seed", "shed", "speed"))
QUAINT = re.compile(
    r"\b(whoever|foretell\w*|foretold|unforetold|comes? into sight|(?:is|are) told of"
    r"|lets? go of)\b",
    re.IGNORECASE,
)
# A comment after a constant may give its unit. A longer one in lower case completes its name.
BARE_UNIT = re.compile(r"(noqa|type:|[a-zµ%°/²·]+$)")
# Former names of modules, which were meaningless to a control or robotics engineer.
RETIRED_MODULES = re.compile(
    "acting|actuation|ahead|asking|attempts|bars|beside|calibrating|caution|chance|closing"
    "|compensating|connected|contest|copies|course|demonstration|draft|edits|excursions|exits"
    "|extras|far|fast|finding|finely|fitted|fuzzy|ground|hand|hands|headline|held|holding|host"
    "|joined|joining|kept|known|lateness|lead|leaps|learning|leaving|left|levels|listing|live"
    "|look|meanings|measuring|naive|operator_desk|orders|overlay|pending|pieces|proof|prospect"
    "|question|rail|reasons|regulating|repeats|reserve|richness|searching|serving|sight"
    "|sight_of|solved|solving|spread|stages|standing|steady|stepped|stepping|stuck|subject"
    "|swings|teeth|teleoperator|telling|told|tones|transport|trials|twin|unchecked|unfinished"
    "|uploading|using|visits|voltage|wander|watched|way|where|which|whiteness"
)


class SourceModule(NamedTuple):
    """A module: its path in the project, its text and its syntax tree."""

    path: str
    text: str
    tree: ast.Module


@cache
def read_sources() -> tuple[SourceModule, ...]:
    return tuple(iterate_measured_modules())


def iterate_measured_modules() -> Iterator[SourceModule]:
    for layer in LAYERS:
        for file in sorted((ROOT / layer).rglob("*.py")):
            path = file.relative_to(ROOT).as_posix()
            if not path.startswith(UNMEASURED):
                text = file.read_text("utf-8")
                yield SourceModule(path, text, ast.parse(text))


def find_public_classes(sources):
    """Return the public class names of the sources, each with the files that define it."""
    files = defaultdict(set)
    for source in sources:
        for node in ast.walk(source.tree):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                files[node.name].add(source.path)
    return files


def is_one_word(name):
    return re.search(r"[a-z0-9][A-Z]", name) is None


def is_participle(name):
    first = name.strip("_").split("_")[0]
    regular = first.endswith("ed") and len(first) > 3 and first not in NOUNS_IN_ED
    return regular or IRREGULAR_PARTICIPLES.fullmatch(first) is not None


def is_property(node):
    return any("property" in ast.unparse(decorator) for decorator in node.decorator_list)


def find_unfinished_constants(source):
    """Yield the constants whose trailing comment holds the missing half of their name."""
    lines = source.text.splitlines()
    for node in source.tree.body:
        target = node.targets[0] if isinstance(node, ast.Assign) else getattr(node, "target", None)
        if not isinstance(target, ast.Name) or not target.id.isupper():
            continue
        comment = re.search(r"#\s*(.+)$", lines[node.end_lineno - 1])
        if comment and comment[1][:1].islower() and not BARE_UNIT.match(comment[1]):
            yield f"{source.path}: {target.id}"


def find_quaint_words(source):
    """Yield the quaint words in the docstrings and comments of a module."""
    for node in ast.walk(source.tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield from QUAINT.findall(ast.get_docstring(node) or "")
    for line in source.text.splitlines():
        yield from QUAINT.findall(line.partition("#")[2])


def test_a_public_class_name_exists_once():
    files = find_public_classes(read_sources())
    shared = {name: sorted(paths) for name, paths in files.items() if len(paths) > 1}
    count = sum(len(paths) for paths in shared.values())
    assert count <= MAX_SHARED_CLASS_SHARE * sum(map(len, files.values())), shared


def test_class_names_carry_their_role():
    names = find_public_classes(read_sources())
    one_word = sorted(name for name in names if is_one_word(name))
    assert len(one_word) <= MAX_ONE_WORD_CLASS_SHARE * len(names), one_word


def test_constants_make_sense_without_their_comments():
    unfinished = [name for source in read_sources() for name in find_unfinished_constants(source)]
    assert len(unfinished) <= MAX_UNFINISHED_CONSTANTS, unfinished


def test_functions_are_verbs():
    functions = [
        (source.path, node)
        for source in read_sources()
        for node in ast.walk(source.tree)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
    ]
    participles = [
        f"{path}: {node.name}"
        for path, node in functions
        if is_participle(node.name) and not is_property(node)
    ]
    assert len(participles) <= MAX_PARTICIPLE_SHARE * len(functions), participles


def test_the_code_has_no_quaint_words():
    words = {source.path: Counter(find_quaint_words(source)) for source in read_sources()}
    assert {path: counts for path, counts in words.items() if counts} == {}


def test_the_pages_have_no_quaint_words():
    pages = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    assert len(pages) > 30
    assert {page.name: QUAINT.findall(page.read_text("utf-8")) for page in pages} == {
        page.name: [] for page in pages
    }


def test_no_retired_module_name_comes_back():
    paths = [source.path for source in read_sources()]
    assert [path for path in paths if RETIRED_MODULES.fullmatch(Path(path).stem)] == []


@pytest.mark.parametrize(
    ("name", "expected"),
    [("diagnosed", True), ("_held_back", True), ("feed_rate", False), ("read", False)],
)
def test_participles_are_recognised(name, expected):
    assert is_participle(name) is expected


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("_SHAKES = 10.0  # times the power of a gap", 1),
        ("RATE = 10.0  # Hz", 0),
        ("WIDTH = 10.0  # µm", 0),
        ("# Above the noise of every sensor.\nWIDTH = 10.0", 0),
        ("LIMIT: float = 3.0  # of the range", 1),
    ],
)
def test_comments_that_complete_a_name_are_recognised(line, expected):
    source = SourceModule("sim/example.py", line, ast.parse(line))
    assert len(list(find_unfinished_constants(source))) == expected


def test_every_renamed_name_leads_to_one_that_exists():
    with (ROOT / "docs" / "renames.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 4000
    assert [row for row in rows if not name_exists(row["new"])] == []


def name_exists(name):
    """Return whether a module has the members that a dotted name lists after it."""
    parts = name.split(".")
    for count in range(len(parts), 1, -1):
        path = ROOT.joinpath(*parts[1:count])
        for file in (path.with_suffix(".py"), path / "__init__.py"):
            if file.is_file():
                return set(parts[count:]) <= find_names(file)
    return False


@cache
def find_names(file):
    """Return all names that a module defines or uses."""
    names = set()
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.Name):
            names.add(node.id)
        elif isinstance(node, ast.Attribute):
            names.add(node.attr)
    return names
