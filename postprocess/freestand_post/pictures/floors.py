"""Peak floor acceleration over the height of the building, of the storeys on which the study puts equipment."""
import numpy as np

from .. import style, words
from ..reading import Sweep
from . import Picture

order = 75
CAPTION = ("Each point is one record: the largest acceleration of that floor over that of the ground under the building, which is elastic, so "
           "that no scale changes it. Line: medians over the records, 1 at the ground, drawn straight between the storeys of the study; band: between the 16th and the "
           "84th of a hundred.")


def pictures(results):
    if isinstance(results, Sweep) and results.amplification:
        yield _picture(results.amplification)


def _picture(amplification):
    storeys = sorted(amplification)
    quantiles = np.array([[1.0] * 3] + [np.quantile(amplification[storey], (0.16, 0.5, 0.84)) for storey in storeys])
    heights = np.array([0] + storeys)
    fig = style.figure(7.4, 3.9)
    ax = fig.subplots()
    if max(values.size for values in amplification.values()) > 1:
        ax.fill_betweenx(heights, quantiles[:, 0], quantiles[:, 2], color=style.BLUE, alpha=0.15, lw=0)
    for storey in storeys:
        ax.plot(amplification[storey], np.full(amplification[storey].size, storey), "o", ms=3.5, color=style.BLUE, alpha=0.4, mew=0)
    ax.plot(quantiles[:, 1], heights, "-o", ms=5, color=style.INK, mec="white", mew=0.6)
    ax.axvline(1, color=style.MUTED, lw=0.8, ls=(0, (1, 2)))
    ax.set(xlabel="peak floor acceleration over peak ground acceleration", ylabel="floors above the ground", yticks=heights,
           xlim=(0, 1.05 * max(1.0, max(values.max() for values in amplification.values()))))
    style.grid(ax, "x")
    top, median = storeys[-1], quantiles[-1, 1]
    finding = f"On storey {top} the floor shakes {words.number(median)} times as hard as the ground"
    n = amplification[top].size
    style.headline(fig, finding, f"Median over {words.plural(n, 'record')}, from {words.number(amplification[top].min())} to "
                                 f"{words.number(amplification[top].max())} times.")
    return Picture("floors", fig, finding, CAPTION, "sweep")
