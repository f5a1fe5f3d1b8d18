"""What the sweep covered: every swept draw alone and in pairs, coloured by the outcome of the sample."""
import zlib

import numpy as np
from scipy import stats

from .. import style, words
from ..reading import OUTCOMES, Sweep
from ..separation import beyond_chance, event, parted, seen, separation
from . import Picture

order = 70
LIMIT = 5        # draws shown
POINTS = 3500    # samples shown in a pair
FEW = 8          # a draw with no more values than these is shown as classes
LEFT_OUT = ("scale",)
CAPTION = ("Diagonal: how often each value was drawn, stacked by outcome; below it, pairs of draws, one point a sample. Gaps would be "
           "combinations that were never tried; colour shows where specimens stay, move and overturn. The title names a draw only where it alone "
           "tells the outcomes apart by more than chance would among all draws (5 % for all of them together).")


def pictures(results):
    if isinstance(results, Sweep):
        names = swept(results, limit=None)
        if names:
            yield _picture(results, names[:LIMIT], _finding(results, names))


def swept(sweep, limit=LIMIT):
    """Draws that vary and do not follow from an earlier one, those that separate the outcomes best first; all for limit None."""
    chosen = []
    for name, values in sweep.draws.items():
        good = values[np.isfinite(values)]
        varies = good.size > 0.2 * values.size and good.max() - good.min() > 1e-12 * np.abs(good).max()
        many = name == "motion" and len(sweep.motions) > FEW
        if varies and not many and name not in LEFT_OUT and not any(_same(values, sweep.draws[other]) for other in chosen):
            chosen.append(name)
    return sorted(chosen, key=lambda name: (-separation(sweep, name).size, name))[:limit]


def _same(values, other):
    """Do the two say nearly the same (as width and slenderness of a block of one height)?"""
    good = np.isfinite(values) & np.isfinite(other)
    return good.sum() > 2 and abs(np.nan_to_num(stats.spearmanr(values[good][:5000], other[good][:5000]).correlation)) > 0.9


def classes(sweep, name):
    """(values, names) of a draw that takes only a few values; None of any other."""
    levels = np.unique(sweep.draws[name][np.isfinite(sweep.draws[name])])
    if levels.size > FEW:
        return None
    motions = name == "motion" and levels[-1] < len(sweep.motions)
    return levels, [sweep.motions[int(level)] if motions else words.plain(level) for level in levels]


class _Draw:
    """One draw as it is shown: classes side by side, spread a little, or plain values."""

    def __init__(self, sweep, name):
        values = sweep.draws[name]
        self.label, self.ticks, self.names = words.column(name), None, None
        found = classes(sweep, name)
        if found:
            levels, self.names = found
            at = np.searchsorted(levels, values).astype(float)
            at[~np.isfinite(values)] = np.nan
            self.exact, self.edges = at, np.arange(levels.size + 1) - 0.5
            self.shown = at + np.random.default_rng(zlib.crc32(name.encode())).uniform(-0.36, 0.36, at.size)
            self.ticks = np.arange(levels.size)
        else:
            self.exact = self.shown = values
            self.edges = np.histogram_bin_edges(values[np.isfinite(values)], bins=24)
        room = 0.02 * (self.edges[-1] - self.edges[0])
        self.limits = (self.edges[0] - room, self.edges[-1] + room)

    def tick(self, axis):
        if self.ticks is not None:
            axis.set_ticks(self.ticks, self.names)
            axis.set_tick_params(length=0)


