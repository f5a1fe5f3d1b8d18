"""Ours against the print, number by number, of tables that print many."""
from matplotlib.lines import Line2D

import numpy as np

from .. import style, words
from ..reading_reproduce import AGREES, Reproduction, number
from . import Picture

order = 205
LEAST = 10  # printed numbers that make a picture
CAPTION = "Each point is one printed number. On the line ours equals the print; those that rounding does not explain are in red."


def pictures(results):
    if not isinstance(results, Reproduction):
        return
    for place in results.places:
        if len(place.printed()) >= LEAST:
            yield _picture(place)


def _picture(place):
    items = place.printed()
    ours, printed = np.array([number(item["ours"]) for item in items]), np.array([number(item["print"]) for item in items])
    good = np.array([item["verdict"] == AGREES for item in items])
    fig = style.figure(7.4, 4.4)
    ax = fig.subplots()
    limits = [0.8 * min(ours.min(), printed.min()), 1.25 * max(ours.max(), printed.max())]
    ax.plot(limits, limits, color=style.MUTED, lw=0.8)
    ax.plot(printed[good], ours[good], "o", ms=4.5, color=style.BLUE, mec="white", mew=0.4)
    ax.plot(printed[~good], ours[~good], "o", ms=6, color=style.FAIL, mec="white", mew=0.4)
    ax.set(xscale="log", yscale="log", xlim=limits, ylim=limits, xlabel="print", ylabel=_ours(place))
    style.plain_log(ax.xaxis)
    style.plain_log(ax.yaxis)
    if not good.all():
        ax.legend(handles=[Line2D([], [], marker="o", ls="", color=style.BLUE, label="agrees"), Line2D([], [], marker="o", ls="", color=style.FAIL, label="does not")], frameon=False, loc="upper left")
    finding = f"{'All' if good.all() else good.sum()} {'' if good.all() else 'of '}{len(items)} printed numbers agree within rounding"
    style.headline(fig, finding, f"{words.capitalised(place.what)}.")
    return Picture(f"report_print_{place.id}", fig, finding, CAPTION, place.id)


def _ours(place):
    return "table 5.1" if place.id == "table_4_1" else "ours"
