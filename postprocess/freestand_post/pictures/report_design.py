"""The design example: the chance of a slip beyond capacity over intensity, by each line, and what the print reads off."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 231
LINES = (("slow_pull", "slow pull", style.VERMILION), ("best_fit", "best fit", style.BLUE), ("rare_motions", "2 % motions", style.GREEN))
IM = 1.8
CAPTION = "Probability that Δ exceeds 2, by equation 5.33 with the printed slopes. Cross: what the report reads off a picture of its surface."


def pictures(results):
    rows = results.table("design_example") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 3.8)
    ax = fig.subplots()
    ends, at = [], {}
    for name, text, colour in LINES:
        mine = [row for row in rows if row["series"] == name]
        im, p = column(mine, "im"), column(mine, "probability")
        ax.plot(im, p, color=colour)
        at[name] = float(np.interp(IM, im, p))
        ax.plot([IM], [at[name]], "o", ms=6, color=colour, mec="white", mew=0.6)
        ends.append((p[-1], text, colour))
    printed = results.place("design_example").print("slow_pull")
    ax.plot([IM], [printed], "x", ms=8, mew=2, color=style.INK)
    ax.annotate(f"print: {words.number(printed, 1)}", (IM, printed), xytext=(9, -3), textcoords="offset points", weight="bold", path_effects=style.halo())
    ax.axvline(IM, color=style.MUTED, lw=0.8, ls=":")
    ax.set(xlim=(0, 4.6), ylim=(0, 1), xlabel="IM = PTA/(μ g) − 1", ylabel="P(Δ > 2)")
    style.grid(ax)
    style.end_labels(ax, ends, 4, 0.07, 0.08)
    finding = f"At IM = 1.8 the chance is {words.probability(at['best_fit'])} by the best fit and {words.probability(at['slow_pull'])} by the slow pull; the print reads {words.number(printed, 1)}"
    style.headline(fig, finding)
    yield Picture("report_design", fig, finding, CAPTION, "design_example")
