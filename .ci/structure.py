"""Draw the structure of the source and print its measures: `python .ci/structure.py [--page]`.

With ``--page`` it writes docs/structure.svg and the table in docs/structure.md.
"""

import ast
import re
import sys
from collections import defaultdict
from collections.abc import Iterator
from html import escape
from pathlib import Path
from statistics import median, quantiles

ROOT = Path(__file__).parents[1]
LAYERS = ("plugins", "app", "drivers", "sim", "resources")
PAGE, PICTURE = ROOT / "docs" / "structure.md", ROOT / "docs" / "structure.svg"
WIDTH, BOX, GAP, LETTER = 960, 24, 6, 7  # px
IMPORT = re.compile(r"^\s*from rotemina\.([\w.]+) import (\([^)]*\)|[^\n]*)", re.MULTILINE)
BEGIN = "<!-- rooms: written by .ci/structure.py -->\n"


def sources(layer: str) -> list[Path]:
    """Return the modules of a layer."""
    return sorted((ROOT / layer).rglob("*.py"))


def room_of(module: str) -> str:
    """Return the room of a module: the package below its layer, or the layer itself."""
    return "/".join(module.split("/")[:2]) if module.count("/") > 1 else module.split("/")[0]


def imports() -> dict[str, set[str]]:
    """Return the modules that each module imports, wherever in it, as paths without ``.py``."""
    found = {}
    for layer in LAYERS:
        for path in sources(layer):
            of = found.setdefault(path.relative_to(ROOT).with_suffix("").as_posix(), set())
            for package, names in IMPORT.findall(path.read_text("utf-8")):
                base = package.replace(".", "/")
                for name in re.findall(r"\w+(?= as )|(?<! as )\b\w+", names):
                    of.add(f"{base}/{name}" if (ROOT / base / f"{name}.py").exists() else base)
    return {module: others & found.keys() for module, others in found.items()}


def rooms(modules: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return the rooms of its own layer that each room imports."""
    found: dict[str, set[str]] = defaultdict(set)
    for module, others in modules.items():
        room = room_of(module)
        near = {room_of(other) for other in others if other.split("/")[0] == room.split("/")[0]}
        found[room] |= near - {room}
    return found


def reach_of(below: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return all that each can be led to by what it imports."""

    def followed(start: str) -> set[str]:
        seen: set[str] = set()
        ahead = list(below[start])
        while ahead:
            if (one := ahead.pop()) not in seen:
                seen.add(one)
                ahead += below.get(one, ())
        return seen

    return {one: followed(one) for one in below}


def cycles() -> list[list[str]]:
    """Return the modules that import each other by any way round, those of a cycle together."""
    reach = reach_of(imports())
    found = {
        tuple(sorted(other for other in ahead if one in reach[other]))
        for one, ahead in reach.items()
        if one in ahead
    }
    return [list(one) for one in sorted(found)]


def heights(below: dict[str, set[str]]) -> dict[str, int]:
    """Return how many rooms stand below each at most; rooms that import each other stand level."""
    loose = set(LAYERS)
    reach = reach_of({room: others - loose for room, others in below.items()})

    def height(room: str) -> int:
        under = [other for other in reach[room] if room not in reach[other]]
        return 1 + max(map(height, under), default=0)

    return {room: 0 if room in loose else height(room) for room in reach}


def drawn(height: dict[str, int]) -> str:
    """Return the picture: a band for each layer, in which a room imports only what is below it."""
    parts, y = [], GAP
    for layer in LAYERS:
        rooms = [room for room in height if room.split("/")[0] == layer]
        top, y = y, y + BOX
        for level in sorted({height[room] for room in rooms}, reverse=True):
            x = 2 * GAP
            for room in sorted(room for room in rooms if height[room] == level):
                text = room.split("/")[1] if "/" in room else f"{layer}/*.py"
                width = LETTER * len(text) + 14
                if x + width > WIDTH - 2 * GAP:
                    x, y = 2 * GAP, y + BOX + GAP
                parts.append(
                    f'<rect x="{x}" y="{y}" width="{width}" height="{BOX}" rx="4" '
                    'fill="#fff" stroke="#789"/>'
                    f'<text x="{x + 7}" y="{y + 16}">{escape(text)}</text>'
                )
                x += width + GAP
            y += BOX + GAP
        parts.insert(
            0,
            f'<rect x="{GAP}" y="{top}" width="{WIDTH - 2 * GAP}" height="{y - top}" '
            'fill="#eef1f4"/>',
        )
        parts.append(f'<text x="{2 * GAP}" y="{top + 16}" font-weight="bold">{layer}</text>')
        y += GAP
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y}" width="{WIDTH}" '
        f'height="{y}" font-family="monospace" font-size="12">\n' + "\n".join(parts) + "\n</svg>\n"
    )


def table() -> str:
    """Return each package with the sentence that its ``__init__`` begins with."""
    rows = ["| room | content |", "|---|---|"]
    for layer in LAYERS:
        for path in sources(layer):
            if path.name == "__init__.py":
                text = ast.get_docstring(ast.parse(path.read_text("utf-8"))) or ""
                rows.append(f"| `{path.parent.relative_to(ROOT)}/` | {text.splitlines()[0]} |")
    return "\n".join(rows) + "\n"


def sizes(kinds: tuple[type[ast.AST], ...]) -> Iterator[int]:
    """Yield the lines of each function or class outside the tests."""
    for layer in LAYERS:
        for path in sources(layer):
            for node in ast.walk(ast.parse(path.read_text("utf-8"))):
                if isinstance(node, kinds):
                    yield node.end_lineno - node.lineno + 1


def measures() -> Iterator[str]:
    """Yield what is measured, a line each."""
    files = {
        folder: [len(path.read_text("utf-8").splitlines()) for path in sources(folder)]
        for folder in (*LAYERS, "tests")
    }
    for folder, lines in files.items():
        yield f"{folder:10}{sum(lines):8} lines {len(lines):5} files"
    inside = [lines for folder, each in files.items() if folder != "tests" for lines in each]
    yield f"{'together':10}{sum(inside):8} lines {len(inside):5} files, without tests"
    for name, found in (
        ("file", inside),
        ("function", list(sizes((ast.FunctionDef, ast.AsyncFunctionDef)))),
        ("class", list(sizes((ast.ClassDef,)))),
    ):
        high = quantiles(found, n=20)[-1]
        yield f"{name:10}{median(found):8.0f} lines median {high:5.0f} 95th percentile"
    excused = sum(
        len(re.findall(r"noqa:[^\n]*C901", path.read_text("utf-8")))
        for layer in LAYERS
        for path in sources(layer)
    )
    yield f"{len(cycles())} import cycles"
    yield f"{excused} functions of a cyclomatic complexity above 10 (ruff refuses others)"


if __name__ == "__main__":
    if "--page" in sys.argv:
        PICTURE.write_text(drawn(heights(rooms(imports()))), "utf-8")
        head, _, _ = PAGE.read_text("utf-8").partition(BEGIN)
        PAGE.write_text(head + BEGIN + "\n" + table(), "utf-8")
    print(*measures(), sep="\n")
