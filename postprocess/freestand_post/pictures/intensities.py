"""Intensities ranked: over which one a demand scatters least, and which one best parts what happened from what did not."""
import numpy as np

from .. import style, words
from ..over_intensities import Intensities
from ..reading import Sweep
from . import Picture

order = 57
SHOWN = 12
DOUBT = 0.05
CAPTION = ("Scatter: standard deviation of ln demand about a line over ln intensity, of the samples that moved and stood; of what "
           "happens or not: share of the deviance that a lognormal curve over the intensity explains. Bars: one standard error, motions as "
           "the unit. Filled: the best and those that these motions do not part from it (two standard errors of the difference). {ring}All "
           "numbers: ranking.csv.")
RING = ("A ring around a point: what is left depends on a property of the motions (p < 0.05; here {}), so that the answer hangs on which motions "
        "were taken. ")


def pictures(results):
    if isinstance(results, Intensities):
        yield from _of(results.sweeps[0], {sweep.im_name for sweep in results.sweeps})
    if isinstance(results, Sweep):
        yield from _of(results, {results.im_name})


def _of(sweep, own):
    """own: the intensities over which there is a fit."""
    demands = [edp for edp in sweep.edps if sweep.summary.get("ranking", {}).get("demands", {}).get(edp.name)]
    if demands:
        # The demand that the study names first, and beside it one of the other kind: overturning where it is there.
        others = [edp for edp in demands[1:] if (edp.kind == "binary") != (demands[0].kind == "binary")]
        beside = [edp for edp in others if edp.name == "overturned"] or others
        yield _picture(sweep, demands[:1] + beside[:1], own)


def _figure_of(edp):
    return "deviance_explained" if edp.kind == "binary" else "scatter"


def _rows(sweep, edp, own):
    """The best ones, and the fit's own intensities wherever they stand."""
    key = _figure_of(edp)
    rows = [row for row in sweep.summary["ranking"]["demands"][edp.name] if row.get(key) is not None]
    return [row for i, row in enumerate(rows) if i < SHOWN - len(own) or row["im"] in own or i == len(rows) - 1]


def _rival(row):
    return row["behind_best"] == 0 or row["behind_best_se"] is not None and row["behind_best"] <= 2 * row["behind_best_se"]


def _doubts(row):
    """On which properties of the motions depends what it leaves?"""
    return [left["on"] for left in row.get("sufficiency", []) if left["p"] is not None and left["p"] < DOUBT]


def _caption(rows):
    doubts = dict.fromkeys(on for row in rows for on in _doubts(row))
    return CAPTION.format(ring=RING.format(words.listing(words.property_of_motions(on) for on in doubts)) if doubts else "")


def _picture(sweep, edps, own):
    rows = [_rows(sweep, edp, own) for edp in edps]
    fig = style.figure(7.4, 1.6 + 0.25 * max(len(some) for some in rows))
    axes = np.atleast_1d(fig.subplots(1, len(edps)))
    for ax, edp, some in zip(axes, edps, rows):
        _panel(ax, edp, some, own)
    finding = _finding(sweep, edps[0], rows[0])
    bold = [words.intensity(name) for name in sorted({row["im"] for some in rows for row in some} & own)]
    style.headline(fig, finding, "Better is further up; filled points are not parted from the best by these motions."
                   + (f" Bold: {words.listing(bold)}, over which this sweep is fitted." if bold else ""))
    ranking = sweep.summary["ranking"]
    some = ranking.get("samples", 0) < ranking.get("swept", 0)
    return Picture("intensities", fig, finding, _caption(row for panel in rows for row in panel) + (f" Of the first {words.count(ranking['samples'])} samples." if some else ""), "sweep")


def _panel(ax, edp, rows, own):
    key = _figure_of(edp)
    value = np.array([row[key] for row in rows])
    error = np.array([row[f"{key}_se"] or 0.0 for row in rows])
    for y, row in enumerate(rows):
        colour = style.BLUE if _rival(row) else style.GREY
        ax.errorbar(value[y], -y, xerr=error[y], fmt="o", ms=6, color=colour, mfc=colour if _rival(row) else "white", mec=colour,
                    elinewidth=1.2, capsize=2, zorder=3)
        if _doubts(row):
            ax.plot(value[y], -y, "o", ms=12, mfc="none", mec=style.VERMILION, mew=1.1, zorder=2)
    low, high = min(value - error), max(value + error)
    room = 0.12 * (high - low) or 0.1
    ax.set(yticks=-np.arange(len(rows)), ylim=(0.4 - len(rows), 0.6), xlim=(low - room, high + room),
           xlabel=f"{words.capitalised(edp.label)}: deviance explained" if edp.kind == "binary" else f"scatter of ln {edp.label}")
    ax.set_yticklabels([words.intensity(row["im"]) for row in rows])
    for label, row in zip(ax.get_yticklabels(), rows):
        label.set(weight="bold" if row["im"] in own else "normal")
    if edp.kind == "binary":
        ax.invert_xaxis()  # the best at the left in both panels
    ax.tick_params(axis="y", length=0)
    style.grid(ax, "x")


def _finding(sweep, edp, rows):
    best, key = rows[0], _figure_of(edp)
    what = f"parts best what happened ({words.happening(edp.name)})" if edp.kind == "binary" else f"foretells {edp.label} best"
    own = next((row for row in rows if row["im"] == sweep.im_name), None)
    if own is None or own is best:
        return f"{words.intensity(best['im'])} {what}: {words.number(best[key])}"
    if _rival(own):
        return (f"{words.intensity(best['im'])} {what} ({words.number(best[key])}), and {sweep.im_symbol} ({words.number(own[key])}) no worse as far as "
                "these motions tell")
    return f"{words.intensity(best['im'])} {what}: {words.number(best[key])} against {words.number(own[key])} over {sweep.im_symbol}"
