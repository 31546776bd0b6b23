from .camera_check import (
    check_cameras as check_cameras,
)
from .checking import (
    check_plugin as check_plugin,
)
from .input_check import (
    check_inputs as check_inputs,
)
from .panel_bench import (
    open_panel_bench as open_panel_bench,
)
from .panel_check import (
    check_panel as check_panel,
)
from .plugin_kinds import (
    PluginKind as PluginKind,
    find_entry_points as find_entry_points,
    load_installed_plugins as load_installed_plugins,
)
from .writing import (
    write_plugin as write_plugin,
)
