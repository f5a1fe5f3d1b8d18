"""Probability of overturning against what happened, where a data set holds outcomes only, in the order of intensity."""
import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 160
CAPTION = ("Each mark is one test, {order}. Height: probability of overturning that the model gives; filled: the specimen "
           "overturned; hollow: it stood. Filled marks above one half and hollow ones below it are right.")


def pictures(results):
    if isinstance(results, Validation):
        for k, comparison in enumerate(results.comparisons):
            tests = _outcomes(comparison)
            if tests:
                yield _picture(results, k, tests)


def _outcomes(comparison):
    return [test for test in comparison.tests if test["kind"] == "outcome" and isinstance(test["overturned_measured"], bool)
            and np.isfinite(test["overturned_probability"])]


def score(comparison):
    """How many outcomes the model gets right, of how many."""
    tests = _outcomes(comparison)
    return sum((test["overturned_probability"] > 0.5) == test["overturned_measured"] for test in tests), len(tests)


def _picture(results, k, tests):
    by_intensity = all(np.isfinite(test["floor_peak_g"]) for test in tests)
    tests = sorted(tests, key=lambda test: test["floor_peak_g"] if by_intensity else test["overturned_probability"])
    p = np.array([test["overturned_probability"] for test in tests])
    over = np.array([test["overturned_measured"] for test in tests])
    x = np.array([test["floor_peak_g"] for test in tests]) if by_intensity else np.arange(1, p.size + 1)
    fig = style.figure(7.4, 3.9)
    ax, strip = fig.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [5, 0.8]})
    ax.axhspan(0.5, 1.04, color="#fdf1e9", lw=0, zorder=0)
    ax.plot(x[~over], p[~over], "o", ms=6, mfc="none", mec=style.BLUE, mew=1.3, label="measured: stood", zorder=3)
    ax.plot(x[over], p[over], "o", ms=6, color=style.VERMILION, mec="white", mew=0.6, label="measured: overturned", zorder=3)
    ax.axhline(0.5, color=style.MUTED, lw=0.8, ls=(0, (1, 2)))
    ax.set(ylim=(-0.04, 1.04), ylabel="P(overturned) of the model")
    ax.legend(frameon=False, loc="lower left", bbox_to_anchor=(-0.01, 1.0), ncol=2, borderaxespad=0, fontsize=8.8, handletextpad=0.3)
    strip.vlines(x[over], 0.5, 1, color=style.VERMILION, lw=1.2)
    strip.vlines(x[~over], 0, 0.5, color=style.BLUE, lw=1.2)
    strip.set(ylim=(0, 1), yticks=[0.25, 0.75], yticklabels=["stood", "overturned"],
              xlabel="peak floor acceleration (g)" if by_intensity else "tests, by the probability that the model gives")
    strip.tick_params(axis="y", length=0)
    strip.spines["left"].set_visible(False)
    if by_intensity and x.min() > 0 and x.max() / x.min() > 3:
        strip.set_xscale("log")
        style.plain_log(strip.xaxis)
    (right, _), brier = score(results.comparisons[k]), float(((p - over) ** 2).mean())
    label = results.labels[k]
    step = "The model" if len(results.comparisons) == 1 else "The base model" if label == "base" else f"The model {validation.by(label)}"
    finding = f"{step} gets {right} of {p.size} outcomes right (Brier score {words.number(brier)})"
    reference = float(((over.mean() - over) ** 2).mean())
    order_text = "by peak floor acceleration" if by_intensity else "sorted by the probability that the model gives"
    style.headline(fig, finding, f"Brier score: mean square of probability minus outcome; always saying {words.percent(over.mean())} "
                                 f"would score {words.number(reference)}.")
    return Picture("outcomes" if k == 0 else f"outcomes_{k + 1}", fig, finding, CAPTION.format(order=order_text), "outcomes")
