"""Does the line's lognormal describe the peaks: their probabilities under it against those of chance."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture
from .report_peaks import column, named

order = 220
CAPTION = ("Steps: share of the tests whose probability under the line is at most the value below; on the diagonal if the line were true. S is the largest distance. Band: within it "
           "S stays in 95 % of simulated tables whose line is fitted to the same points; dotted: the textbook's limit, for a line that was known before.")


def pictures(results):
    if not isinstance(results, Reproduction):
        return
    for place in results.places:
        rows = results.table(f"{place.id}_ks")
        if rows:
            yield _picture(place, rows)


def _picture(place, rows):
    fig = style.figure(7.4, 4.4)
    ax = fig.subplots()
    u = np.concatenate([[0], np.repeat(column(rows, "probability_below"), 2), [1]])
    share = np.concatenate([[0], np.column_stack([column(rows, "share_before"), column(rows, "share_after")]).ravel(), [1]])
    critical, textbook, s, p = (place.value(name) for name in ("ks_critical", "ks_critical_textbook", "ks_ours", "ks_p"))
    diagonal = np.array([0.0, 1.0])
    ax.fill_between(diagonal, diagonal - critical, diagonal + critical, color=style.GREEN, alpha=0.13, lw=0)
    ax.plot(diagonal, diagonal, color=style.GREEN, lw=1)
    for sign in (-1, 1):
        ax.plot(diagonal, diagonal + sign * textbook, color=style.MUTED, lw=1, ls=":")
    ax.plot(u, share, color=style.INK, lw=1.6)
    distance = np.abs(share - u)
    at = int(np.argmax(distance))
    ax.plot([u[at], u[at]], [u[at], share[at]], color=style.VERMILION, lw=2)
    ax.annotate(f"S = {words.number(s, 3)}", (u[at], 0.5 * (u[at] + share[at])), xytext=(6, 0), textcoords="offset points", color=style.VERMILION, weight="bold", va="center", path_effects=style.halo())
    ax.set(xlim=(0, 1), ylim=(0, 1), xlabel="probability of a smaller peak, by the line", ylabel="share of the tests")
    finding = f"The line is {'rejected' if s > critical else 'not rejected'}: S = {words.number(s, 3)}, 5 % limit {words.number(critical, 3)}, p {words.equals(words.p_value(p))}"
    style.headline(fig, finding, f"{words.capitalised(named(place))}; the textbook's limit would be {words.number(textbook, 3)}.")
    return Picture(f"report_goodness_{place.id}", fig, finding, CAPTION, place.id)
