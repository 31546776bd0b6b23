"""Print size measures of the source, and draw its structure: `python .ci/structure.py [--page]`.

With ``--page``, it also writes docs/structure.svg and the table in docs/structure.md. Both show the
areas of the source: groups of folders, declared in ``AREAS``. The program ends with a message if a
folder belongs to no area or to several.
"""

import ast
import re
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Iterator, Mapping
from fnmatch import fnmatchcase
from functools import cache
from html import escape
from pathlib import Path
from statistics import median, quantiles
from textwrap import wrap

ROOT = Path(__file__).parents[1]
LAYERS = ("plugins", "app", "drivers", "sim", "resources")
PAGE, PICTURE = ROOT / "docs" / "structure.md", ROOT / "docs" / "structure.svg"
# Width of the picture, height of a line of text, gap between boxes, and width of a letter, px.
WIDTH, LINE, GAP, LETTER = 960, 17, 6, 7.3
# Letters of a line in a box that is as wide as the picture.
MAX_LETTERS = int((WIDTH - 4 * GAP - 16) / LETTER)
IMPORT = re.compile(r"^\s*from rotemina\.([\w.]+) import (\([^)]*\)|[^\n]*)", re.MULTILINE)
BEGIN = "<!-- areas: written by .ci/structure.py -->\n"
# Area: its content and its folders. ``/*`` stands for all subfolders. Write the areas of a layer
# next to each other, in the order of the page.
AREAS = {
    "Panels": (
        "The panels of the window, one folder each.",
        "plugins plugins/*",
    ),
    "Command line": (
        "The command `rotemina` and its subcommands.",
        "app app/cli app/cli/*",
    ),
    "Tools for plugin authors": (
        "Templates of `rotemina plugin new`, checks, and a test bench for panels.",
        "app/plugin_kit",
    ),
    "Start": (
        "Start of the window, checks of this computer, and the watchdog that notices when the "
        "program hangs.",
        "app/shell/startup app/system app/watchdog",
    ),
    "Window": (
        "The main window with its menus, layouts, notices, help, log and file dialogs.",
        "app/shell app/shell/window app/shell/panels app/shell/notices app/shell/records "
        "app/shell/help app/shell/support",
    ),
    "Workbench": (
        "What panels build on: their base class; machine, plan and run that they share; background "
        "work; the loop that executes an operator's actions.",
        "app/workbench app/panel app/operation",
    ),
    "Widgets": (
        "Buttons, fields, plots, tables, layouts and colours, for window and panels.",
        "app/widgets app/widgets/*",
    ),
    "Microscope": (
        "Cameras in use, click-to-move, autofocus, z-stacks and tip tracking.",
        "app/microscope app/cameras",
    ),
    "Runs and records": (
        "Playing trajectories, cell penetration and sensor calibration; recording and replay of "
        "sessions; the library of records.",
        "app/motion/playback app/motion/penetration app/calibration app/motion/recording "
        "app/records",
    ),
    "Operator input": (
        "From a joystick to motion: mapping, calibration of devices, modes and scaling.",
        "app/motion/inputs app/motion/teleoperation",
    ),
    "Motion": (
        "The session, through which everything moves the machine: checks, limits, stops, the "
        "state, and the worker that calls the driver.",
        "app/motion app/motion/session app/motion/device app/motion/limits app/motion/model "
        "app/motion/state",
    ),
    "Tests of the diagnosis": (
        "Benchmark and blind self-test of the gap diagnosis.",
        "app/bench app/blind",
    ),
    "3-D scene": (
        "The robot in three dimensions, in the window and in browsers.",
        "app/scene",
    ),
    "Language and settings": (
        "Translation, units and numbers on the screen; preferences, and files that operators edit.",
        "app/language app/settings app/errors",
    ),
    "Simulator and virtual boards": (
        "The built-in simulator, and boards that exist only as programs.",
        "drivers/simulator drivers/virtual_board",
    ),
    "Boards and stages": (
        "Drivers of MC68HC11 boards and of GRBL stages, their protocols, and serial lines.",
        "drivers/mc68hc11 drivers/mc68hc11/* drivers/gcode drivers/serial_lines",
    ),
    "Cameras": (
        "The camera contract, and the built-in cameras.",
        "drivers/cameras",
    ),
    "Input devices": (
        "The contract of joysticks, gamepads and keys, and their sources.",
        "drivers/inputs",
    ),
    "Driver contract": (
        "Base class of drivers, abilities, errors, the gate that a stop closes, and conformance "
        "checks.",
        "drivers drivers/contract drivers/abilities drivers/conformance",
    ),
    "Gap diagnosis": (
        "Where a machine deviates from its model, and which effects cause it.",
        "sim/gap sim/gap/*",
    ),
    "Comparison and identification": (
        "Records compared with the model; frequency responses and fitted models; calibration of "
        "sensors.",
        "sim/comparison sim/identification sim/calibration",
    ),
    "Blind test cases": (
        "Two generators of machines with known causes, independent of the effects.",
        "sim/blind sim/blind_second",
    ),
    "Controllers": (
        "Inverse models against hysteresis, control loops and their tuning, input shaping.",
        "sim/compensate sim/feedback sim/tuning sim/shaping",
    ),
    "Microscope pictures": (
        "Simulated pictures, and measurements in pictures.",
        "sim/microscope sim/vision",
    ),
    "Geometry and mechanics": (
        "Kinematics of the tip, and the finite element model of the holding plate.",
        "sim/kinematics sim/plate",
    ),
    "Trajectories": (
        "Checks of trajectories before they are played, and test motions.",
        "sim/trajectory sim/excitation",
    ),
    "Simulation": (
        "The equation of motion, sampled, with its effects; simulated records; vibration modes.",
        "sim/plant sim/simulation sim/modes",
    ),
    "Robots, effects and records": (
        "The description of a machine, the effects that make it imperfect, its commands and "
        "measurements, and the files of all these.",
        "sim/robot sim/robot_files sim/effects sim/records",
    ),
    "Foundations": (
        "Messages and errors, units, files, arrays, loading of plugins, and former names.",
        "sim sim/messages sim/errors sim/units sim/files sim/arrays sim/plugin_points"
        " sim/compatibility",
    ),
    "Resources": (
        "Robot files, translations, icons, templates and other data that are shipped.",
        "resources resources/*",
    ),
}


