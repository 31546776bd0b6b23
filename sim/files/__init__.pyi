from .input_files import (
    open_file as open_file,
    parse_json as parse_json,
    parse_toml as parse_toml,
    read_bytes as read_bytes,
    read_text as read_text,
)
from .whole_files import (
    replace_file as replace_file,
)
