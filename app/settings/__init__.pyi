from .driver_settings import (
    load_settings as load_settings,
    parse_assignments as parse_assignments,
    parse_setting as parse_setting,
    store_settings as store_settings,
)
from .files import (
    FileOpener as FileOpener,
    format_json as format_json,
    make_plain_name as make_plain_name,
    open_new_file as open_new_file,
    write_all as write_all,
    write_text as write_text,
)
from .settings import (
    LANGUAGE_KEY as LANGUAGE_KEY,
    UserSettings as UserSettings,
)
from .toml_file import (
    FORBID_EXTRA_KEYS as FORBID_EXTRA_KEYS,
    NonEmptyText as NonEmptyText,
    StrictBool as StrictBool,
    TomlFormat as TomlFormat,
)