def sources(layer: str) -> list[Path]:
    """Return the modules of a layer."""
    return sorted((ROOT / layer).rglob("*.py"))


def find_folders() -> list[str]:
    """Return all packages, as paths below the root."""
    return [
        path.parent.relative_to(ROOT).as_posix()
        for layer in LAYERS
        for path in sources(layer)
        if path.name == "__init__.py"
    ]


@cache
def areas() -> Mapping[str, str]:
    """Return the area of each folder.

    Raises
    ------
    SystemExit
        If a folder belongs to no area or to several, or if an area names no folder.
    """
    found, problems = {}, []
    all_folders = find_folders()
    for folder in all_folders:
        names = [
            name
            for name, (_, patterns) in AREAS.items()
            if any(fnmatchcase(folder, pattern) for pattern in patterns.split())
        ]
        found[folder] = names[0] if names else ""
        if len(names) != 1:
            problems.append(f"{folder}/ belongs to {' and '.join(names) or 'no area'}")
    problems += [
        f"{pattern} of {name} is no folder"
        for name, (_, patterns) in AREAS.items()
        for pattern in patterns.split()
        if not any(fnmatchcase(folder, pattern) for folder in all_folders)
    ]
    if problems:
        raise SystemExit("\n".join(["AREAS in .ci/structure.py:", *problems]))
    return found


def area_of(module: str) -> str:
    """Return the area of a module."""
    return areas()[module.rpartition("/")[0]]


def layer_of(area: str) -> str:
    """Return the layer of an area."""
    return AREAS[area][1].split()[0].split("/")[0]


