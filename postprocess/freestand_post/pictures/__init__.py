"""One file per picture. Each module has `order` (place on the page) and `pictures(results)`, which yields Picture values;
`results` is a Sweep, a History or a Validation, and a module yields nothing for what it does not draw."""
import importlib
import pkgutil
from dataclasses import dataclass

from matplotlib.figure import Figure


@dataclass
class Picture:
    name: str        # file name without ending
    figure: Figure
    finding: str     # one sentence, the title
    caption: str     # how to read it
    section: str     # of the page: sweep | history, and of a validation: ladder | ranking | recovered | worst | where | peaks ...
    edp: str = ""    # of which demand parameter, if of one


def modules():
    found = [importlib.import_module(f"{__name__}.{entry.name}") for entry in pkgutil.iter_modules(__path__)]
    return sorted(found, key=lambda module: (module.order, module.__name__))


def draw(results):
    """All pictures of a Sweep, a History or a Validation, in the order of the page."""
    return [picture for module in modules() for picture in module.pictures(results)]
