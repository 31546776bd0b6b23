from .former_modules import (
    add_names_of_former_module as add_names_of_former_module,
    serve_former_modules as serve_former_modules,
)
from .former_names import (
    FormerMember as FormerMember,
    adopt_former_methods as adopt_former_methods,
    serve_former_names as serve_former_names,
)
