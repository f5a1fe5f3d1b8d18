"""Shares of the variance of demands and of exceedance by sampled parameter, with errors."""
import numpy as np

from .. import style, words
from ..reading_decisions import Sensitivity
from . import Picture

order = 55
CAPTION = ("Bars: share of the variance that would go if the parameter were known, with its {level} interval, motions left out in turn. "
           "{total}{lack}{moved}")
TOTAL = "Open points: share that the parameter has a part in, alone and together with others (total). "
MOVED = (" Of ln of a demand only what moved and stood counts, where parameters go together (what moves under weak motions has little friction): a bar "
         "holds what goes with its parameter, and may be longer than its total share.")
MOST_PANELS, MOST_PARAMETERS = 4, 10


def pictures(results):
    if isinstance(results, Sensitivity):
        answers = chosen(results)
        if answers:
            yield _picture(results, answers)


def chosen(found):
    """Answers to draw: the first demand, its middle capacity, and what happens or not; then other demands."""
    known = [answer for answer in found.answers if answer.shares]
    continuous = list(dict.fromkeys(answer.edp for answer in known if answer.kind != "happens"))
    picked = []
    for edp in continuous:
        mine = [answer for answer in known if answer.edp == edp]
        exceeding = [answer for answer in mine if answer.kind == "exceeds"]
        picked += [answer for answer in mine if answer.kind == "ln_demand"] + exceeding[len(exceeding) // 2:][:1]
    happening = [answer for answer in known if answer.kind == "happens"]
    return (picked[:2] + happening + picked[2:])[:MOST_PANELS]


def _picture(found, answers):
    names = _by_size(answers)
    fig = style.figure(8.6, 1.25 + 0.36 * max(len(names), 3) + 0.2)
    axes = fig.subplots(1, len(answers), sharey=True, sharex=True, squeeze=False)[0]
    y = np.arange(len(names))
    top = least = 0
    for ax, answer in zip(axes, answers):
        shares = {share.parameter: share for share in answer.shares}
        values = np.array([shares[name].share if name in shares else (np.nan,) * 4 for name in names])
        totals = np.array([shares[name].total if name in shares else (np.nan,) * 4 for name in names])
        ax.barh(y, values[:, 0], color=style.BLUE, alpha=0.8, height=0.62)
        ax.hlines(y, values[:, 2], values[:, 3], color=style.INK, lw=1.1)
        if np.isfinite(totals[:, 0]).any():
            ax.hlines(y + 0.24, totals[:, 2], totals[:, 3], color=style.VERMILION, lw=1.0)
            ax.plot(totals[:, 0], y + 0.24, "o", ms=4, mfc="white", mec=style.VERMILION, mew=1.2)
        top = max(top, np.nanmax(values[:, [0, 3]], initial=0), np.nanmax(totals[:, [0, 3]], initial=0))
        least = min(least, np.nanmin(values[:, [0, 2]], initial=0), np.nanmin(totals[:, [0, 2]], initial=0))
        if least < 0:
            ax.axvline(0, color=style.MUTED, lw=0.8)
        ax.set_title(_wrapped(answer.title), weight="bold", pad=5, size=8.6)
        ax.set(yticks=y, yticklabels=[words.sampled(name) for name in names], ylim=(len(names) - 0.4, -0.6), xlabel="share of the variance")
        ax.tick_params(axis="y", length=0)
        style.grid(ax, "x")
    axes[0].set_xlim(1.06 * least - 0.02 if least < 0 else 0, 1.06 * top + 0.02)
    finding = _finding(answers)
    style.headline(fig, finding, f"Shares of the variance with {words.level(found.confidence)} intervals"
                   + (f"; open points: total shares from {words.count(found.pairs)} pairs a parameter." if found.pairs else "."))
    return Picture("sensitivity", fig, finding, CAPTION.format(level=words.level(found.confidence), total=TOTAL if found.pairs else "", lack=_lack(answers),
                                                      moved=MOVED if any(answer.kind == "ln_demand" for answer in answers) else ""), "sensitivity")


def _lack(answers):
    """What a panel lacks to 1 is of parameters together, where it is more than its error."""
    lacking = [answer for answer in answers if answer.together[3] < 1]
    if not lacking:
        return "What the bars of a panel shown here lack to 1 is no more than its error."
    which = "a panel" if len(lacking) == len(answers) else words.listing([answer.title for answer in lacking])
    return (f"What the bars of {which} lack to 1 is due to parameters that act together"
            + ("." if len(lacking) == len(answers) else "; of the other panels it is no more than its error."))


def _wrapped(text):
    """Two lines where one is too long for a panel."""
    if len(text) <= 24:
        return text + "\n"
    words_of = text.split(" ")
    first = ""
    while words_of and len(first) + len(words_of[0]) < 24:
        first += ("" if not first else " ") + words_of.pop(0)
    return first + "\n" + " ".join(words_of)


def _by_size(answers):
    largest = {}
    for answer in answers:
        for share in answer.shares:
            largest[share.parameter] = max(largest.get(share.parameter, 0), share.share[0], np.nan_to_num(share.total[0]))
    return sorted(largest, key=largest.get, reverse=True)[:MOST_PARAMETERS]


def _finding(answers):
    answer = answers[0]
    ordered = sorted(answer.shares, key=lambda share: -share.share[0])
    first = ordered[0]
    scatter = f"the scatter of the {words.demand_meaning(answer.edp)}" if answer.kind == "ln_demand" else f"the scatter of whether {words.happening(answer.edp)}" if answer.kind == "happens" \
        else answer.title
    text = (f"{words.capitalised(words.sampled(first.parameter))} explains {words.percent(first.share[0])} of {scatter}" if first.share[2] > 0
            else f"No parameter alone explains {scatter} beyond chance")
    second = next((share for share in ordered[1:] if share.share[2] > 0.01), None)
    if second:
        text += f", {words.sampled(second.parameter)} {words.percent(second.share[0])}"
    over = next((one for one in answers if one.kind == "happens"), None)
    if over and over.shares:
        best = max(over.shares, key=lambda share: share.share[0])
        if over is not answer and best.parameter != first.parameter and best.share[2] > 0:
            text += f"; whether {'it overturns' if over.edp == 'overturned' else over.title} hangs most on {words.sampled(best.parameter)}"
    return text
