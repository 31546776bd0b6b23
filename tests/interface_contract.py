"""A contract of ``lint-imports``: code outside a folder imports from the folder itself."""

import ast
from functools import cache
from pathlib import Path

from importlinter import Contract, ContractCheck, fields, output

ROOT = Path(__file__).parents[1]


class InterfaceContract(Contract):
    """Every import of a module from outside its folder breaks the contract.

    A folder's ``__init__.pyi`` lists what it exports; that can be a module, too. A folder that
    exports nothing is private to the folder that contains it.
    """

    type_name = "interface"

    packages = fields.ListField(subfield=fields.StringField())

    def check(self, graph, verbose):
        """Return the imports that pass by an interface."""
        folders = {module.rpartition(".")[0] for module in graph.modules}
        problems = []
        for imported in sorted(graph.modules - folders):
            folder, _, name = imported.rpartition(".")
            if not imported.startswith(tuple(f"{package}." for package in self.packages)):
                continue
            problems += [
                (importer, imported)
                for importer in sorted(graph.find_modules_that_directly_import(imported))
                if folder not in (importer, importer.rpartition(".")[0])
                and name not in read_exported_modules(folder)
            ]
        return ContractCheck(kept=not problems, metadata={"problems": problems})

    def render_broken_contract(self, check):
        """Print each import."""
        for importer, imported in check.metadata["problems"]:
            output.print_error(f"{importer} imports {imported}, not its folder", bold=False)


@cache
def read_exported_modules(folder):
    """Return the modules that a folder exports as such."""
    stub = ROOT.joinpath(*folder.split(".")[1:], "__init__.pyi")
    if not stub.exists():
        return frozenset()
    return frozenset(
        alias.name
        for node in ast.parse(stub.read_text("utf-8")).body
        if isinstance(node, ast.ImportFrom) and node.module is None
        for alias in node.names
    )
