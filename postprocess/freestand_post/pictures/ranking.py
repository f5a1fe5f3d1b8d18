"""The candidates of a diagnosis by left-out error, with standard errors, between the base and the floor of the noise."""
import numpy as np

from .. import style, validation, verdict, words
from ..validation import Validation
from . import Picture

order = 110
SHOWN = 10
CAPTION = ("Each point: error of one model on tests left out of its fit, in turn; bar: one standard error. Models at the grey line gain nothing over the base. Effects that no test can see are left out.")
FILLED = " Filled: the best and those that these tests do not tell from it."
CROSSES = " Crosses, numbers in brackets: error of the fit to all tests, of effects that gain too little on the base or the best to leave tests out."


def pictures(results):
    if isinstance(results, Validation):
        for k, diagnosis in enumerate(results.diagnoses):
            if any(row.get("visible", True) and np.isfinite(_value(row)) for row in diagnosis.candidates):
                yield _picture(diagnosis, k)


def _value(row):
    return row["error_left_out"] if row["left_out_refitted"] else row["error_calibration"]


def _picture(diagnosis, k):
    rows = [row for row in diagnosis.candidates if row.get("visible", True) and np.isfinite(_value(row))]
    more, rows = len(rows) - SHOWN, rows[:SHOWN]
    value = np.array([_value(row) for row in rows])
    error = np.nan_to_num([row["error_left_out_se"] for row in rows])
    base, floor = diagnosis.base.get("error_left_out", np.nan), diagnosis.noise_floor
    fig = style.figure(7.4, 1.75 + 0.27 * len(rows))
    ax = fig.subplots()
    y = -np.arange(len(rows), dtype=float)
    for level, colour, form in ((base, style.GREY, "-"), (floor, style.GREEN, (0, (4, 2)))):
        if np.isfinite(level):
            ax.axvline(level, color=colour, lw=1.4, ls=form, zorder=1)
    for i, row in enumerate(rows):
        colour = style.BLUE if row["as_good_as_best"] else style.MUTED
        if not row["left_out_refitted"]:
            ax.plot(value[i], y[i], "x", ms=6, color=style.MUTED, mew=1.3, zorder=3)
            continue
        low = min(error[i], 0.7 * value[i])
        ax.errorbar(value[i], y[i], xerr=[[low], [error[i]]], fmt="o", ms=7, color=colour, mfc=colour if row["as_good_as_best"] else "white",
                    mec=colour, mew=1.3, elinewidth=1.4, capsize=2.5, zorder=3)
    style.error_scale(ax, "x", np.concatenate([value + error, value - np.minimum(error, 0.7 * value), [base, floor]]))
    ax.set(yticks=y, ylim=(y[-1] - 0.6, 0.6), xlabel=f"error on left-out tests ({diagnosis.unit})")
    ax.set_yticklabels([validation.effect(row["effect"]) for row in rows])
    for label, row in zip(ax.get_yticklabels(), rows):
        label.set(weight="bold" if row["as_good_as_best"] else "normal", color=style.BLUE if row["as_good_as_best"] else style.INK)
    ax.tick_params(axis="y", length=0)
    for i, row in enumerate(rows):
        ax.text(1.02, y[i], validation.error(value[i]) if row["left_out_refitted"] else f"({validation.error(value[i])})", transform=ax.get_yaxis_transform(), va="center", size=8.8,
                color=style.BLUE if row["as_good_as_best"] else style.MUTED, weight="bold" if row["as_good_as_best"] else "normal")
    style.grid(ax, "x")
    _name_lines(ax, base, floor)
    finding = verdict.finding(diagnosis)
    lines = [f"green dashed: noise floor {validation.error(floor)}" if np.isfinite(floor) else "",
             f"grey: base model {validation.error(base)}" if np.isfinite(base) else ""]
    tail = f" {words.plural(more, 'more candidate')} not shown." if more > 0 else ""
    style.headline(fig, finding, words.capitalised("; ".join(line for line in lines if line)) + "; bars: one standard error." + tail)
    caption = (CAPTION + FILLED * any(row["as_good_as_best"] for row in rows)
               + CROSSES * (not all(row["left_out_refitted"] for row in rows)))
    return Picture("ranking" if k == 0 else f"ranking_{k + 1}", fig, finding, caption, "ranking")


def _name_lines(ax, base, floor):
    """The names of the two lines above them, where both have room."""
    if not (np.isfinite(base) and np.isfinite(floor)):
        return
    at = [ax.transLimits.transform(ax.transScale.transform((level, 0)))[0] for level in (floor, base)]
    if abs(at[1] - at[0]) < 0.3:
        return
    for level, place, text, colour in ((floor, at[0], "noise floor", style.GREEN), (base, at[1], "base model", style.MUTED)):
        ax.text(level, 1.01, text, transform=ax.get_xaxis_transform(), color=colour, size=8.8, weight="bold", va="bottom",
                ha="left" if place < 0.12 else "right" if place > 0.88 else "center")
