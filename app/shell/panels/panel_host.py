"""All installed panels. A panel is created when it is first needed; one that fails is left out."""

import logging
from collections.abc import Callable, Hashable, Iterator, Mapping, MutableMapping

from rotemina.app.language import add_package_texts
from rotemina.app.panel import Panel, make_panel
from rotemina.app.shell.panels.panel_declarations import DeclaredPanel, PanelDeclarations, PanelKind
from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import discover_plugins

logger = logging.getLogger(__name__)

ENTRY_POINT_GROUP = "rotemina.panels"
# The translations of this package are loaded already.
_OWN_PACKAGE = "rotemina"


def make_panel_subject(name: str) -> Hashable:
    """Return the identity of notices about a panel's faults."""
    return "panel", name


class PanelCollection(MutableMapping[str, Panel]):
    """All panels by name, in the order in which they are arranged.

    Looking up a panel creates it if necessary. Iterating over the names, looking at ``kinds`` and
    testing whether a name exists do not create panels.

    Parameters
    ----------
    workbench : Workbench
    kinds : dict of str to PanelKind

    Attributes
    ----------
    kinds : dict of str to PanelKind
        The classes of all panels, created or not; a placeholder if the module is not loaded yet.
    made : dict of str to Panel
        The panels that exist so far.
    placed : callable
        Called with the name and the panel when a new panel is ready to be placed.
    failed : callable
        Called with the name and the reason when a panel cannot be created. The panel is then no
        longer listed.
    """

    def __init__(self, workbench: Workbench, kinds: Mapping[str, PanelKind]) -> None:
        self._workbench = workbench
        self.panel_types = dict(kinds)
        self.made: dict[str, Panel] = {}
        self._in_progress: set[str] = set()
        self._unplaced: list[str] = []
        self.on_ready_to_place: Callable[[str, Panel], object] = lambda name, panel: None
        self.on_failed: Callable[[str, str], object] = lambda name, reason: None

    def make(self, name: str) -> Panel | None:
        """Return a panel, created if needed; None if there is no such panel or it fails."""
        if name in self.pending_names:
            self._make(name)
        self._place(name)
        return self.made.get(name)

    def make_step(self, preferred: str = "") -> bool:
        """Do one step towards creating all panels; return whether there is more to do.

        The panel ``preferred`` is created before the others. Creating a panel and placing it are
        separate steps, because each takes noticeable time.
        """
        if self._unplaced:
            self._place(self._unplaced[0])
        elif self.pending_names:
            self._make(preferred if preferred in self.pending_names else self.pending_names[0])
        return bool(self._unplaced or self.pending_names)

    def _make(self, name: str) -> None:
        self._in_progress.add(name)
        try:
            panel_type = self.panel_types[name]
            if isinstance(panel_type, DeclaredPanel):
                panel_type = self.panel_types[name] = panel_type.load()
            self.made[name] = make_panel(panel_type, self._workbench)
        # The panel may be a plugin; none of its errors may end the program.
        except BaseException as error:
            logger.exception("panel %s cannot be made", name)
            del self.panel_types[name]
            self.on_failed(name, f"{type(error).__name__}: {error}")
        else:
            self._unplaced.append(name)
        finally:
            self._in_progress.discard(name)

    def _place(self, name: str) -> None:
        if name in self._unplaced:
            self._unplaced.remove(name)
            self.on_ready_to_place(name, self.made[name])

    def make_all(self) -> None:
        """Create all panels that do not exist yet."""
        for name in tuple(self.panel_types):
            self.make(name)

    @property
    def has_unplaced(self) -> bool:
        """Whether a panel exists but is not placed yet."""
        return bool(self._unplaced)

    @property
    def pending_names(self) -> tuple[str, ...]:
        """Names of the panels that do not exist yet."""
        started = self.made.keys() | self._in_progress
        return tuple(name for name in self.panel_types if name not in started)

    @property
    def modules_to_load(self) -> tuple[str, ...]:
        """Names of the panel modules that are not loaded yet."""
        declared_panels = (
            kind for kind in self.panel_types.values() if isinstance(kind, DeclaredPanel)
        )
        return tuple(declared.point.module for declared in declared_panels)

    @property
    def is_making(self) -> bool:
        """Whether a panel is being created at the moment."""
        return bool(self._in_progress)

    def __getitem__(self, name: str) -> Panel:
        panel = self.make(name)
        if panel is None:
            raise KeyError(name)
        return panel

    def __setitem__(self, name: str, panel: Panel) -> None:
        self.panel_types[name], self.made[name] = type(panel), panel

    def __delitem__(self, name: str) -> None:
        del self.panel_types[name]
        self.made.pop(name, None)

    def __contains__(self, name: object) -> bool:
        return name in self.panel_types

    def __iter__(self) -> Iterator[str]:
        return iter(tuple(self.panel_types))

    def __len__(self) -> int:
        return len(self.panel_types)


def find_panels(workbench: Workbench) -> tuple[PanelCollection, Mapping[str, str]]:
    """Find every panel of the entry-point group.

    Returns
    -------
    panels : PanelCollection
    broken : mapping of str to str
        Names of panels that were left out, with the reasons.
    """
    declarations = PanelDeclarations(workbench.settings)
    discovery = discover_plugins(ENTRY_POINT_GROUP, Panel, declarations.find_declaration)
    declarations.save(discovery.plugins)
    packages = {kind.__module__.partition(".")[0] for kind in discovery.plugins.values()}
    for package in sorted(packages - {_OWN_PACKAGE}):
        add_package_texts(package)
    order = sorted(discovery.plugins.items(), key=lambda item: (item[1].order, item[0]))
    return PanelCollection(workbench, dict(order)), discovery.problems
