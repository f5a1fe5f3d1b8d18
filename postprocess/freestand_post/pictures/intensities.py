"""Intensities ranked: over which one a demand scatters least, and which one best parts what happened from what did not."""
import numpy as np

from .. import style, words
from ..reading import Sweep
from . import Picture

order = 57
SHOWN = 12
DOUBT = 0.05
CAPTION = ("Left or alone: standard deviation of ln demand about a line over ln intensity, of the samples that moved and stood; of what "
           "happens or not: share of the deviance that a lognormal curve over the intensity explains. Bars: one standard error, motions as "
           "the unit. Filled: the best and those that these motions do not part from it (two standard errors of the difference). A ring "
           "around a point: what is left depends on the period of the pulse (p < 0.05), so that the answer hangs on which motions were "
           "taken. All numbers: ranking.csv.")


def pictures(results):
    if isinstance(results, Sweep):
        demands = [edp for edp in results.edps if results.summary.get("ranking", {}).get("demands", {}).get(edp.name)]
        shown = [edp for edp in demands if edp.kind != "binary"][:1] + [edp for edp in demands if edp.name == "overturned"]
        if shown or demands:
            yield _picture(results, shown or demands[:1])


def _figure_of(edp):
    return "deviance_explained" if edp.kind == "binary" else "scatter"


def _rows(sweep, edp):
    """The best ones, and the sweep's own intensity wherever it stands."""
    key = _figure_of(edp)
    rows = [row for row in sweep.summary["ranking"]["demands"][edp.name] if row.get(key) is not None]
    return [row for i, row in enumerate(rows) if i < SHOWN - 1 or row["im"] == sweep.im_name or i == len(rows) - 1]


def _rival(row):
    return row["behind_best"] == 0 or row["behind_best_se"] is not None and row["behind_best"] <= 2 * row["behind_best_se"]


def _doubtful(row):
    return any(left["p"] is not None and left["p"] < DOUBT for left in row.get("sufficiency", []))


def _picture(sweep, edps):
    rows = [_rows(sweep, edp) for edp in edps]
    fig = style.figure(7.4, 1.6 + 0.25 * max(len(some) for some in rows))
    axes = np.atleast_1d(fig.subplots(1, len(edps)))
    for ax, edp, some in zip(axes, edps, rows):
        _panel(ax, sweep, edp, some)
    finding = _finding(sweep, edps[0], rows[0])
    own = f" Bold: {sweep.im_symbol}, over which this sweep is fitted." if any(row["im"] == sweep.im_name for some in rows for row in some) else ""
    style.headline(fig, finding, "Better is further up; filled points are not parted from the best by these motions." + own)
    return Picture("intensities", fig, finding, CAPTION, "sweep")


def _panel(ax, sweep, edp, rows):
    key = _figure_of(edp)
    value = np.array([row[key] for row in rows])
    error = np.array([row[f"{key}_se"] or 0.0 for row in rows])
    for y, row in enumerate(rows):
        colour = style.BLUE if _rival(row) else style.GREY
        ax.errorbar(value[y], -y, xerr=error[y], fmt="o", ms=6, color=colour, mfc=colour if _rival(row) else "white", mec=colour,
                    elinewidth=1.2, capsize=2, zorder=3)
        if _doubtful(row):
            ax.plot(value[y], -y, "o", ms=12, mfc="none", mec=style.VERMILION, mew=1.1, zorder=2)
    low, high = min(value - error), max(value + error)
    room = 0.12 * (high - low) or 0.1
    ax.set(yticks=-np.arange(len(rows)), ylim=(0.4 - len(rows), 0.6), xlim=(low - room, high + room),
           xlabel=f"{words.capitalised(edp.label)}: deviance explained" if edp.kind == "binary" else f"scatter of ln {edp.label}")
    ax.set_yticklabels([words.intensity(row["im"]) for row in rows])
    for label, row in zip(ax.get_yticklabels(), rows):
        label.set(weight="bold" if row["im"] == sweep.im_name else "normal")
    if edp.kind == "binary":
        ax.invert_xaxis()  # the best at the left in both panels
    ax.tick_params(axis="y", length=0)
    style.grid(ax, "x")


def _finding(sweep, edp, rows):
    best, key = rows[0], _figure_of(edp)
    what = "parts best what happened" if edp.kind == "binary" else f"foretells {edp.label} best"
    own = next((row for row in rows if row["im"] == sweep.im_name), None)
    if own is None or own is best:
        return f"{words.intensity(best['im'])} {what}: {words.number(best[key])}"
    if _rival(own):
        return f"{words.intensity(best['im'])} {what}, and {sweep.im_symbol} no worse as far as these motions tell"
    return f"{words.intensity(best['im'])} {what}: {words.number(best[key])} against {words.number(own[key])} over {sweep.im_symbol}"
