"""Peak floor acceleration over the height of each building, of the storeys on which the study puts equipment."""
import numpy as np

from .. import style, words
from ..reading import Sweep
from . import Picture

order = 75
COLOURS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.ORANGE, style.SKY)
CAPTION = ("Each point is one record on a floor of {buildings}: the largest acceleration of that floor over that of the ground under the building, "
           "which is elastic, so that no scale changes it. {line} medians over the records, 1 at the ground, drawn straight between the storeys of "
           "the study; band: between the 16th and the 84th of a hundred.")


def pictures(results):
    if isinstance(results, Sweep) and results.amplification:
        yield _picture(results.amplification)


def _picture(amplification):
    buildings = list(dict.fromkeys(building for building, _ in amplification))
    fig = style.figure(7.4, 3.9)
    ax = fig.subplots()
    for i, building in enumerate(buildings):
        _building(ax, building, _ratios(amplification, building), COLOURS[i % len(COLOURS)], alone=len(buildings) == 1)
    ax.axvline(1, color=style.MUTED, lw=0.8, ls=(0, (1, 2)))
    ax.set(xlabel="peak floor acceleration over peak ground acceleration", ylabel="floors above the ground",
           yticks=sorted({0} | {storey for _, storey in amplification}),
           xlim=(0, 1.05 * max(1.0, max(max(of_records.values()) for of_records in amplification.values()))))
    style.grid(ax, "x")
    if len(buildings) > 1:
        style.legend_above([ax], ncol=min(len(buildings), 4))
    finding = _finding(amplification, buildings)
    style.headline(fig, finding, _spread(amplification, buildings))
    named = words.listing(buildings)
    caption = CAPTION.format(buildings=_called(named) if named == "building" else f"the building {named}" if len(buildings) == 1 else f"one of the buildings {named}",
                             line="Line:" if len(buildings) == 1 else "Lines, one for each building:")
    return Picture("floors", fig, finding, caption, "sweep")


def _ratios(amplification, building):
    """storey -> ratios, the lowest first."""
    return {storey: np.array(list(of_records.values())) for (name, storey), of_records in sorted(amplification.items()) if name == building}


def _building(ax, name, ratios, colour, alone):
    quantiles = np.array([[1.0] * 3] + [np.quantile(values, (0.16, 0.5, 0.84)) for values in ratios.values()])
    heights = np.array([0, *ratios])
    if max(values.size for values in ratios.values()) > 1:
        ax.fill_betweenx(heights, quantiles[:, 0], quantiles[:, 2], color=colour, alpha=0.15, lw=0)
    for storey, values in ratios.items():
        ax.plot(values, np.full(values.size, storey), "o", ms=3.5, color=colour, alpha=0.4, mew=0)
    ax.plot(quantiles[:, 1], heights, "-o", ms=5, color=style.INK if alone else colour, mec="white", mew=0.6, label=name)


def _highest(amplification, building):
    """The highest storey with equipment, and the ratios there."""
    return list(_ratios(amplification, building).items())[-1]


def _finding(amplification, buildings):
    """Of one building its highest storey; of several the one that shakes its highest storey hardest, and the one that does so least."""
    tops = {building: _highest(amplification, building) for building in buildings}
    hardest, least = (pick(buildings, key=lambda building: np.median(tops[building][1])) for pick in (max, min))
    times = {building: words.number(np.median(tops[building][1])) for building in buildings}
    first = f"On storey {tops[hardest][0]} of {_called(hardest)} the floor shakes {times[hardest]} times as hard as the ground"
    return first if hardest == least else f"{first}, on storey {tops[least][0]} of {_called(least)} {times[least]} times"


def _called(building):
    """The name that the study gives; a building without one is called "building" in the file."""
    return "the building" if building == "building" else building


def _spread(amplification, buildings):
    records = {record for of_records in amplification.values() for record in of_records}
    parts = []
    for building in buildings:
        storey, values = _highest(amplification, building)
        own = "" if values.size == len(records) else f" ({words.plural(values.size, 'record')})"
        parts.append(f"from {words.number(values.min())} to {words.number(values.max())} times on storey {storey} of {_called(building)}{own}")
    return f"Medians over {words.plural(len(records), 'record')}; {', '.join(parts)}."
