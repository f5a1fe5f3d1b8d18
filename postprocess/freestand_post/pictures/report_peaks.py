"""Measured peaks over intensity: points, the line through the origin with one standard deviation to either side, and bins."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture

order = 210
LINES = {"best_fit": "friction that fits the histories best", "slow_pull": "friction of the slow pulls", "rare_motions": "motions of 2 % in 50 years"}
CAPTION = ("Points: one test each. Line: least squares through the origin; dashed: one standard deviation to either side, which grows with IM too. Squares: means of bins "
           "of equal count, bars: their standard deviations.")


def pictures(results):
    if not isinstance(results, Reproduction):
        return
    for place in results.places:
        points = results.table(f"{place.id}_points")
        if points:
            yield _picture(results, place, points)


def column(rows, name):
    return np.array([row[name] for row in rows], float)


def named(place):
    return LINES.get(place.id, place.what)


def _picture(found, place, points):
    line, bins = found.table(f"{place.id}_line"), found.table(f"{place.id}_bins")
    fig = style.figure(7.4, 4.2)
    ax = fig.subplots()
    im = column(line, "im")
    ax.fill_between(im, column(line, "mean_less_sigma"), column(line, "mean_plus_sigma"), color=style.BLUE, alpha=0.1, lw=0)
    ax.plot(im, column(line, "mean"), color=style.BLUE)
    for side in ("mean_less_sigma", "mean_plus_sigma"):
        ax.plot(im, column(line, side), color=style.BLUE, lw=1, ls="--")
    ax.plot(column(points, "im"), column(points, "delta"), "o", ms=4.5, color=style.INK, mec="white", mew=0.5)
    ax.errorbar(column(bins, "im"), column(bins, "mean"), yerr=column(bins, "standard_deviation"), fmt="s", ms=6, color=style.VERMILION, mec="white", mew=0.6, elinewidth=1.2, capsize=3)
    ax.set(xlim=(0, im[-1] * 1.16), ylim=(0, max(1.1 * column(points, "delta").max(), column(line, "mean")[-1] * 1.2)), xlabel="IM = PTA/(μ g) − 1", ylabel="Δ = U ω²/PTA")
    style.grid(ax)
    slope, sd, r2 = place.value("slope"), place.value("sd_slope"), place.value("r2")
    top = ax.get_ylim()[1]
    style.end_labels(ax, [(entry, text, style.BLUE) for entry, text in ((column(line, "mean")[-1], "mean"), (column(line, "mean_plus_sigma")[-1], "+σ"), (column(line, "mean_less_sigma")[-1], "−σ")) if entry < top],
                     im[-1], 0.06 * top, 0.02 * im[-1], 0.98 * top)
    finding = f"Δ grows as {words.number(slope, 3)} IM, its standard deviation as {words.number(sd, 2)} IM"
    style.headline(fig, finding, f"{words.capitalised(named(place))}; {words.plural(len(points), 'test')}, r² {words.number(r2, 3)}"
                   + (f", standard error of the slope {words.number(place.value('slope_se'))} (motions left out in turn)." if np.isfinite(place.value("slope_se")) else "."))
    return Picture(f"report_peaks_{place.id}", fig, finding, CAPTION, place.id)