@cache
def exports(folder: str) -> Mapping[str, str]:
    """Return the module that defines each name in the ``__init__.pyi`` of a folder."""
    stub = ROOT / folder / "__init__.pyi"
    if not stub.exists():
        return {}
    return {
        alias.name: find_module(f"{folder}/{node.module}" if node.module else folder, alias.name)
        for node in ast.parse(stub.read_text("utf-8")).body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def find_module(base: str, name: str) -> str:
    """Return the module that defines a name which is imported from a module or folder."""
    if not (ROOT / base).is_dir():
        return base
    if (ROOT / base / f"{name}.py").exists():
        return f"{base}/{name}"
    if (ROOT / base / name / "__init__.py").exists():
        return f"{base}/{name}/__init__"
    return exports(base).get(name, f"{base}/__init__")


def imports() -> dict[str, set[str]]:
    """Return the modules that each module imports anywhere, as paths without ``.py``.

    A name that a folder exports counts as imported from the module that defines it.
    """
    imported = {}
    for layer in LAYERS:
        for path in sources(layer):
            targets = imported.setdefault(path.relative_to(ROOT).with_suffix("").as_posix(), set())
            for package, names in IMPORT.findall(path.read_text("utf-8")):
                base = package.replace(".", "/")
                targets |= {
                    find_module(base, name)
                    for name in re.findall(r"\w+(?= as )|(?<! as )\b\w+", names)
                }
    return {module: others & imported.keys() for module, others in imported.items()}


def area_imports(modules: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return the areas of the same layer that each area imports."""
    imported: dict[str, set[str]] = {area: set() for area in AREAS}
    for module, others in modules.items():
        area = area_of(module)
        neighbours = {area_of(other) for other in others}
        imported[area] |= {
            other for other in neighbours - {area} if layer_of(other) == layer_of(area)
        }
    return imported


def reach_of(below: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return everything that each module or area imports directly or indirectly."""

    def follow_imports(start: str) -> set[str]:
        reached: set[str] = set()
        queue = list(below[start])
        while queue:
            if (name := queue.pop()) not in reached:
                reached.add(name)
                queue += below.get(name, ())
        return reached

    return {name: follow_imports(name) for name in below}


def cycles() -> list[list[str]]:
    """Return the groups of modules that import each other directly or indirectly."""
    reach = reach_of(imports())
    groups = {
        tuple(sorted(other for other in imported if module in reach[other]))
        for module, imported in reach.items()
        if module in imported
    }
    return [list(cycle) for cycle in sorted(groups)]


def heights(below: dict[str, set[str]]) -> dict[str, int]:
    """Return the number of levels below each area; areas that import each other share a level."""
    reach = reach_of(below)

    @cache
    def height(area: str) -> int:
        under = [other for other in reach[area] if area not in reach[other]]
        return 1 + max(map(height, under), default=0)

    return {area: height(area) for area in reach}


def box_lines(area: str) -> list[str]:
    """Return the text in the box of an area: its name, and its folders without their layer."""
    layer = layer_of(area)
    names = []
    for pattern in AREAS[area][1].split():
        if pattern == f"{layer}/*":
            names += [
                folder.removeprefix(f"{layer}/")
                for folder in areas()
                if folder.count("/") == 1 and folder.startswith(f"{layer}/")
            ]
        elif "/" in pattern and not pattern.endswith("/*"):
            names.append(pattern.removeprefix(f"{layer}/"))
    return wrap(f"{area}   {', '.join(names)}", MAX_LETTERS, break_on_hyphens=False)


def box_width(area: str) -> int:
    """Return the width that the text of an area needs, px."""
    return round(LETTER * max(map(len, box_lines(area)))) + 16


def box_height(area: str) -> int:
    """Return the height of the box of an area, px."""
    return LINE * len(box_lines(area)) + 7


def draw_box(area: str, x: int, y: int, width: int) -> str:
    """Return the box of an area (SVG)."""
    first, *others = box_lines(area)
    parts = [
        f'<rect x="{x}" y="{y}" width="{width}" height="{box_height(area)}" rx="4" fill="#fff" '
        'stroke="#789"/>',
        f'<text x="{x + 8}" y="{y + 16}" xml:space="preserve">'
        f'<tspan font-weight="bold">{escape(area)}</tspan>{escape(first.removeprefix(area))}'
        "</text>",
    ]
    parts += [
        f'<text x="{x + 8}" y="{y + 16 + LINE * number}">{escape(text)}</text>'
        for number, text in enumerate(others, 1)
    ]
    return "\n".join(parts)


def rows_of_boxes(layer: str, height: dict[str, int]) -> list[list[str]]:
    """Return the areas of a layer, row by row from the top. The areas of a row have one height."""
    rows = []
    for level in sorted({height[area] for area in AREAS if layer_of(area) == layer}, reverse=True):
        row: list[str] = []
        for area in AREAS:
            if layer_of(area) == layer and height[area] == level:
                if row and sum(box_width(other) + GAP for other in [*row, area]) > WIDTH - 3 * GAP:
                    rows.append(row)
                    row = []
                row.append(area)
        rows.append(row)
    return rows


def draw_row(row: list[str], y: int) -> list[str]:
    """Return the boxes of a row (SVG), which fill its width."""
    free = WIDTH - 4 * GAP - sum(map(box_width, row)) - GAP * (len(row) - 1)
    x, boxes = 2 * GAP, []
    for area in row:
        width = box_width(area) + free // len(row)
        boxes.append(draw_box(area, x, y, width))
        x += width + GAP
    return boxes


def draw_picture(height: dict[str, int]) -> str:
    """Return the picture (SVG): a band for each layer; areas import only areas below them."""
    parts, y = [], GAP
    for layer in LAYERS:
        boxes: list[str] = []
        top = y
        y += LINE + GAP
        for row in rows_of_boxes(layer, height):
            boxes += draw_row(row, y)
            y += max(map(box_height, row)) + GAP
        parts += [
            f'<rect x="{GAP}" y="{top}" width="{WIDTH - 2 * GAP}" height="{y - top}" '
            'fill="#e4e9ee"/>',
            f'<text x="{2 * GAP}" y="{top + 16}" font-weight="bold" fill="#246">{layer}/</text>',
            *boxes,
        ]
        y += GAP
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y}" width="{WIDTH}" '
        f'height="{y}" font-family="monospace" font-size="12">\n' + "\n".join(parts) + "\n</svg>\n"
    )


