from .column_mapping import (
    ask_columns as ask_columns,
)
from .file_dialog import (
    ask_file as ask_file,
    ask_files as ask_files,
    ask_save_path as ask_save_path,
)
from .recent_files import (
    RecentFilesMenu as RecentFilesMenu,
)
from .record_chooser import (
    ask_records as ask_records,
)
from .record_table import (
    RecordTable as RecordTable,
)
from .record_words import (
    NAME_COLUMN as NAME_COLUMN,
    NOTE_COLUMN as NOTE_COLUMN,
    describe_file_problem as describe_file_problem,
    format_moment as format_moment,
    format_worst_gap as format_worst_gap,
    make_tooltip_lines as make_tooltip_lines,
)
from .report_files import (
    PAGE_FILTER as PAGE_FILTER,
    RUN_REPORT_LABEL as RUN_REPORT_LABEL,
    RUN_REPORT_TIP as RUN_REPORT_TIP,
    ask_run_report as ask_run_report,
    find_recording as find_recording,
    save_report as save_report,
)
