"""Chains: pull-out strength of their connections, and peak acceleration on them against the free equipment."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 260
STRENGTH = "Points: six pulls of each kind; bar: mean and standard deviation."
RATIO = ("Each point is one tie of the two chains, crossed at 15 degrees or straight, one slack (0 to 40 mm), one stiffness (by the frequency of the equipment on them, 3 to 20 Hz), one friction and one sign of the pulse. Line: the ratio that was "
         "measured.")


def pictures(results):
    if not isinstance(results, Reproduction):
        return
    pulls, peaks = results.table("table_9_1"), results.table("table_9_2")
    if pulls:
        yield _strength(pulls)
    if peaks:
        measured = {item["what"].split(":")[0]: item["print"] for item in results.place("table_9_2").printed() if item["id"].endswith("measured_ratio")}
        yield _ratios(peaks, measured)


def _strength(rows):
    fig = style.figure(7.4, 3.4)
    ax = fig.subplots()
    kinds = list(dict.fromkeys(row["series"] for row in rows))
    told = []
    for x, kind in enumerate(kinds):
        values = column([row for row in rows if row["series"] == kind], "strength_lb")
        ax.plot(x + np.linspace(-0.12, 0.12, values.size), values, "o", ms=5, color=style.INK, mec="white", mew=0.5)
        ax.errorbar([x + 0.25], [values.mean()], yerr=[values.std(ddof=1)], fmt="s", ms=6, color=style.BLUE, capsize=4)
        told.append(f"{values.mean():.0f} ± {values.std(ddof=1):.0f} lb {kind}")
    ax.set(xticks=range(len(kinds)), xticklabels=kinds, xlim=(-0.5, len(kinds) - 0.4), ylabel="strength (lb)", ylim=(0, None))
    style.grid(ax)
    finding = "Connections tore at " + words.listing(told)
    style.headline(fig, finding)
    return Picture("report_strength", fig, finding, STRENGTH, "table_9_1")


def _ratios(rows, measured):
    fig = style.figure(7.4, 3.9)
    kinds = list(dict.fromkeys(row["series"] for row in rows))
    for ax, kind in zip(fig.subplots(1, len(kinds), sharey=True), kinds):
        mine = [row for row in rows if row["series"] == kind]
        slack, ratio, frequency = (column(mine, name) for name in ("slack_m", "ratio", "frequency_hz"))
        for colour, hz in zip(style.series(np.unique(frequency).size), np.unique(frequency)):
            here = frequency == hz
            ax.plot(1000 * slack[here] + 0.5 * np.log2(hz / 8), ratio[here], "o", ms=4.5, color=colour, mec="white", mew=0.3, label=f"{hz:g} Hz")
        ax.axhline(measured[kind], color=style.VERMILION, lw=1.4)
        ax.annotate(f"measured: {measured[kind]}", (40, measured[kind]), xytext=(0, 4), textcoords="offset points", ha="right", color=style.VERMILION, weight="bold", path_effects=style.halo())
        ax.set_title(kind, weight="bold")
        ax.set_xlabel("slack (mm)")
        style.grid(ax)
    fig.axes[0].set(ylabel="peak acceleration on chains / free", ylim=(0, 1.25 * column(rows, "ratio").max()))
    ax.legend(frameon=False, fontsize=8.5, ncol=5, loc="upper right", columnspacing=0.8, handletextpad=0.1)
    share = np.mean((column(rows, "ratio") > 3) & (column(rows, "ratio") < 8))
    finding = f"Chains raise the peak acceleration, 3 to 8 times in {words.percent(share)} of the cases tried"
    style.headline(fig, finding, "Slack and stiffness of the report's chains are not printed; the ratio hangs on both.")
    return Picture("report_chains", fig, finding, RATIO, "table_9_2")
