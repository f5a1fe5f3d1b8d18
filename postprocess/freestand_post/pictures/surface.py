"""The surface P(EDP > C) over intensity and capacity: shades per bin, contour lines through the bins."""
import numpy as np

from .. import style, words
from ..model import crossing, exceedance
from ..reading import REJECTED, TESTED, TOO_FEW, UNPROVEN, Sweep
from . import Picture

order = 20
LEVELS = (0.1, 0.25, 0.5, 0.75, 0.9)
CAPTION = ("Shade and contour lines: probability that {symbol} exceeds the capacity C (up) at an intensity (across), from the "
           "three-part model of each bin; a triangle marks a bin whose lognormal is not known to be adequate and whose counted distribution is shown "
           "instead, of demands taken along the bin's slope to its mean intensity, so that it need not be the share counted in the bin.")


def pictures(results):
    if isinstance(results, Sweep):
        for edp in results.continuous():
            yield _picture(results, edp)


def capacity_range(edp):
    """Capacities worth showing: the list of the study and the middle of what was seen."""
    low, high = 0.8 * edp.capacity[edp.capacity > 0].min(), 1.25 * edp.capacity.max()
    total = edp.cells.sum(axis=0)
    if total.sum() > 0:
        share = np.cumsum(total) / total.sum()
        seen = np.exp(np.interp([0.15, 0.98], share, edp.ln_edge[1:]))
        low, high = max(min(low, seen[0]), low / 10), max(high, seen[1])
    return (low, high) if high > low else (low / 3, low * 3)


def _picture(sweep, edp):
    symbol, im = edp.label, sweep.im_symbol
    low, high = capacity_range(edp)
    capacity = np.geomspace(low, high, 161)
    middle = np.sqrt(capacity[1:] * capacity[:-1])
    p = exceedance(edp, middle)
    fig = style.figure(7.4, 4.6)
    ax = fig.subplots()
    ax.set_facecolor(style.EMPTY)
    mesh = ax.pcolormesh(sweep.edge, capacity, p.T, cmap=style.PROBABILITY, vmin=0, vmax=1, rasterized=True)
    ax.set(yscale="log", xlim=sweep.view, ylim=(low, high), xlabel=words.with_unit(im, sweep.im_unit),
           ylabel=words.with_unit(f"capacity C of {symbol}", edp.unit))
    style.plain_log(ax.yaxis)
    _contours(ax, sweep, middle, p)
    marked = np.flatnonzero(np.isin(edp.bins["status"], (REJECTED, UNPROVEN)))
    counted, tested = marked.size, int(np.isin(edp.bins["status"], TESTED).sum())
    for i in marked:
        ax.plot(sweep.centre[i], 1.02, "v", ms=5, color=style.FAIL, transform=ax.get_xaxis_transform(), clip_on=False)
    _bar(fig, ax, mesh, symbol)
    finding = _finding(sweep, edp, symbol, im, p, middle)
    note = ("In no bin is the lognormal known to be adequate: the counted distributions are shown." if counted == tested > 0 else
            f"Triangles: the {counted} bins where the lognormal is not known to be adequate and the counted distribution is shown." if counted > 1 else
            "Triangle: the bin where the lognormal is not known to be adequate and the counted distribution is shown." if counted else
            "The lognormal is adequate in every bin tested." if tested else "Too few moved for a lognormal: counted.")
    grey = " Grey: too few samples." if (edp.bins["status"] == TOO_FEW).any() else ""
    style.headline(fig, finding, f"P({symbol} > C) over intensity and capacity. {note}{grey}")
    return Picture(f"surface_{edp.name}", fig, finding, CAPTION.format(symbol=symbol), "sweep", edp.name)


def _contours(ax, sweep, capacity, p):
    good = np.isfinite(p[:, 0])
    if good.sum() < 2:
        return
    x = sweep.centre[good]
    grid = np.linspace(x[0], x[-1], 300)
    dense = np.array([np.interp(grid, x, p[good, j]) for j in range(capacity.size)])
    if not any(dense.min() < level < dense.max() for level in LEVELS):
        return
    lines = ax.contour(grid, capacity, dense, levels=LEVELS, colors=[style.INK, style.INK, "white", "white", "white"],
                       linewidths=[0.8, 0.8, 1.6, 0.8, 0.8])
    ax.clabel(lines, fmt="%.2g", fontsize=8, inline_spacing=4)


def _bar(fig, ax, mesh, symbol):
    bar = fig.colorbar(mesh, ax=ax, pad=0.02, aspect=28)
    bar.set_label(f"P({symbol} > C)")
    bar.set_ticks([0, 0.25, 0.5, 0.75, 1])
    bar.outline.set_visible(False)


def _finding(sweep, edp, symbol, im, p, capacity):
    """What half and nine tenths of the specimens exceed, in the bin nearest to the middle that shows it."""
    found = []
    for i in np.flatnonzero(np.isfinite(p[:, 0])):
        half, most = (crossing(-np.log(capacity), p[i], level) for level in (0.5, 0.9))  # p falls with capacity
        if np.isfinite(half):
            found.append((abs(i - 0.5 * p.shape[0]), sweep.centre[i], np.exp(-half), np.exp(-most)))
    if not found and np.nanmax(p, initial=0) >= 0.5:
        return f"Where half of the specimens exceed one of the capacities of {symbol} shown, half exceed them all: they overturn"
    if not found and np.nansum(edp.bins["n_over"]) == np.nansum(edp.bins["n"]):
        return f"All specimens overturn, and so exceed every {symbol}"
    if not found:
        return f"Nowhere do half of the specimens reach the capacities of {symbol} shown" if np.isfinite(p).any() else f"Too few samples for a surface of {symbol}"
    _, x, half, most = min(found)
    where = "By this surface, " + words.is_(f"at {im}", x, sweep.im_unit)
    rest = f", nine in ten more than {words.quantity(most, edp.unit)}" if np.isfinite(most) else ""
    return f"{where}, half of the specimens {words.beyond(edp.name, edp.label, words.quantity(half, edp.unit))}{rest}"
