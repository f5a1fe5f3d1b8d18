"""Table 7.1: which tests overturned the quarter-scale blocks, by experiment, by the report's model, and by freestand."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture

order = 250
CAPTION = ("Filled: overturned. Under the pulses of table 8.1, in half of their time; under the records, where they were given, as the probability that an ensemble of them overturns the "
           "block (friction and impact within 10 %, both components), the table following up to 20 Hz.")


def pictures(results):
    rows = results.table("table_7_1") if isinstance(results, Reproduction) else []
    if rows:
        yield _picture(results, rows)


def _picture(results, rows):
    columns = [("experiment", [row["experiment_overturned"] for row in rows]), ("report's\nmodel", [row["working_model_overturned"] for row in rows]), ("pulses", [row["pulse_overturned"] for row in rows])]
    records = [row for row in results.table("table_7_1_records") if row["half_power_hz"] == 20]
    if records:
        left = {}
        for row in records:
            left.setdefault((row["series"], row["motion"], row["pta_g"]), []).append(row["probability_after_others"])
        columns.append(("records", [(left.get((row["series"], row["motion"], row["pta_g"])) or [np.nan]).pop(0) if left.get((row["series"], row["motion"], row["pta_g"])) else np.nan for row in rows]))
    fig = style.figure(7.4, 5.4)
    ax = fig.subplots()
    for x, (_, values) in enumerate(columns):
        for y, value in enumerate(values):
            if not np.isfinite(value):
                ax.text(x, y, "–", ha="center", va="center", color=style.MUTED)
                continue
            colour = style.INK if x == 0 else style.BLUE
            ax.scatter([x], [y], s=80, facecolors="none", edgecolors=colour, linewidths=1.1)
            ax.scatter([x], [y], s=80, color=colour, alpha=float(value), lw=0)
    names = [f"{row['series']}, {row['motion'].replace('Loma Prieta ', '')}, {row['pta_g']:.2f} g" for row in rows]
    ax.set(xticks=range(len(columns)), xticklabels=[name for name, _ in columns], yticks=range(len(rows)), yticklabels=names, ylim=(len(rows) - 0.4, -0.6), xlim=(-0.5, len(columns) - 0.5))
    ax.tick_params(length=0, labelsize=8.5)
    ax.xaxis.tick_top()
    ax.spines[["left", "bottom"]].set_visible(False)
    place = results.place("table_7_1")
    finding = f"The report's own model foretells {place.value('working_model'):.0f} of {len(rows)} outcomes, the fitted pulses {place.value('pulses'):.0f}"
    if records:
        finding += f", records {place.value('records_20.right_after_others'):.0f} of {len(records)}"
    style.headline(fig, finding, "What a table moved that is not published decides over the rest.")
    return Picture("report_quarter_scale", fig, words.capitalised(finding), CAPTION, "table_7_1")
