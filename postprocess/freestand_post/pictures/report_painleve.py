"""Friction at which slide-rock has no unique motion, over slenderness."""
from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 245
CAPTION = "Line: friction at which the matrix is singular while a block of that slenderness lifts off. The report says that it never is."


def pictures(results):
    rows = results.table("painleve") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 3.6)
    ax = fig.subplots()
    curve = [row for row in rows if row["series"] == "any block"]
    ax.plot(column(curve, "alpha_rad"), column(curve, "friction"), color=style.BLUE)
    for i, row in enumerate(row for row in rows if row["series"] != "any block"):
        ax.plot([row["alpha_rad"]], [row["friction"]], "o", ms=6, color=style.VERMILION, mec="white")
        label = (0.34 + 0.02 * i, 2.6 - 0.32 * i)
        ax.plot([row["alpha_rad"], label[0]], [row["friction"], label[1]], color=style.VERMILION, lw=0.7)
        ax.text(*label, f" {row['series']}", va="center", weight="bold", color=style.VERMILION)
    ax.set(xlabel="slenderness α (rad)", ylabel="friction coefficient", ylim=(1.2, 3.6))
    style.grid(ax)
    place = results.place("painleve")
    finding = (f"The mass matrix of slide-rock is singular from a friction of {words.number(place.value('least'), 3)} on, and at "
               f"{words.number(place.value('FORMA'), 3)} for the FORMA")
    style.headline(fig, finding)
    yield Picture("report_painleve", fig, finding, CAPTION, "painleve")
