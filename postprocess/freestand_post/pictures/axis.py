"""The surface P(EDP > C) over intensity and a second axis (friction, slenderness, period ...), beside slices through it."""
import numpy as np

from .. import style, words
from ..reading import Sweep
from . import Picture

order = 30
CAPTION = ("Left: share of samples with {symbol} above C = {capacity}, by intensity (across) and {axis} (up); grey cells hold too "
           "few samples. Right: the same for the lowest, a middle and the highest range, with {level} bands.")


def pictures(results):
    if isinstance(results, Sweep):
        for edp in results.continuous():
            for axis in edp.axes:
                yield _picture(results, edp, axis)


def _capacity(axis):
    """The capacity whose probabilities are nearest to the middle: there the axis shows most."""
    spread = [np.nanmean(np.abs(axis.probability[:, :, k] - 0.5)) if np.isfinite(axis.probability[:, :, k]).any() else 1.0
              for k in range(axis.probability.shape[2])]
    return int(np.argmin(spread))


def _picture(sweep, edp, axis):
    symbol, im = edp.label, sweep.im_symbol
    label, k = words.column(axis.name), _capacity(axis)
    p = axis.probability[:, :, k]
    capacity = words.chosen(edp.capacity[k], edp.unit)
    fig = style.figure(8.6, 4.1)
    left, right = fig.subplots(1, 2, gridspec_kw={"width_ratios": [1.15, 1]})
    left.set_facecolor(style.EMPTY)
    mesh = left.pcolormesh(sweep.edge, axis.edge, p.T, cmap=style.PROBABILITY, vmin=0, vmax=1, ec="white", lw=0.4, rasterized=True)
    left.set(xlim=sweep.view, xlabel=words.with_unit(im, sweep.im_unit), ylabel=label)
    bar = fig.colorbar(mesh, ax=left, pad=0.03, aspect=26)
    bar.set_label(f"P({symbol} > {capacity})")
    bar.outline.set_visible(False)
    _slices(right, sweep, axis, k)
    right.set(ylim=(0, 1.015), xlim=sweep.view, xlabel=words.with_unit(im, sweep.im_unit),
              ylabel=f"P({symbol} > {capacity})")
    style.grid(right)
    finding = _finding(sweep, axis, k, p, symbol, capacity, im)
    style.headline(fig, finding, f"Share of samples with {symbol} > {capacity} over intensity and {label}; grey: too few samples; "
                                 f"band: {sweep.level} interval.")
    text = CAPTION.format(symbol=symbol, capacity=capacity, axis=label, level=sweep.level)
    return Picture(f"axis_{edp.name}_{axis.name}", fig, finding, text, "sweep", edp.name)


def _levels(p):
    """Lowest, middle and highest row that hold anything."""
    rows = np.flatnonzero(np.isfinite(p).any(axis=0))
    return sorted({int(rows[0]), int(rows[len(rows) // 2]), int(rows[-1])}) if rows.size else []


def _slices(ax, sweep, axis, k):
    """Curves of a few levels, each named where it ends; names that end near each other are moved apart."""
    levels, ends = _levels(axis.probability[:, :, k]), []
    for j, colour in zip(levels, style.series(len(levels))):
        p = axis.probability[:, j, k]
        ax.fill_between(sweep.centre, axis.lower[:, j, k], axis.upper[:, j, k], color=colour, alpha=0.14, lw=0)
        ax.plot(sweep.centre, p, "-o", ms=3, color=colour, lw=1.5)
        last = int(np.flatnonzero(np.isfinite(p))[-1])
        ends.append((sweep.centre[last], p[last], words.span(axis.edge[j], axis.edge[j + 1]), colour))
    for group in _near(ends, 0.45 * (sweep.view[1] - sweep.view[0])):
        for (x, _, text, colour), y in zip(group, style.spread([end[1] for end in group], 0.075, 0.99)):
            ax.annotate(text, (x, y), xytext=(7, 0), textcoords="offset points", color=colour, weight="bold",
                        size=8.8, va="center", path_effects=style.halo(), annotation_clip=False, zorder=6)


def _near(ends, width):
    """Groups of ends that follow each other within a width."""
    groups = []
    for end in sorted(ends):
        if groups and end[0] - groups[-1][-1][0] < width:
            groups[-1].append(end)
        else:
            groups.append([end])
    return groups


def _finding(sweep, axis, k, p, symbol, capacity, im):
    name = words.short_column(axis.name)
    rows = _levels(p)
    both = np.flatnonzero(np.isfinite(p[:, rows[0]]) & np.isfinite(p[:, rows[-1]])) if len(rows) > 1 else []
    if len(both) == 0:
        return f"Too few samples to compare ranges of {name}"
    at = max(both, key=lambda i: abs(p[i, rows[-1]] - p[i, rows[0]]))
    low, high = p[at, rows[0]], p[at, rows[-1]]
    where = words.is_(f"at {im}", sweep.centre[at], sweep.im_unit)
    if abs(high - low) < 0.05:
        return f"{words.capitalised(name)} hardly changes P({symbol} > {capacity}) at a given intensity"
    verb = "rises" if high > low else "falls"
    return (f"P({symbol}\u00a0>\u00a0{capacity}) {where} {verb} from {words.probability(low)} to {words.probability(high)} "
            f"with the {name}")
