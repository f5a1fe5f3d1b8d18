"""The fragility surface of a line: probability that a demand is exceeded, over intensity and capacity."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column, named

order = 230
CAPTION = "Colour and contours: probability that Δ exceeds the capacity, by the lognormal whose mean and standard deviation grow with IM (equation 5.33)."


def pictures(results):
    if not isinstance(results, Reproduction):
        return
    for place in results.places:
        rows = results.table(f"{place.id}_surface")
        if rows:
            yield _picture(place, rows)


def _picture(place, rows):
    im, capacity = np.unique(column(rows, "im")), np.unique(column(rows, "capacity"))
    probability = column(rows, "probability").reshape(im.size, capacity.size).T
    fig = style.figure(7.4, 4.2)
    ax = fig.subplots()
    colours = ax.contourf(im, capacity, probability, levels=np.linspace(0, 1, 21), cmap=style.PROBABILITY)
    lines = ax.contour(im, capacity, probability, levels=[0.05, 0.2, 0.5, 0.8], colors=[style.INK, style.INK, "white", "white"], linewidths=0.9)
    ax.clabel(lines, fmt=lambda value: f"{value:g}", fontsize=8.5)
    fig.colorbar(colours, ax=ax, label="P(Δ > capacity)", ticks=[0, 0.2, 0.4, 0.6, 0.8, 1])
    ax.set(xlabel="IM = PTA/(μ g) − 1", ylabel="capacity Δ")
    at = im[im.size // 2]
    half = float(np.interp(-0.5, -probability[:, im.size // 2], capacity))
    finding = f"At IM = {words.plain(at)} half of the cases exceed Δ = {words.number(half)}, one in twenty {words.number(float(np.interp(-0.05, -probability[:, im.size // 2], capacity)))}"
    style.headline(fig, finding, f"{words.capitalised(named(place))}.")
    return Picture(f"report_surface_{place.id}", fig, finding, CAPTION, place.id)
