from .fields import (
    is_comment as is_comment,
    is_empty as is_empty,
    parse_separator_line as parse_separator_line,
    split_fields as split_fields,
)
from .file_blocks import (
    DEFAULT_LIMITS as DEFAULT_LIMITS,
    FileLimits as FileLimits,
    open_blocks as open_blocks,
)
from .layout import (
    check_axis_name as check_axis_name,
    find_header_separator as find_header_separator,
    looks_like_header as looks_like_header,
    parse_columns as parse_columns,
    split_headings as split_headings,
)
from .metadata import (
    FileComments as FileComments,
    parse_comment as parse_comment,
)
from .preview import (
    FilePreview as FilePreview,
    read_preview as read_preview,
)
from .reading import (
    read_record as read_record,
)
from .record import (
    REFERENCE_NOISE_KEY as REFERENCE_NOISE_KEY,
    VOLTAGE_TAPS as VOLTAGE_TAPS,
    Record as Record,
    RecordChannel as RecordChannel,
    Tap as Tap,
)
from .record_pieces import (
    PIECE_ROWS as PIECE_ROWS,
    join_records as join_records,
    read_pieces as read_pieces,
)
from .resampling import (
    find_max_speeds as find_max_speeds,
    resample as resample,
)
from .writing import (
    open_export as open_export,
    write_columns as write_columns,
    write_pieces as write_pieces,
    write_record as write_record,
)
