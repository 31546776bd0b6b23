"""Count the numbers that decide in the diagnosis: ``python .ci/deciding_numbers.py [--list]``.

A deciding number is a numeric literal other than 0 or 1, or a constant in capitals, in a comparison
with ``<``, ``<=``, ``>`` or ``>=`` anywhere in ``sim/gap``. Uses of one constant count once, and so
do equal comparisons with a literal in one function. Each numeric field of ``sim/gap/policy.py``
counts as well, if there is such a file.
"""

import argparse
import ast
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
ORDERINGS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)


def find_numbers(path: Path) -> Iterator[str]:
    """Yield each deciding number of a file: the constant, or the function and its comparison."""
    tree = ast.parse(path.read_text("utf-8"))
    place = path.relative_to(ROOT).as_posix()
    imported = {
        alias.asname or alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    for function, comparison in _find_comparisons(tree, "module"):
        for node in ast.walk(comparison):
            if isinstance(node, ast.Name | ast.Attribute):
                name = node.id if isinstance(node, ast.Name) else node.attr
                bare = name.lstrip("_")
                if bare.isupper() and len(bare) > 1:
                    # An imported constant is the same one wherever it is used.
                    yield name if name in imported else f"{place}: {name}"
            elif (
                isinstance(node, ast.Constant)
                and isinstance(node.value, int | float)
                and not isinstance(node.value, bool)
                and node.value not in (0, 1)
            ):
                yield f"{place}: {function}: {ast.unparse(comparison)}: {node.value}"


def _find_comparisons(node: ast.AST, function: str) -> Iterator[tuple[str, ast.Compare]]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Compare) and any(isinstance(op, ORDERINGS) for op in child.ops):
            yield function, child
        is_function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef)
        yield from _find_comparisons(child, child.name if is_function else function)


def find_policy_fields(path: Path) -> Iterator[str]:
    """Yield the numeric fields of the policy object."""
    if not path.is_file():
        return
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.AnnAssign) and ast.unparse(node.annotation) in ("int", "float"):
            yield f"policy: {ast.unparse(node.target)}"


def count_numbers(folder: Path) -> Counter[str]:
    """Return the deciding numbers below a folder, each with its number of uses.

    A constant that one file defines and others import is one number.
    """
    uses: Counter[str] = Counter()
    for path in sorted(folder.rglob("*.py")):
        uses.update(find_numbers(path))
    imported = {name for name in uses if ": " not in name}
    for name in [name for name in uses if name.rpartition(": ")[2] in imported and ": " in name]:
        if name.count(": ") == 1:
            uses[name.rpartition(": ")[2]] += uses.pop(name)
    uses.update(find_policy_fields(folder / "policy.py"))
    return uses


def main() -> int:
    """Print the count, and with ``--list`` each number with its uses."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--list", action="store_true", help="print each number and its uses")
    options = parser.parse_args()
    uses = count_numbers(ROOT / "sim" / "gap")
    if options.list:
        for name, number in sorted(uses.items()):
            print(f"{number:4} {name}")
    by_folder = Counter(
        name.split("/")[2] if name.startswith("sim/gap/") else "shared" for name in uses
    )
    for folder, number in sorted(by_folder.items()):
        print(f"{number:4} {folder}")
    print(f"{len(uses):4} deciding numbers")
    return 0


if __name__ == "__main__":
    sys.exit(main())
