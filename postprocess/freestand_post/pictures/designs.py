"""Fragility of several designs in one axis: overturning, and the main demand above two capacities."""
import re

import numpy as np

from .. import style, words
from ..designs import Designs, verdict
from ..model import chosen_capacities
from . import Picture

order = 5
LINE = 110  # letters that have room beside one another over the panels
COLOURS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.ORANGE, style.SKY)
CAPTION = ("Lines and bands: lognormal curves fitted over all intensities with {level} bands from resampled motions (dashed where one misses the "
           "counted shares by more than it may); points: share counted in each bin.")


def pictures(results):
    if isinstance(results, Designs):
        picture = _picture(results)
        if picture:
            yield picture


def panels(designs):
    """(title, [curve of each]) that are drawn."""
    found = []
    if all(sweep.overturning and np.isfinite(sweep.overturning["probability"]).any() for sweep in designs.sweeps):
        found.append(("P(overturned)", [sweep.overturning for sweep in designs.sweeps]))
    for edp in designs.sweeps[0].continuous():
        others = [next((one for one in sweep.continuous() if one.name == edp.name and one.unit == edp.unit), None) for sweep in designs.sweeps]
        if not all(other is not None and other.functions for other in others):
            continue
        for k in chosen_capacities(edp, 3):
            places = [int(np.argmin(np.abs(other.capacity - edp.capacity[k]))) for other in others]
            if all(np.isclose(other.capacity[j], edp.capacity[k]) for other, j in zip(others, places)) and len(found) < 3:
                found.append((f"P({edp.label} > {words.chosen(edp.capacity[k], edp.unit)})", [other.functions[j] for other, j in zip(others, places)]))
        break
    return found


def _picture(designs):
    drawn = panels(designs)
    if not drawn:
        return None
    fig = style.figure(8.8 if len(drawn) > 1 else 7.4, 4.2)
    axes = fig.subplots(1, len(drawn), sharey=True, squeeze=False)[0]
    for ax, (title, curves) in zip(axes, drawn):
        for curve, label, colour in zip(curves, designs.labels, COLOURS * len(designs.labels)):
            if np.isfinite(curve["probability"]).any():
                ax.fill_between(curve["grid"], curve["lower"], curve["upper"], color=colour, alpha=0.14, lw=0)
                ax.plot(curve["grid"], curve["probability"], color=colour, lw=1.8, ls="-" if curve["adequate"] else "--", label=label)
            else:
                ax.plot([], [], color=colour, label=label)
            ax.plot(curve["im"], curve["counted"], "o", ms=3.6, color=colour, mec="white", mew=0.5)
        ax.set_title(title, weight="bold", pad=5)
        ax.set(ylim=(0, 1.015), xlim=_view(designs), xlabel=words.with_unit(designs.im_symbol, designs.sweeps[0].im_unit))
        style.grid(ax)
    axes[0].set_ylabel("probability")
    style.legend_above(axes, ncol=max(1, min(len(designs.labels), 3, LINE // (6 + max(map(len, designs.labels))))))
    finding = _finding(designs)
    level = words.level(designs.level)
    style.headline(fig, finding, ("Each sample has the same motion and draws in every design: differences are of pairs. " if designs.paired
                                  else "The sweeps have other motions: differences are of independent samples. ") + f"Bands: {level}.")
    return Picture(f"designs_{re.sub(r'[^A-Za-z0-9_]', '_', designs.sweeps[0].im_name)}", fig, finding, CAPTION.format(level=level), "designs")


def _view(designs):
    views = [sweep.view for sweep in designs.sweeps]
    return min(view[0] for view in views), max(view[1] for view in views)


def _by_counts(designs, row):
    i = max((i for i, ratio in enumerate(row.ratio) if np.isfinite(ratio[0])), key=lambda i: abs(np.log(row.ratio[i][0])))
    return (f"{words.capitalised(designs.labels[i])} against {designs.labels[0]}: the {designs.im_symbol} at which the counted shares of {row.what} reach "
            f"one half is {row.ratio[i][0]:.2f} times as large")


def _finding(designs):
    """By medians that were swept: of the first row in which that of the first design is, and another one's is or is known to lie beyond."""
    for row in designs.rows:
        if not all(curve["adequate"] for curve in row.curves):
            if any(np.isfinite(value) for value, _, _ in row.ratio):
                return _by_counts(designs, row)
            continue
        beyond = [label for label, curve in zip(designs.labels, row.curves) if curve["extrapolated"]]
        within = [i for i, (ratio, curve) in enumerate(zip(row.ratio, row.curves)) if np.isfinite(ratio[1]) and not curve["extrapolated"]]
        if row.curves[0]["extrapolated"] or not (within or beyond):
            continue
        what = f"the median {designs.im_symbol} of {row.what}"
        if not within:
            first = row.curves[0]
            known = f"; {words.plus_minus(first['median'], first['median_se'])}{words.spaced(designs.sweeps[0].im_unit)} for {designs.labels[0]}"
            return f"{words.capitalised(what)} lies outside of what was swept for {words.listing(beyond)}{known}"
        i = max(within, key=lambda i: abs(np.log(row.ratio[i][0])))
        value, low, high = row.ratio[i]
        against = f"{words.capitalised(designs.labels[i])} against {designs.labels[0]}: {what} "
        rest = f"; of {words.listing(beyond)} it lies outside of what was swept" if beyond else ""
        if verdict(row.ratio[i]) == "no":
            return against + "differs by no more than chance" + rest
        return against + f"is {value:.2f} times as large ({low:.2f} to {high:.2f})" + rest
    return "The medians of these designs cannot be compared: too few samples exceed, or they lie outside of what was swept"
