"""One design over several intensities: a panel each, with overturning and the main demand above two capacities."""
import numpy as np

from .. import style, words
from ..designs import shown_median
from ..model import chosen_capacities
from ..over_intensities import Intensities
from . import Picture

order = 6
BESIDE = 3  # panels in a row
CAPTION = ("Lines and bands: lognormal curves fitted over all intensities with {level} bands from resampled motions (dashed where one misses the "
           "counted shares by more than it may); points: share counted in each bin.")


def pictures(results):
    if isinstance(results, Intensities) and any(_curves(sweep) for sweep in results.sweeps):
        yield _picture(results)


def _curves(sweep):
    """[(label, colour, curve)]"""
    found = []
    if sweep.overturning and np.isfinite(sweep.overturning["probability"]).any():
        found.append(("overturned", style.VERMILION, sweep.overturning))
    for edp in [edp for edp in sweep.continuous() if edp.functions][:1]:
        for k, colour in zip(chosen_capacities(edp, 2), (style.BLUE, style.GREEN)):
            found.append((f"{edp.label} > {words.chosen(edp.capacity[k], edp.unit)}", colour, edp.functions[k]))
    return found


def _picture(found):
    beside = min(len(found.sweeps), BESIDE)
    rows = -(-len(found.sweeps) // beside)
    fig = style.figure(8.8 if beside > 1 else 7.4, 0.9 + 3.3 * rows)
    axes = fig.subplots(rows, beside, sharey=True, squeeze=False)
    for ax in axes.flat[len(found.sweeps):]:
        ax.set_visible(False)
    for ax, sweep in zip(axes.flat, found.sweeps):
        for label, colour, curve in _curves(sweep):
            if np.isfinite(curve["probability"]).any():
                ax.fill_between(curve["grid"], curve["lower"], curve["upper"], color=colour, alpha=0.14, lw=0)
                ax.plot(curve["grid"], curve["probability"], color=colour, lw=1.8, ls="-" if curve["adequate"] else "--", label=label,
                        zorder=3 if label == "overturned" else 2)
            else:
                ax.plot([], [], color=colour, label=label)
            ax.plot(curve["im"], curve["counted"], "o", ms=3.6, color=colour, mec="white", mew=0.5)
        ax.set(ylim=(0, 1.015), xlim=sweep.view, xlabel=words.with_unit(sweep.im_symbol, sweep.im_unit))
        style.grid(ax)
    for ax in axes[:, 0]:
        ax.set_ylabel("probability")
    style.legend_above(axes[0], ncol=3)
    finding = _finding(found)
    style.headline(fig, finding, f"The same samples in each panel. Bands: {found.level}.")
    return Picture("over_intensities", fig, finding, CAPTION.format(level=found.level), "sweep")


def _at(symbol, median):
    """"PGA = 0.4 g", "PGA > 2 g"."""
    return f"{symbol}\u00a0" + (median.replace(" ", "\u00a0", 1) if median[0] in "<>" else f"=\u00a0{median}")


def _finding(found):
    for what, curves in found.events:
        if all(curve["median"] > 0 for curve in curves):
            holds = [curve["adequate"] for curve in curves]
            by = "By the fitted curves" if all(holds) else "By the fitted curves, or the counted shares where these do not hold" if any(holds) else \
                "By the counted shares"
            at = [_at(sweep.im_symbol, shown_median(sweep, curve)) for sweep, curve in zip(found.sweeps, curves)]
            return f"{by}, half exceed “{what}” at {words.listing(at)}" if what != "overturning" else \
                f"{by}, half of the specimens overturn at {words.listing(at)}"
    return "Too few samples exceed for a curve over each of these intensities"
