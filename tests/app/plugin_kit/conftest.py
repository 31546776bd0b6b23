"""Third-party packages as they are after an installation: modules with entry points."""

from importlib.metadata import entry_points
from textwrap import dedent

import pytest

from rotemina.app.plugin_kit import PluginKind
from rotemina.drivers.contract import registry
from rotemina.sim.effects import registry as effect_registry
from rotemina.sim.plugin_points import find_import_fault, loading as plugin_points

# Tests of a plugin, which run in the environment where it is installed.
collect_ignore = ["last_release"]


@pytest.fixture
def import_cache(tmp_path):
    """File with the results of trial imports."""
    return tmp_path / "cache" / "plugin_imports.json"


@pytest.fixture
def install(tmp_path, monkeypatch, import_cache):
    """Function that installs a package with one module and its entry points.

    Only one of the program's panels is available. Otherwise each test would import all of them.
    """

    def find_reduced_entry_points(group):
        points = entry_points(group=group)
        is_panel_group = group == PluginKind.PANEL.group
        return [
            point for point in points if not is_panel_group or point.name in ("plots", "others")
        ]

    monkeypatch.setattr(registry, "entry_points", find_reduced_entry_points)

    def find_fault_quickly(point):
        return find_import_fault(point, limit_s=1.0, cache_file=import_cache)

    monkeypatch.setattr(plugin_points, "find_import_fault", find_fault_quickly)
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(str(site))

    def install(module, text, version="1.0", **plugins):
        (site / f"{module}.py").write_text(dedent(text), "utf-8")
        metadata_folder = site / f"{module}-{version}.dist-info"
        metadata_folder.mkdir()
        (metadata_folder / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {module}\nVersion: {version}\n"
        )
        lines = []
        for kind, points in plugins.items():
            lines += [
                f"[{PluginKind(kind).group}]",
                *(f"{name} = {target}" for name, target in points.items()),
            ]
        (metadata_folder / "entry_points.txt").write_text("\n".join(lines) + "\n")
        # This call also clears the caches of the import system.
        monkeypatch.syspath_prepend(str(site))
        clear_caches()
        return site / f"{module}.py"

    def clear_caches():
        effect_registry._find_entry_points.cache_clear()
        effect_registry.load_effect.cache_clear()

    yield install
    monkeypatch.undo()
    clear_caches()
