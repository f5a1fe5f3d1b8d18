"""How far FORMA lifts an edge on legs that give way, over their frequency, beside the uplift that was measured."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 215
MEASURED = 0.489
CAPTION = ("Each point is one motion of the tests of FORMA, as the pulse that stands for it, and one damping of its legs. Line: the uplift that was measured. On rigid edges, far to the right, "
           "the block lifts none with the friction that fits histories.")


def pictures(results):
    rows = results.table("uplift_on_legs") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 3.7)
    kinds = list(dict.fromkeys(row["friction"] for row in rows))
    for ax, kind in zip(fig.subplots(1, len(kinds), sharey=True), kinds):
        mine = [row for row in rows if row["friction"] == kind]
        ax.plot(column(mine, "frequency_hz"), column(mine, "uplift"), "o", ms=4.5, color=style.BLUE, mec="white", mew=0.3)
        ax.axhline(MEASURED, color=style.VERMILION, lw=1.4)
        ax.annotate(f"measured: {MEASURED}", (15, MEASURED), xytext=(0, 4), textcoords="offset points", ha="right", color=style.VERMILION, weight="bold", path_effects=style.halo())
        ax.set_title(kind, weight="bold")
        ax.set(xscale="log", xticks=[2, 3, 5, 10, 15], xticklabels=["2", "3", "5", "10", "15"], xlabel="frequency up and down on the legs (Hz)")
        ax.minorticks_off()
        style.grid(ax)
    fig.axes[0].set(ylabel="largest rotation / α", ylim=(0, None))
    fits = [row for row in rows if row["friction"] == kinds[0]]
    most = int(np.argmax(column(fits, "uplift")))
    finding = (f"On legs of {column(fits, 'frequency_hz')[most]:g} Hz FORMA lifts an edge by up to {words.number(column(fits, 'uplift')[most], 2)} of its slenderness; on rigid edges by none")
    style.headline(fig, finding)
    yield Picture("report_uplift", fig, finding, CAPTION, "uplift_on_legs")
