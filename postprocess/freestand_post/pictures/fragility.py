"""Fragility curves P(EDP > C) against the intensity measure, with bands, the empirical points, and what became of each bin."""
import numpy as np

from .. import style, words
from ..model import chosen_capacities, crossing
from ..reading import REJECTED, TOO_FEW, UNPROVEN, Sweep
from . import Picture

order = 10
CAPTION = ("Lines: probability that {symbol} exceeds C; bands: {level} interval; points: share counted in each bin, hollow where "
           "the lognormal is not known to be adequate and the counted share replaces it. Below: what became of the samples of each bin.")


def pictures(results):
    if isinstance(results, Sweep):
        for edp in results.continuous():
            yield _picture(results, edp)


def _picture(sweep, edp):
    symbol, im = edp.label, sweep.im_symbol
    fig = style.figure(7.4, 5.2)
    top, strip = fig.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [5.2, 1]})
    which = chosen_capacities(edp)
    labels = _curves(top, sweep, edp, which, symbol)
    (low, high), tall = sweep.view, _height(edp, which)
    top.set(ylim=(0, tall), xlim=(low, high), ylabel=f"P({symbol} > C)")
    if tall > 0.5:
        top.axhline(0.5, color=style.MUTED, lw=0.7, ls=(0, (1, 2)), zorder=0)
    style.grid(top)
    _composition(strip, sweep, edp)
    strip.set_xlabel(words.with_unit(im, sweep.im_unit))
    finding = _finding(sweep, edp, which, symbol, im)
    style.headline(fig, finding, _subtitle(sweep, edp))
    if labels:
        style.end_labels(top, labels, high, 0.06 * tall, 0.025 * (high - low), min(tall, 1.0))
    return Picture(f"fragility_{edp.name}", fig, finding, CAPTION.format(symbol=symbol, level=sweep.level), "sweep", edp.name)


def _curves(ax, sweep, edp, which, symbol):
    labels, counts = [], np.isin(edp.bins["status"], (REJECTED, UNPROVEN))
    for k, colour in zip(which, style.series(len(which))):
        p, good = edp.surface["probability"][:, k], np.isfinite(edp.surface["probability"][:, k])
        x = sweep.centre
        ax.fill_between(x, edp.surface["lower"][:, k], edp.surface["upper"][:, k], color=colour, alpha=0.16, lw=0)
        ax.plot(x, p, color=colour)
        counted = edp.surface["empirical"][:, k]
        ax.plot(x[~counts], counted[~counts], "o", ms=4, color=colour, mec="white", mew=0.6)
        ax.plot(x[counts], counted[counts], "o", ms=4.5, mfc="white", mec=colour, mew=1.1)
        if good.any():
            last = np.flatnonzero(good)[-1]
            ax.plot([x[last], sweep.view[1]], [p[last], p[last]], color=colour, lw=0.7, alpha=0.7)
            labels.append((p[last], f"{symbol} > {words.chosen(edp.capacity[k], edp.unit)}", colour))
    if not labels:
        ax.text(0.5, 0.5, "no bin has enough samples", transform=ax.transAxes, ha="center", color=style.MUTED)
    return labels


def _composition(ax, sweep, edp):
    """Shares of still, moved and overturned samples in every bin."""
    n = np.where(edp.bins["n"] > 0, edp.bins["n"], np.nan)
    bottom, last = np.zeros(n.size), None
    entries = []
    for key, column in (("at_rest", "n_still"), ("moved", "n_moved"), ("overturned", "n_over")):
        share = np.nan_to_num(edp.bins[column] / n)
        ax.bar(sweep.edge[:-1], share, np.diff(sweep.edge), bottom=bottom, align="edge", color=style.OUTCOME[key],
               ec="white", lw=0.6, alpha=0.85)
        last = np.flatnonzero(np.isfinite(n))[-1] if np.isfinite(n).any() else None
        if last is not None and (edp.bins[column] > 0).any():
            entries.append((bottom[last] + share[last] / 2, {"at_rest": "still", "moved": "moved, stood"}.get(key, key),
                            style.OUTCOME[key]))
        bottom = bottom + share
    right, width = sweep.view[1], sweep.view[1] - sweep.view[0]
    for (_, text, colour), y in zip(entries, style.spread([entry[0] for entry in entries], 0.38, 0.88, 0.1)):
        ax.text(right + 0.012 * width, y, text, color=colour, size=8.5, va="center", weight="bold")
    ax.set(ylim=(0, 1), yticks=[0, 1], ylabel="share")
    ax.spines["left"].set_visible(False)


def _finding(sweep, edp, which, symbol, im):
    p = edp.surface["probability"][:, which]
    if not np.isfinite(p).any():
        return f"Too few samples for a fragility of {symbol}"
    halves = [crossing(sweep.centre, p[:, k], 0.5) for k in range(len(which))]
    reached = np.flatnonzero(np.isfinite(halves))
    if reached.size:
        k = reached[reached.size // 2]
        return f"Half of the specimens {_beyond(edp, which[k])} once {im} reaches {words.quantity(halves[k], sweep.im_unit)}"
    always = [k for k in range(len(which)) if np.nanmin(p[:, k]) > 0.5]
    if always:
        return f"More than half of the specimens {_beyond(edp, which[always[-1]])} at every intensity shown"
    if np.nanmax(p[:, 0]) == 0:
        return f"No specimens {_beyond(edp, which[0])} in the range swept"
    return f"In the range swept at most {words.percent(np.nanmax(p[:, 0]))} of the specimens {_beyond(edp, which[0])}"


def _beyond(edp, k):
    return words.beyond(edp.name, edp.label, words.chosen(edp.capacity[k], edp.unit)) + (" or overturn" if np.nansum(edp.bins["n_over"]) else "")


def _height(edp, which):
    """Of the probability axis: 1, or what the curves need where they stay low."""
    need = np.nanmax(np.concatenate([edp.surface["upper"][:, which].ravel(), [0.0]]))
    return 1.015 if need > 0.4 or need == 0 else 1.3 * need


def _subtitle(sweep, edp):
    n = edp.bins["n"][edp.bins["status"] != TOO_FEW]
    bins = (f"{words.count(n.min())} to {words.count(n.max())} in a bin" if n.size else "no bin with enough of them")
    study = sweep.summary.get("study_name") or "sweep"
    return (f"{study}: {words.plural(sweep.samples, 'sample')}, {bins}. {words.capitalised(words.demand_meaning(edp.name))}; "
            f"band: {sweep.level} interval.")
