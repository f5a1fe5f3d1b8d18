"""Dimensionless slip of a sliding block under each pulse, beside the lines through the measured peaks."""
from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 207
COLOURS = {"A": style.BLUE, "B": style.VERMILION, "C1": style.GREEN, "C2": style.PURPLE, "rectangular": style.GREY}
CAPTION = ("Computed: a block that slides on Coulomb friction, under pulses of any period and amplitude. Dashed: the lines through the report's measured peaks. Newmark's rectangular pulse, "
           "Δ = 2π² IM, leaves the picture at once: its floor keeps the velocity that it reached.")


def pictures(results):
    rows = results.table("sliding_pulses") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 4.2)
    ax = fig.subplots()
    ends, rectangular = [], []
    for kind in dict.fromkeys(row["series"] for row in rows):
        mine = [row for row in rows if row["series"] == kind]
        ax.plot(column(mine, "im"), column(mine, "delta"), color=COLOURS[kind])
        if kind != "rectangular":
            ends.append((column(mine, "delta")[-1], kind, COLOURS[kind]))
        else:
            rectangular = mine
    top = 1.25 * max(end[0] for end in ends)
    for name, text in (("best_fit", "best fit"), ("slow_pull", "slow pull")):
        place = results.place(name)
        if place:
            ax.plot([0, 7], [0, 7 * place.value("slope")], color=style.INK, lw=1.1, ls="--")
            if 7 * place.value("slope") < top:
                ends.append((7 * place.value("slope"), text, style.INK))
            else:  # leaves the picture above
                ax.annotate(text, (0.93 * top / place.value("slope"), 0.93 * top), xytext=(-6, 0), textcoords="offset points", ha="right", va="center", weight="bold", color=style.INK, size=8.6)
    for row in rectangular[:1]:
        ax.annotate("rectangular", (row["im"], min(row["delta"], 0.9 * top)), xytext=(7, 0), textcoords="offset points", va="center", weight="bold", color=style.GREY, size=8.6)
    ax.set(xlim=(0, 7.9), ylim=(0, top), xlabel="IM = PTA/(μ g) − 1", ylabel="Δ = U ω²/PTA")
    style.grid(ax)
    style.end_labels(ax, ends, 7, 0.06 * top, 0.14, 0.98 * top)
    finding = "Under a pulse the slip levels off with intensity; the lines through measured peaks go on growing"
    style.headline(fig, finding, "One curve for each type of pulse, whatever its period and the friction.")
    yield Picture("report_sliding", fig, words.capitalised(finding), CAPTION, "sliding_pulses")