def _picture(sweep, names, finding):
    count, draws = len(names), [_Draw(sweep, name) for name in names]
    side = 1.62 if count > 2 else 2.4
    fig = style.figure(max(0.7 + side * count, 5.0), 1.0 + side * count)
    axes = fig.subplots(count, count, squeeze=False, sharex="col")
    some = np.random.default_rng(1).permutation(sweep.outcome.size)[:POINTS]
    for row in range(count):
        for column in range(count):
            ax = axes[row, column]
            if column > row:
                ax.set_axis_off()
            elif column == row:
                _marginal(ax, sweep, draws[row])
            else:
                _pair(ax, sweep, draws[column], draws[row], some)
            if row == count - 1:
                draws[column].tick(ax.xaxis)
                ax.set_xlabel(draws[column].label, size=8.5)
            if column == 0 and row > 0:
                ax.set_ylabel(draws[row].label, size=8.5)
            elif column < row:
                ax.tick_params(labelleft=False)
    fig.align_labels()
    shown = (f"{words.count(some.size)} of {words.plural(sweep.kept, 'sample')}{sweep.part} shown" if some.size < sweep.kept else
             f"all {words.plural(sweep.kept, 'sample')}{sweep.part} shown")
    style.headline(fig, finding, f"Draws of the sweep, one by one and in pairs; {shown}.")
    _key(axes, sweep, count)
    return Picture("coverage", fig, finding, CAPTION, "sweep")


def _marginal(ax, sweep, draw):
    stack = [draw.exact[np.isfinite(draw.exact) & (sweep.outcome == code)] for code in range(len(OUTCOMES))]
    ax.hist(stack, bins=draw.edges, stacked=True, histtype="stepfilled", color=[style.OUTCOME[name] for name in OUTCOMES], lw=0)
    ax.set_yticks([])
    ax.spines["left"].set_visible(False)
    ax.set_xlim(*draw.limits)


def _pair(ax, sweep, x, y, some):
    colours = np.array([style.OUTCOME[name] for name in OUTCOMES], dtype=object)
    ax.scatter(x.shown[some], y.shown[some], c=list(colours[sweep.outcome[some]]), s=2.2, lw=0, alpha=0.7, rasterized=True)
    ax.set_ylim(*y.limits)
    y.tick(ax.yaxis)


def _key(axes, sweep, count):
    """Names of the outcomes in their colours, in the empty upper corner (or over a single panel)."""
    ax = axes[0, count - 1] if count > 1 else axes[0, 0]
    present = [(code, name) for code, name in enumerate(OUTCOMES) if (sweep.outcome == code).any()]
    for line, (code, name) in enumerate(present):
        ax.text(1.0, 0.98 - 0.16 * line, f"{words.OUTCOMES[name]}  {words.percent((sweep.outcome == code).mean())}",
                color=style.OUTCOME[name], weight="bold", size=9, ha="right", va="top", transform=ax.transAxes)


def _finding(sweep, names):
    """Which draw decides most, as far as that is known. names: all draws that vary, the largest separation first."""
    what = "overturns" if (sweep.outcome == 2).any() else "moves"
    found = [separation(sweep, name) for name in names]
    known = [beyond_chance(one, len(names)) for one in found]
    if not any(known):
        return _nothing(sweep, what, found)
    top = [i for i, one in enumerate(found) if not parted(found[0], one)]
    named = words.listing(f"the {words.short_column(names[i])}" for i in top if known[i])
    if not named:  # what is largest is not known to be more than chance, and what comes behind it is
        named = f"the {words.short_column(names[known.index(True)])}"
    if not all(known[i] for i in top):
        return f"Which specimen {what} is decided by {named}, perhaps by others as much"
    then = len(top)
    runner = then < len(names) and known[then] and (then + 1 == len(names) or parted(found[then], found[then + 1]))
    return f"Which specimen {what} is decided most by {named}" + (f", then by the {words.short_column(names[then])}" if runner else "")


def _nothing(sweep, what, found):
    """Where no draw is known to decide: because none does, or because too little happened to tell."""
    happened = event(sweep)
    rare = int(min(happened.sum(), (~happened).sum()))
    did, did_not = ("overturned", "did not overturn") if what == "overturns" else ("moved", "did not move")
    of = f" of the {words.plural(sweep.kept, 'sample')}{sweep.part}" if sweep.part else ""
    if rare == 0:
        return f"Every specimen {did}" if happened.any() else f"No specimen {did}"
    if not seen(min(one.error for one in found), len(found)):
        many = f"{words.count(rare)}{of}" if of else words.plural(rare, "specimen")
        return f"{many} {did if rare == happened.sum() else did_not}: too few to tell what decides"
    if not all(seen(one.error, len(found)) for one in found):
        return f"No single draw is known to decide which specimen {what}"
    return f"No single draw decides which specimen {what}"
