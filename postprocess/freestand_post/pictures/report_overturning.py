"""Overturning spectra: where a rocking block falls under a pulse, and the safe cape above the lowest curve."""
import numpy as np

from .. import style, words
from ..reading_reproduce import Reproduction
from . import Picture

order = 240
WORDS = {"overturning_one_sine": "one-sine", "overturning_one_cosine": "one-cosine"}
CAPTION = ("Tinted: amplitudes that overturn the block, after an impact (orange) or without one (red). White between them: the safe cape, where it stands although a weaker pulse overturns "
           "it. Black: least amplitude that overturns. Amplitudes were scanned in steps of 2 % and each change located; a bisection on amplitude would miss the cape.")


def pictures(results):
    if not isinstance(results, Reproduction):
        return
    for name in WORDS:
        rows = results.table(name)
        if rows:
            yield _picture(results, name, rows)


def _stretches(rows, most):
    """frequency -> [(from, to, impacts)] where the block falls."""
    found = {}
    for row in rows:
        at = found.setdefault(row["frequency_over_p"], [])
        if row["falls_above"] > 0.5:
            at.append([row["amplitude_over_alpha_g"], most, row["impacts"]])
        elif at:
            at[-1][1] = row["amplitude_over_alpha_g"]
    return found


def _picture(results, name, rows):
    most = 40.0
    falls = _stretches(rows, most)
    frequency = np.array(sorted(falls))
    step = np.diff(frequency).min()
    fig = style.figure(7.4, 4.8)
    ax = fig.subplots()
    for at in frequency:
        for low, high, impacts in falls[at]:
            ax.bar(at, high - low, step * 1.02, bottom=low, color=style.VERMILION if impacts == 0 else style.ORANGE, alpha=0.45, lw=0)
    least = np.array([falls[at][0][0] for at in frequency])
    jumps = np.flatnonzero(least[1:] / least[:-1] > 2) + 1
    for x, y in zip(np.split(frequency, jumps), np.split(least, jumps)):
        ax.plot(x, y, color=style.INK, lw=1.6)
    ax.set(yscale="log", xlim=(frequency[0] - step / 2, frequency[-1] + step / 2), ylim=(1, most), xlabel="ω_p / p", ylabel="a_p / (α g)")
    style.plain_log(ax.yaxis)
    for x, y, text in _labels(falls):
        ax.text(x, y, text, weight="bold", size=9, ha="center", va="center", path_effects=style.halo())
    place = results.place(name)
    cape = next(item["ours"] for item in place.items if item["id"] == f"{name}.cape")
    finding = f"Under {WORDS[name]} pulses {cape.split(',')[0]}"
    style.headline(fig, finding, f"Block p = 1.25 rad/s, α = 0.16, Housner's impacts; {cape.split('; ')[-1] if '; ' in cape else ''}.")
    return Picture(f"report_{name}", fig, finding, CAPTION, name)


def _labels(falls):
    """Names of the regions where they are widest, in data units."""
    after, without, cape = None, None, None
    for at, spans in falls.items():
        for i, (low, high, impacts) in enumerate(spans):
            width = high / low
            if impacts > 0 and (after is None or width > after[0]):
                after = (width, at, np.sqrt(low * high))
            if impacts == 0 and (without is None or width > without[0]):
                without = (width, at, np.sqrt(low * high))
            if i and low / spans[i - 1][1] > (cape[0] if cape else 1.04):
                cape = (low / spans[i - 1][1], at, np.sqrt(low * spans[i - 1][1]))
    first, last = min(falls), max(falls)
    inside = lambda x: min(max(x, first + 0.12 * (last - first)), last - 0.12 * (last - first))
    return [(inside(found[1]), found[2], text) for found, text in ((after, "falls after an impact"), (without, "falls without impact"), (cape, "safe cape")) if found]
