from . import language as language
from .display_units import (
    choose_axis_scale as choose_axis_scale,
    describe_speed_changes as describe_speed_changes,
    find_noticeable_change as find_noticeable_change,
    format_duration as format_duration,
    format_file_size as format_file_size,
    get_axis_label as get_axis_label,
    group_axes_by_stage as group_axes_by_stage,
    make_step_presets as make_step_presets,
)
from .engine_words import (
    TranslatedWording as TranslatedWording,
    WindowWording as WindowWording,
    describe_error as describe_error,
)
from .language import (
    LANGUAGE_KEY as LANGUAGE_KEY,
    LANGUAGES as LANGUAGES,
    SYSTEM_LANGUAGE as SYSTEM_LANGUAGE,
    FilledText as FilledText,
    add_package_texts as add_package_texts,
    make_error_message as make_error_message,
    make_text_functions as make_text_functions,
    marked as marked,
    translate as translate,
    translate_message as translate_message,
)
