"""Annual rates of exceeding each capacity, with bands, beside the intensities that they come from."""
import numpy as np

from .. import style, words
from ..reading_decisions import Risk
from . import Picture

order = 60
CAPTION = ("Left: annual rate of each, with its {level} interval (sampling of motions and fit); hollow: by the counted shares of the bins, "
           "where the fitted curve is not adequate. Right: from which intensities the rates come; each curve has the same area. "
           "Rate = integral of P(exceeded | {im}) over the hazard curve.")
MOST = 8  # rows that have room


def pictures(results):
    if isinstance(results, Risk) and results.told():
        yield _picture(results)


def _chosen(risk):
    """Rows to draw: all; or of each demand the middle capacity, and as many of the first and last ones as there is room for."""
    rows = risk.told()
    places = {}
    for i, row in enumerate(rows):
        places.setdefault(row.edp, []).append(i)
    by_need = [mine[at(len(mine))] for at in (lambda n: n // 2, lambda n: n - 1, lambda n: 0) for mine in places.values()]
    return rows if len(rows) <= MOST else [rows[i] for i in sorted(list(dict.fromkeys(by_need))[:MOST])]


def _picture(risk):
    rows = _chosen(risk)
    fig = style.figure(8.6, 1.7 + 0.36 * max(len(rows), 5))
    left, right = fig.subplots(1, 2, gridspec_kw={"width_ratios": [1.15, 1]})
    colours = _colours(rows)
    for y, (row, colour) in enumerate(zip(rows, colours)):
        value, low, high = row.rate
        if np.isfinite(low) and np.isfinite(high):
            left.plot([max(low, value / 1e3), high], [y, y], color=colour, lw=2.2, alpha=0.55, solid_capstyle="butt")
        left.plot(value, y, "o", ms=6, color=colour, mfc="white" if row.by == "counts" else colour, mew=1.4)
    left.set_xscale("log")
    ends = [max(low, value / 30) for value, low, _ in (row.rate for row in rows) if low > 0] + [row.rate[0] for row in rows]
    tops = [row.rate[2] if np.isfinite(row.rate[2]) else row.rate[0] for row in rows]
    left.set_xlim(min(ends) / 2, max(tops) * 2)
    left.set(yticks=range(len(rows)), yticklabels=[words.capitalised(row.title) for row in rows], xlabel="annual rate", ylim=(len(rows) - 0.5, -0.6))
    left.tick_params(axis="y", length=0)
    style.grid(left, "x")
    _years(left, risk)
    _split(right, risk, rows, colours)
    finding = _finding(risk, rows)
    style.headline(fig, finding, f"{risk.study_name}: the hazard curve over {risk.im_symbol}, {words.level(risk.confidence)} intervals; "
                                 f"swept {words.number(risk.swept[0])} to {words.quantity(risk.swept[1], risk.im_unit)}.")
    more = len(risk.told()) - len(rows)
    return Picture("risk", fig, finding, CAPTION.format(level=words.level(risk.confidence), im=risk.im_symbol)
                   + (f" {words.capitalised(words.plural(more, 'more rate'))}: in the table." if more else ""), "risk")


def _colours(rows):
    """A hue a demand, lighter for smaller capacities."""
    hues = [style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.ORANGE]
    order = list(dict.fromkeys(row.edp for row in rows))
    return [hues[order.index(row.edp) % len(hues)] for row in rows]


def _years(ax, risk):
    """The same axis as chances in N years, above it."""
    years = risk.years[0]
    low, high = ax.get_xlim()
    chances = [p for p in (1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5, 0.9, 0.99) if low < -np.log1p(-p) / years < high]
    top = ax.secondary_xaxis("top")
    top.set_xscale("log")
    top.set_xticks([-np.log1p(-p) / years for p in chances], [f"{100 * p:g} %" for p in chances])
    top.minorticks_off()
    top.set_xlabel(f"chance in {years:g} years")


def _split(ax, risk, rows, colours):
    middle = np.sqrt(risk.edge[1:] * risk.edge[:-1])
    top = 0
    for row, colour in zip(rows, colours):
        if row.share.size != middle.size:
            continue
        density = row.share / np.log(risk.edge[1:] / risk.edge[:-1])
        ax.plot(middle, density, color=colour, lw=1.6, alpha=0.9)
        top = max(top, density.max())
    ax.set(xscale="log", ylim=(0, 1.12 * top or 1), yticks=[], xlabel=words.with_unit(risk.im_symbol, risk.im_unit),
           xlim=(risk.edge[0], risk.edge[-1]))
    style.plain_log(ax.xaxis, crowd=1.3)
    ax.spines["left"].set_visible(False)
    for end, place in zip(risk.swept, ("right", "left")):
        if risk.edge[0] < end < risk.edge[-1]:
            ax.axvline(end, color=style.MUTED, lw=0.8, ls=(0, (1, 2)))
    low, high = max(risk.swept[0], risk.edge[0]), min(risk.swept[1], risk.edge[-1])
    ax.axvspan(risk.edge[0], low, color=style.EMPTY, lw=0, zorder=0)
    ax.axvspan(high, risk.edge[-1], color=style.EMPTY, lw=0, zorder=0)
    ax.set_title("Where it comes from (grey: not swept)", weight="bold", pad=5)


def _finding(risk, rows):
    row = next((row for row in rows if row.edp == "overturned"), rows[len(rows) // 2])
    years, chance, low, high = row.in_years[0]
    band = f" ({_percent(low)} to {_percent(high)})" if np.isfinite(low) and np.isfinite(high) else ""
    what = f"of {row.title}" if np.isfinite(row.capacity) else "that the specimen is overturned" if row.edp == "overturned" else f"that {row.title}"
    return f"The chance {what} in {years:g} years is {_percent(chance)}{band}"


def _percent(share):
    return f"{words.number(100 * share)} %"
