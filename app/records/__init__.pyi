from . import run_report as run_report
from .database import (
    RecordStore as RecordStore,
)
from .entry import (
    LibraryEntry as LibraryEntry,
    RecordKind as RecordKind,
    WorstGap as WorstGap,
    search_entries as search_entries,
)
from .file_facts import (
    parse_time as parse_time,
)
from .library import (
    RecordCatalogue as RecordCatalogue,
    find_worst_gap as find_worst_gap,
    read_commands as read_commands,
    read_entry as read_entry,
)
from .recorded_events import (
    EventSeverity as EventSeverity,
    TimelineEvent as TimelineEvent,
    make_timeline_events as make_timeline_events,
)
from .run_report import (
    RunReport as RunReport,
    render_report as render_report,
)
