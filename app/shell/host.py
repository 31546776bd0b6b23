"""Panels found and made; one that fails is named and left out."""

import logging
from collections.abc import Mapping

from rotemina.app.panel import Panel
from rotemina.app.shell.workbench import Workbench
from rotemina.drivers.registry import discover

logger = logging.getLogger(__name__)

GROUP = "rotemina.panels"


def make_panels(workbench: Workbench) -> tuple[dict[str, Panel], Mapping[str, str]]:
    """Make every panel of the entry-point group.

    Returns
    -------
    panels : name -> panel, in the order in which they want to stand
    broken : name -> why the panel was left out
    """
    found = discover(GROUP, Panel)
    panels: dict[str, Panel] = {}
    broken = dict(found.broken)
    for name, kind in sorted(found.found.items(), key=lambda item: (item[1].order, item[0])):
        try:
            panels[name] = kind(workbench)
        except (Exception, SystemExit) as error:  # whatever it raises, the window opens without it
            logger.exception("panel %s cannot be made", name)
            broken[name] = f"{type(error).__name__}: {error}"
    return panels, broken
