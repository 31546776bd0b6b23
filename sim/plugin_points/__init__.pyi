from .loading import (
    API_VERSIONS as API_VERSIONS,
    load_plugin as load_plugin,
    require_version as require_version,
)
from .trial_import import (
    find_import_fault as find_import_fault,
)