def table() -> str:
    """Return the tables of the areas, one for each layer, under the layer's first line."""
    parts = []
    for layer in LAYERS:
        text = ast.get_docstring(ast.parse((ROOT / layer / "__init__.py").read_text("utf-8")))
        parts += [f"## {layer}", "", text.splitlines()[0], ""]
        parts += ["| area | content | folders |", "|---|---|---|"]
        for area, (content, _) in AREAS.items():
            if layer_of(area) == layer:
                folders = " ".join(f"`{folder}/`" for folder in sorted_folders(area))
                parts.append(f"| {area} | {content} | {folders} |")
        parts.append("")
    return "\n".join(parts[:-1]) + "\n"


def sorted_folders(area: str) -> list[str]:
    """Return the folders of an area, in the order of its declaration."""
    patterns = AREAS[area][1].split()

    def rank(folder: str) -> int:
        return next(n for n, pattern in enumerate(patterns) if fnmatchcase(folder, pattern))

    return sorted((folder for folder, name in areas().items() if name == area), key=rank)


def sizes(kinds: tuple[type[ast.AST], ...]) -> Iterator[int]:
    """Yield the number of lines of each function or class outside the tests."""
    for layer in LAYERS:
        for path in sources(layer):
            for node in ast.walk(ast.parse(path.read_text("utf-8"))):
                if isinstance(node, kinds):
                    yield node.end_lineno - node.lineno + 1


def measures() -> Iterator[str]:
    """Yield the measures, a line each."""
    files = {
        folder: [len(path.read_text("utf-8").splitlines()) for path in sources(folder)]
        for folder in (*LAYERS, "tests")
    }
    for folder, lines in files.items():
        yield f"{folder:10}{sum(lines):8} lines {len(lines):5} files"
    sizes_of_files = [
        lines for folder, counts in files.items() if folder != "tests" for lines in counts
    ]
    yield f"{'total':10}{sum(sizes_of_files):8} lines {len(sizes_of_files):5} files, without tests"
    for name, counts in (
        ("file", sizes_of_files),
        ("function", list(sizes((ast.FunctionDef, ast.AsyncFunctionDef)))),
        ("class", list(sizes((ast.ClassDef,)))),
    ):
        high = quantiles(counts, n=20)[-1]
        yield f"{name:10}{median(counts):8.0f} lines median {high:5.0f} 95th percentile"
    exempt = sum(
        len(re.findall(r"noqa:[^\n]*C901", path.read_text("utf-8")))
        for layer in LAYERS
        for path in sources(layer)
    )
    yield f"{len(cycles())} import cycles"
    yield f"{exempt} functions with a cyclomatic complexity above 10 (exempt from the limit)"


if __name__ == "__main__":
    parser = ArgumentParser(description=__doc__, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("--page", action="store_true", help="write docs/structure.svg and .md")
    if parser.parse_args().page:
        PICTURE.write_text(draw_picture(heights(area_imports(imports()))), "utf-8")
        head, _, _ = PAGE.read_text("utf-8").partition(BEGIN)
        PAGE.write_text(head + BEGIN + "\n" + table(), "utf-8")
    print(*measures(), sep="\n")
