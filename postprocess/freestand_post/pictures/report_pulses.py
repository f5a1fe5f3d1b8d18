"""The pulses of the report: acceleration, velocity and displacement of each type."""
from .. import style
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column

order = 206
FINDING = "A ends displaced, B goes forward and back at a jump of acceleration, C ends without velocity and displacement"
CAPTION = "Acceleration over its peak, velocity over v_p, displacement over v_p T, against time in periods. The phase of the C pulses is the one by which they end where they began."


def pictures(results):
    rows = results.table("pulses") if isinstance(results, Reproduction) else []
    if not rows:
        return
    fig = style.figure(7.4, 4.6)
    types = list(dict.fromkeys(row["series"] for row in rows))
    grid = fig.subplots(3, len(types), sharey="row")
    for column_of_axes, kind in zip(grid.T, types):
        mine = [row for row in rows if row["series"] == kind]
        for ax, what in zip(column_of_axes, ("acceleration", "velocity", "displacement")):
            ax.axhline(0, color=style.FAINT, lw=0.8)
            ax.plot(column(mine, "time_over_period"), column(mine, what), color=style.BLUE)
        column_of_axes[0].set_title(f"type {kind}", weight="bold")
        column_of_axes[-1].set_xlabel("t / T")
    for ax, what in zip(grid[:, 0], ("a / a_p", "v / v_p", "u / (v_p T)")):
        ax.set_ylabel(what)
    style.headline(fig, FINDING)
    yield Picture("report_pulses", fig, FINDING, CAPTION, "pulses")
