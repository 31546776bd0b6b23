from .calibration_playback import (
    CalibrationPlayback as CalibrationPlayback,
    CalibrationPlaybackPhase as CalibrationPlaybackPhase,
    CalibrationPlaybackState as CalibrationPlaybackState,
)
from .files import (
    CALIBRATION_FORMAT as CALIBRATION_FORMAT,
    CalibrationFile as CalibrationFile,
    SourceRecord as SourceRecord,
    make_calibration_file as make_calibration_file,
    make_source_record as make_source_record,
)
from .health import (
    FigureComparison as FigureComparison,
    compare_cards as compare_cards,
    compute_health_figures as compute_health_figures,
)
from .health_book import (
    HealthBook as HealthBook,
)
from .store import (
    CalibrationStore as CalibrationStore,
    StoredCalibration as StoredCalibration,
)
from .words import (
    format_figure as format_figure,
    format_figure_lines as format_figure_lines,
    format_iso_lines as format_iso_lines,
    format_remark_lines as format_remark_lines,
    format_summary as format_summary,
    make_figure_rows as make_figure_rows,
    make_iso_rows as make_iso_rows,
    to_json as to_json,
)
