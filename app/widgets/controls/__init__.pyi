from .changing_button import (
    ChangingButton as ChangingButton,
)
from .controls import (
    enable_unless as enable_unless,
    format_shortcut as format_shortcut,
    get_disabled_reason as get_disabled_reason,
    make_button as make_button,
    make_tooltip as make_tooltip,
    name_widget as name_widget,
    set_bar_value as set_bar_value,
    set_property as set_property,
    show_tooltip as show_tooltip,
)
from .tab_dots import (
    TabDots as TabDots,
    TabNews as TabNews,
)
from .wheel_safe import (
    WheelSafeComboBox as WheelSafeComboBox,
    WheelSafeSlider as WheelSafeSlider,
    WheelSafeSpinBox as WheelSafeSpinBox,
)
