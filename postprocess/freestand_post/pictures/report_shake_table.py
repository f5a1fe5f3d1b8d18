"""Measured peak slips against those of a sliding block under the fitted pulses."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 204
CAPTION = "Each point is one test of table 5.1. On the line the prediction equals the measurement; dotted: half and twice."
KINDS = (("slow_pull_slip_m", "friction of the slow pulls", style.VERMILION, "o"), ("best_fit_slip_m", "friction that fits histories", style.BLUE, "s"))


def pictures(results):
    rows = results.table("shake_table") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 4.6)
    ax = fig.subplots()
    measured = column(rows, "measured_slip_m")
    limits = np.array([0.4 * measured.min(), 2.5 * measured.max()])
    for factor in (0.5, 1, 2):
        ax.plot(limits, factor * limits, color=style.MUTED, lw=0.8, ls="-" if factor == 1 else ":")
    for name, text, colour, form in KINDS:
        ax.plot(measured, np.maximum(column(rows, name), limits[0] * 1.05), form, ms=4.5, color=colour, mec="white", mew=0.5, label=text)
    ax.set(xscale="log", yscale="log", xlim=limits, ylim=limits, xlabel="measured peak slip (m)", ylabel="sliding block under the pulse (m)")
    style.plain_log(ax.xaxis)
    style.plain_log(ax.yaxis)
    ax.legend(frameon=False, loc="upper left")
    place = results.place("shake_table")
    finding = (f"Friction of a slow pull predicts {words.number(place.value('slow_pull'))} of the measured slips, the one that fits histories {words.number(place.value('best_fit'))}")
    style.headline(fig, finding, f"Geometric means of predicted over measured; scatter of ln {words.number(place.value('slow_pull_scatter'))} and {words.number(place.value('best_fit_scatter'))}.")
    yield Picture("report_shake_table", fig, finding, CAPTION, "shake_table")
