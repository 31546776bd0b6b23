"""Former names of modules: each can be imported for one more release, with a warning."""

import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from rotemina.sim.compatibility.former_names import warn_of_former_name

_PREFIX = "rotemina."


class FormerModuleFinder(MetaPathFinder, Loader):
    """Finder that imports a module under its former name."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the specification of a former module, or None if there was no such module."""
        is_former = fullname.startswith(_PREFIX) and fullname in read_former_modules()
        return ModuleSpec(fullname, self) if is_former else None

    def exec_module(self, module: ModuleType) -> None:
        """Put the current module in the place of the former one."""
        current = read_former_modules()[module.__name__]
        # The folder exports the names that others need.
        warn_of_former_name(module.__name__, current.rpartition(".")[0])
        # The import system returns what it finds here after this call.
        sys.modules[module.__name__] = import_module(current)


def serve_former_modules() -> None:
    """Make former modules importable; further calls have no effect."""
    if not any(isinstance(finder, FormerModuleFinder) for finder in sys.meta_path):
        sys.meta_path.append(FormerModuleFinder())


@cache
def read_former_modules() -> Mapping[str, str]:
    """Return the current name of each module that has a former name."""
    # Loaded here, because hardly any start of the program needs them.
    import csv
    from importlib import resources

    table = resources.files(__package__).joinpath("former_modules.csv").read_text("utf-8")
    return {row["old"]: row["new"] for row in csv.DictReader(table.splitlines())}


def add_names_of_former_module(
    find_export: Callable[[str], Any], module: str
) -> Callable[[str], Any]:
    """Return a ``__getattr__`` for a folder that has the name of a former module.

    Parameters
    ----------
    find_export : callable
        Returns what the folder exports under a name.
    module : str
        The module that has the other names of the former one, and those that it had before.
    """

    def find_name(name: str) -> Any:
        try:
            return find_export(name)
        except AttributeError:
            if name.startswith("_"):
                raise
            return getattr(import_module(module), name)

    return find_name
