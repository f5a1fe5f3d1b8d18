"""Friction by slow pulls against friction that fits recorded histories."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture

order = 203
KINDS = (("mu_s_slow_pull", "slow pull, static", "#f0b48a"), ("mu_k_slow_pull", "slow pull, kinetic", style.VERMILION), ("mu_k_elastoplastic_fit", "histories, elastoplastic", style.SKY),
         ("mu_k_coulomb_fit", "histories, Coulomb", style.BLUE))
CAPTION = "Coefficients of table 3.2. Slow pulls measure more friction than a specimen has while it is shaken."


def pictures(results):
    rows = results.table("table_3_2") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 3.8)
    ax = fig.subplots()
    x = np.arange(len(rows))
    for i, (name, text, colour) in enumerate(KINDS):
        bars = ax.bar(x + 0.2 * (i - 1.5), [row[name] for row in rows], 0.18, color=colour, label=text)
        ax.bar_label(bars, [f"{row[name]:.2f}" for row in rows], fontsize=8.5, padding=2)
    ax.set(xticks=x, xticklabels=[row["series"] for row in rows], ylabel="friction coefficient", ylim=(0, 0.56))
    ax.tick_params(axis="x", length=0)
    ax.legend(frameon=False, ncol=4, loc="upper left", fontsize=8.5, columnspacing=1.2, handlelength=1.2)
    ratios = [row["mu_k_slow_pull"] / row["mu_k_coulomb_fit"] for row in rows]
    finding = f"A slow pull overrates kinetic friction by a factor of {words.number(min(ratios))} to {words.number(max(ratios))}"
    style.headline(fig, finding)
    yield Picture("report_friction", fig, finding, CAPTION, "table_3_2")
