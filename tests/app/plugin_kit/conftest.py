"""Packages of others, as an installation leaves them: modules and their entry points."""

from importlib.metadata import entry_points
from textwrap import dedent

import pytest

from rotemina.app.plugin_kit.plugin_kinds import Kind
from rotemina.drivers import registry
from rotemina.sim import plugin_points
from rotemina.sim.effects import registry as effects
from rotemina.sim.plugin_import import import_fault


@pytest.fixture
def kept_in(tmp_path):
    """Where it is remembered which imports were tried."""
    return tmp_path / "cache" / "plugin_imports.json"


@pytest.fixture
def install(tmp_path, monkeypatch, kept_in):
    """Install a package: the text of its module, and the names that each kind of plugin has.

    Of our own panels one alone is there, or each test would import them all.
    """

    def some(group):
        ours = entry_points(group=group)
        own_panel = group == Kind.PANEL.group
        return [one for one in ours if not own_panel or one.name in ("plots", "others")]

    monkeypatch.setattr(registry, "entry_points", some)

    def tried(point):
        return import_fault(point, limit_s=1.0, kept_in=kept_in)

    monkeypatch.setattr(plugin_points, "import_fault", tried)
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(str(site))

    def install(module, text, version="1.0", **plugins):
        (site / f"{module}.py").write_text(dedent(text), "utf-8")
        about = site / f"{module}-{version}.dist-info"
        about.mkdir()
        (about / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {module}\nVersion: {version}\n"
        )
        lines = []
        for kind, points in plugins.items():
            lines += [f"[{Kind(kind).group}]", *(f"{n} = {v}" for n, v in points.items())]
        (about / "entry_points.txt").write_text("\n".join(lines) + "\n")
        monkeypatch.syspath_prepend(str(site))  # forgets what was looked up before
        forget()
        return site / f"{module}.py"

    def forget():
        effects._points.cache_clear()
        effects.effect_named.cache_clear()

    yield install
    monkeypatch.undo()
    forget()
