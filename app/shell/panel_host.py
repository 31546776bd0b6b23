"""Panels found, and each made when it is first wanted; one that fails is named and left out."""

import logging
from collections.abc import Callable, Iterator, Mapping, MutableMapping

from rotemina.app.panel import Panel, make_panel
from rotemina.app.shell.language import add_texts_of
from rotemina.app.shell.panel_declarations import Declarations, DeclaredPanel, PanelKind
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.registry import discover

logger = logging.getLogger(__name__)

GROUP = "rotemina.panels"
_OWN = "rotemina"  # whose texts are in use already


class Panels(MutableMapping[str, Panel]):
    """All panels by name, in the order in which they want to stand.

    To look one up makes it, if that was not done before; its name alone, its class or the question
    whether there is one of that name does not.

    Parameters
    ----------
    workbench : Workbench
    kinds : dict of str to PanelKind

    Attributes
    ----------
    kinds : dict of str to PanelKind
        Of all, whether they are made or not. One that is not may not be loaded either.
    made : dict of str to Panel
        Those that are made.
    placed : callable
        Is told name and panel when one is made.
    failed : callable
        Is told name and reason when one cannot be made; it is in no mapping any more then.
    """

    def __init__(self, workbench: Workbench, kinds: Mapping[str, PanelKind]) -> None:
        self._workbench = workbench
        self.kinds = dict(kinds)
        self.made: dict[str, Panel] = {}
        self._under_way: set[str] = set()
        self._unplaced: list[str] = []
        self.placed: Callable[[str, Panel], object] = lambda name, panel: None
        self.failed: Callable[[str, str], object] = lambda name, reason: None

    def make(self, name: str) -> Panel | None:
        """Return a panel, made if need be; None if there is none of that name, or it fails."""
        if name in self.waiting:
            self._make(name)
        self._place(name)
        return self.made.get(name)

    def make_step(self, first: str = "") -> bool:
        """Do one step towards making all, ``first`` before others; return whether there is more.

        To make a panel and to put it into its place each take long enough for a step of their own.
        """
        if self._unplaced:
            self._place(self._unplaced[0])
        elif self.waiting:
            self._make(first if first in self.waiting else self.waiting[0])
        return bool(self._unplaced or self.waiting)

    def _make(self, name: str) -> None:
        self._under_way.add(name)
        try:
            kind = self.kinds[name]
            if isinstance(kind, DeclaredPanel):
                kind = self.kinds[name] = kind.load()
            self.made[name] = make_panel(kind, self._workbench)
        except BaseException as error:  # whatever it raises, the window goes on
            logger.exception("panel %s cannot be made", name)
            del self.kinds[name]
            self.failed(name, f"{type(error).__name__}: {error}")
        else:
            self._unplaced.append(name)
        finally:
            self._under_way.discard(name)

    def _place(self, name: str) -> None:
        if name in self._unplaced:
            self._unplaced.remove(name)
            self.placed(name, self.made[name])

    def make_all(self) -> None:
        """Make those that are not made yet."""
        for name in tuple(self.kinds):
            self.make(name)

    @property
    def has_unplaced(self) -> bool:
        """Whether one is made that is not in its place yet."""
        return bool(self._unplaced)

    @property
    def waiting(self) -> tuple[str, ...]:
        """Names of those that are not made yet."""
        begun = self.made.keys() | self._under_way
        return tuple(name for name in self.kinds if name not in begun)

    @property
    def modules_to_load(self) -> tuple[str, ...]:
        """Modules of panels that are not loaded yet."""
        kinds = self.kinds.values()
        return tuple(kind.point.module for kind in kinds if isinstance(kind, DeclaredPanel))

    @property
    def making(self) -> bool:
        """Whether one is just being made."""
        return bool(self._under_way)

    def __getitem__(self, name: str) -> Panel:
        panel = self.make(name)
        if panel is None:
            raise KeyError(name)
        return panel

    def __setitem__(self, name: str, panel: Panel) -> None:
        self.kinds[name], self.made[name] = type(panel), panel

    def __delitem__(self, name: str) -> None:
        del self.kinds[name]
        self.made.pop(name, None)

    def __contains__(self, name: object) -> bool:
        return name in self.kinds

    def __iter__(self) -> Iterator[str]:
        return iter(tuple(self.kinds))

    def __len__(self) -> int:
        return len(self.kinds)


def find_panels(workbench: Workbench) -> tuple[Panels, Mapping[str, str]]:
    """Find every panel of the entry-point group.

    Returns
    -------
    panels : Panels
    broken : name -> why the panel was left out
    """
    declarations = Declarations(workbench.settings)
    found = discover(GROUP, Panel, declarations.known)
    declarations.keep(found.found)
    packages = {kind.__module__.partition(".")[0] for kind in found.found.values()}
    for package in sorted(packages - {_OWN}):
        add_texts_of(package)
    order = sorted(found.found.items(), key=lambda item: (item[1].order, item[0]))
    return Panels(workbench, dict(order)), found.broken
