from .language import (
    DECIMAL_SIGNS as DECIMAL_SIGNS,
    ENGLISH as ENGLISH,
    load_wording as load_wording,
)
from .options import (
    CHOOSE_MODEL_ADVICE as CHOOSE_MODEL_ADVICE,
    add_columns as add_columns,
    add_max_speed as add_max_speed,
    add_robot as add_robot,
    check_output_files as check_output_files,
    find_json_file as find_json_file,
    find_robot_file as find_robot_file,
    is_same_file as is_same_file,
    load_robot_with_effects as load_robot_with_effects,
    load_selected_robot as load_selected_robot,
    print_message as print_message,
    print_model as print_model,
    print_written_file as print_written_file,
    read_records_of_model as read_records_of_model,
    require_speed_limits as require_speed_limits,
    with_max_speeds as with_max_speeds,
)
from .progress import (
    TerminalProgressLine as TerminalProgressLine,
)
from .termination import (
    interrupt_on_signals as interrupt_on_signals,
    watch_termination as watch_termination,
)
from .translated_help import (
    HELP_CONTEXT as HELP_CONTEXT,
    parse_language_option as parse_language_option,
    translate_argparse as translate_argparse,
    translate_parser as translate_parser,
)
from .workers import (
    add_workers as add_workers,
    prepare_workers as prepare_workers,
)
