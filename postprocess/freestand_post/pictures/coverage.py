"""What the sweep covered: every swept draw alone and in pairs, coloured by the outcome of the sample."""
import numpy as np

from .. import style, words
from ..reading import OUTCOMES, Sweep
from . import Picture

order = 70
LIMIT = 5        # draws shown
POINTS = 3500    # samples shown in a pair
LEFT_OUT = ("motion", "scale")
CAPTION = ("Diagonal: how often each value was drawn, stacked by outcome; below it, pairs of draws, one point a sample. Gaps would be "
           "combinations that were never tried; colour shows where specimens stay, move and overturn.")


def pictures(results):
    if isinstance(results, Sweep):
        names = swept(results)
        if names:
            yield _picture(results, names)


def swept(sweep, limit=LIMIT):
    """Draws that vary, those that separate the outcomes best first; all of them for limit None."""
    varied = [name for name, values in sweep.draws.items() if name not in LEFT_OUT and np.isfinite(values).mean() > 0.2
              and np.nanstd(values) > 1e-12 * max(1e-300, np.nanmax(np.abs(values)))]
    distinct = []
    for name in varied:  # the same draw under two names (mu_s = mu_k) is shown once
        if not any(np.array_equal(sweep.draws[name], sweep.draws[other], equal_nan=True) for other in distinct):
            distinct.append(name)
    return sorted(distinct, key=lambda name: (-separation(sweep, name), name))[:limit]


def separation(sweep, name):
    """How well a draw alone tells the outcomes apart: |2 AUC - 1|, overturned against the rest, else moved against at rest."""
    values, good = sweep.draws[name], np.isfinite(sweep.draws[name])
    event = sweep.outcome == (2 if (sweep.outcome == 2).any() else 1)
    yes, no = values[good & event], np.sort(values[good & ~event])
    if yes.size == 0 or no.size == 0:
        return 0.0
    rank = 0.5 * (np.searchsorted(no, yes, "left") + np.searchsorted(no, yes, "right"))
    return abs(2 * rank.mean() / no.size - 1)


def _picture(sweep, names):
    count = len(names)
    side = 1.62 if count > 2 else 2.4
    fig = style.figure(max(0.7 + side * count, 5.0), 1.0 + side * count)
    axes = fig.subplots(count, count, squeeze=False, sharex="col")
    order = np.random.default_rng(1).permutation(sweep.outcome.size)[:POINTS]
    for row in range(count):
        for column in range(count):
            ax = axes[row, column]
            if column > row:
                ax.set_axis_off()
            elif column == row:
                _marginal(ax, sweep, names[row])
            else:
                _pair(ax, sweep, names[column], names[row], order)
            if row == count - 1:
                ax.set_xlabel(words.column(names[column]), size=8.5)
            if column == 0 and row > 0:
                ax.set_ylabel(words.column(names[row]), size=8.5)
            elif column < row:
                ax.tick_params(labelleft=False)
    fig.align_labels()
    finding = _finding(sweep, names)
    shown = f"{words.count(order.size)} of {words.plural(sweep.outcome.size, 'sample')} shown" if order.size < sweep.outcome.size else \
        f"all {words.plural(sweep.outcome.size, 'sample')} shown"
    style.headline(fig, finding, f"Draws of the sweep, one by one and in pairs; {shown}.")
    _key(axes, sweep, count)
    return Picture("coverage", fig, finding, CAPTION, "sweep")


def _marginal(ax, sweep, name):
    values = sweep.draws[name]
    good = np.isfinite(values)
    edges = np.histogram_bin_edges(values[good], bins=24)
    stack = [values[good & (sweep.outcome == code)] for code in range(len(OUTCOMES))]
    ax.hist(stack, bins=edges, stacked=True, histtype="stepfilled", color=[style.OUTCOME[name] for name in OUTCOMES], lw=0)
    ax.set_yticks([])
    ax.spines["left"].set_visible(False)
    ax.set_xlim(edges[0], edges[-1])


def _pair(ax, sweep, x, y, order):
    colours = np.array([style.OUTCOME[name] for name in OUTCOMES], dtype=object)
    ax.scatter(sweep.draws[x][order], sweep.draws[y][order], c=list(colours[sweep.outcome[order]]), s=2.2, lw=0, alpha=0.7, rasterized=True)
    values = sweep.draws[y][np.isfinite(sweep.draws[y])]
    ax.set_ylim(values.min(), values.max())


def _key(axes, sweep, count):
    """Names of the outcomes in their colours, in the empty upper corner (or over a single panel)."""
    ax = axes[0, count - 1] if count > 1 else axes[0, 0]
    present = [(code, name) for code, name in enumerate(OUTCOMES) if (sweep.outcome == code).any()]
    for line, (code, name) in enumerate(present):
        share = (sweep.outcome == code).mean()
        text = "< 0.1 %" if share < 0.001 else f"{100 * share:.1f} %"
        ax.text(1.0, 0.98 - 0.16 * line, f"{words.OUTCOMES[name]}  {text}", color=style.OUTCOME[name], weight="bold", size=9, ha="right",
                va="top", transform=ax.transAxes)


def _finding(sweep, names):
    best = separation(sweep, names[0])
    what = "overturns" if (sweep.outcome == 2).any() else "moves"
    if best < 0.1:
        return f"No single draw decides who {what}"
    runner = f", then by {words.short_column(names[1])}" if len(names) > 1 and separation(sweep, names[1]) > 0.1 else ""
    return f"Which specimen {what} is decided most by {words.short_column(names[0])}{runner}"
