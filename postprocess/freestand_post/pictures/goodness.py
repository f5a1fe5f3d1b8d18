"""Kolmogorov-Smirnov plot of every bin: counted distribution against the fitted lognormal, S, and both p values."""
import numpy as np
from scipy.special import ndtr

from .. import style, words
from ..reading import FITTED, REJECTED, TESTED, UNPROVEN, Sweep
from . import Picture

order = 40
COLUMNS = 4
CAPTION = ("Black: counted distribution of {symbol} in a bin, of the samples that moved and stood, each taken along the bin's slope to its "
           "mean intensity; blue: fitted lognormal; red: where they are farthest apart. S is the Kolmogorov-Smirnov statistic; p the chance "
           "of a larger S if the lognormal were true, with parameters fitted to the same data, and p* the textbook value, which is too "
           "lenient here.")


def pictures(results):
    if isinstance(results, Sweep):
        for edp in results.continuous():
            if edp.cells[np.isin(edp.bins["status"], TESTED)].any():
                yield _picture(results, edp)


def _picture(sweep, edp):
    symbol, im = edp.label, sweep.im_symbol
    tested = np.flatnonzero(np.isin(edp.bins["status"], TESTED) & (edp.cells.sum(axis=1) > 0))
    n = tested.size
    rows = -(-n // COLUMNS)
    fig = style.figure(8.6, 0.95 + 1.62 * rows)
    axes = fig.subplots(rows, COLUMNS, sharex=True, sharey=True, squeeze=False)
    low, high = _range(edp)
    for place, ax in enumerate(axes.flat):
        if place >= n:
            ax.set_axis_off()
            continue
        i = tested[place]
        ax.set(xscale="log", xlim=(low, high), ylim=(0, 1.02), yticks=[0, 0.5, 1])
        _panel(ax, sweep, edp, i)
        if place + COLUMNS >= n:
            ax.tick_params(labelbottom=True)
            ax.set_xlabel(words.with_unit(symbol, edp.unit))
    style.plain_log(axes[0, 0].xaxis, crowd=3)
    for row in axes:
        row[0].set_ylabel("share below")
    finding = _finding(sweep, edp, symbol, im)
    left_out = sweep.centre.size - n
    style.headline(fig, finding, f"Counted (black) against fitted lognormal (blue) in each bin of {im}. p: parameters fitted to the "
                                 "same data; p*: textbook value, as older studies use it. Shaded: fails."
                   + (f" Not shown: {words.plural(left_out, 'bin')} without a fitted lognormal." if left_out else ""))
    return Picture(f"goodness_{edp.name}", fig, finding, CAPTION.format(symbol=symbol), "sweep", edp.name)


def _range(edp):
    total = edp.cells.sum(axis=0)
    if total.sum() == 0:
        return 0.1, 10.0
    share = np.cumsum(total) / total.sum()
    low, high = np.exp(np.interp([0.005, 0.998], share, edp.ln_edge[1:]))
    low = max(low, high / 1e5)
    return (low, high) if high > low else (low / 2, low * 2)


def _panel(ax, sweep, edp, i):
    bins, failed = edp.bins, edp.bins["status"][i] == REJECTED
    title = words.span(sweep.edge[i], sweep.edge[i + 1])
    ax.set_title(title + ("   fails" if failed else ""), size=8.5, weight="bold", color=style.FAIL if failed else style.INK, pad=3)
    if failed:
        ax.set_facecolor("#fdf1e9")
    count = edp.cells[i]
    below = np.concatenate([[0], np.cumsum(count)]) / count.sum()
    fitted = ndtr((edp.ln_edge - bins["lambda"][i]) / bins["omega"][i])
    fine = np.linspace(edp.ln_edge[0], edp.ln_edge[-1], 200)
    ax.plot(np.exp(fine), ndtr((fine - bins["lambda"][i]) / bins["omega"][i]), color=style.SKY, lw=2.6)
    ax.plot(np.exp(edp.ln_edge), below, color=style.INK, lw=1.0)
    worst = int(np.argmax(np.abs(below - fitted)))
    ax.plot([np.exp(edp.ln_edge[worst])] * 2, [below[worst], fitted[worst]], color=style.FAIL, lw=1.6)
    p, textbook = words.p_value(bins["ks_p_estimated"][i]), words.p_value(bins["ks_p_textbook"][i])
    low, high = np.log(ax.get_xlim())
    x, y, ha, va = (0.04, 0.95, "left", "top") if bins["lambda"][i] > 0.5 * (low + high) else (0.97, 0.05, "right", "bottom")
    ax.text(x, y, f"S = {bins['ks_statistic'][i]:.3f}\np {words.equals(p)}\np* {words.equals(textbook)}", transform=ax.transAxes,
            ha=ha, va=va, size=7.6, color=style.FAIL if failed else style.MUTED, linespacing=1.25)


def _finding(sweep, edp, symbol, im):
    status = edp.bins["status"]
    tested, unproven = int(np.isin(status, TESTED).sum()), int((status == UNPROVEN).sum())
    failed = np.flatnonzero(status == REJECTED)
    if failed.size == tested:
        return f"In none of the {words.plural(tested, 'bin')} does a lognormal describe {symbol}: the counted shares stand"
    if failed.size + unproven == 0:
        return f"A lognormal describes {symbol} in {'the one bin' if tested == 1 else f'all {tested} bins'} tested"
    where = words.listing(words.span(sweep.edge[i], sweep.edge[i + 1]) for i in failed[:4])
    return (f"A lognormal describes {symbol} in {(status == FITTED).sum()} of {tested} bins"
            + (f"; it fails at {im} from {where}" if 0 < failed.size <= 4 else "")
            + (f"; in {unproven} it is not refuted, but may be off by more than is adequate" if unproven else ""))
