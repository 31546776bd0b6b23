"""Versions of the plugin interfaces: the current and the previous one are accepted."""

import warnings
from importlib.metadata import EntryPoint

import pytest

from rotemina.sim.errors import PluginError
from rotemina.sim.plugin_points import require_version

POINT = EntryPoint("glass", "glass.stage:Stage", "rotemina.drivers")


def test_the_current_version_is_accepted_without_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        require_version(POINT, 4, 4)


def test_the_previous_version_is_accepted_with_a_warning():
    with pytest.warns(DeprecationWarning, match=r"glass\.stage:Stage.*version 3.*api_version to 4"):
        require_version(POINT, 3, 4)


@pytest.mark.parametrize("version", [2, 5, None, "4", 3.5])
def test_any_other_version_is_refused(version):
    with pytest.raises(PluginError, match=f"version {version} of the interface.* has version 4"):
        require_version(POINT, version, 4)
