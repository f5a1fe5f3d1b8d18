"""What the tests leave open of the fitted numbers: the joint draws of the last comparison, two numbers by two."""
import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 160
CAPTION = ("Each point is a set of numbers that the calibration tests allow, as a sweep of fitted.yaml draws them; crosses: the fit. Dashed: "
           "the interval of 90 % of each number. Where friction or the placement differs from test to test, points are those of another test, and "
           "scatter further than the interval of the mean.")
OF_ONE = "How often a sweep of fitted.yaml draws each value; red: the fit. Dashed: the interval of 90 %."


def pictures(results):
    if isinstance(results, Validation) and results.last and results.last.draws:
        yield _picture(results.last)


def _picture(comparison):
    best = {row["name"]: row["value"] for row in comparison.parameters}
    between = {row["name"]: row["interval_90"] for row in comparison.parameters}
    names = [name for name in comparison.draws if name in best]
    values = [comparison.draws[name] for name in names]
    n = len(names)
    fig = style.figure(7.4, 2.9 if n == 1 else 1.0 + 1.75 * n)
    axes = np.atleast_2d(fig.subplots(n, n, squeeze=False))
    for i in range(n):
        for j in range(n):
            if j > i:
                axes[i, j].set_visible(False)
            elif i == j:
                _one(axes[i, i], values[i], best[names[i]], between[names[i]])
            else:
                axes[i, j].plot(values[j], values[i], ".", ms=3, color=style.BLUE, alpha=0.35, mew=0)
                axes[i, j].plot(best[names[j]], best[names[i]], "x", ms=7, mew=1.6, color=style.VERMILION)
            axes[i, j].tick_params(labelbottom=i == n - 1, labelleft=j == 0 and i > 0)
            axes[i, j].xaxis.set_major_locator(style.ticker.MaxNLocator(3))
            axes[i, j].yaxis.set_major_locator(style.ticker.MaxNLocator(3) if i != j else style.ticker.NullLocator())
    for k, name in enumerate(names):
        axes[n - 1, k].set_xlabel(validation.parameter(name).replace(": ", ":\n"))
        if k > 0:
            axes[k, 0].set_ylabel(validation.parameter(name).replace(": ", ":\n"))
    finding = _finding(comparison, names, values, [between[name] for name in names])
    style.headline(fig, finding, f"{len(values[0])} joint draws of the fitted numbers.")
    return Picture("draws", fig, finding, CAPTION if n > 1 else OF_ONE, "draws")


def _one(ax, values, best, between):
    ax.hist(values, bins=24, color=style.BLUE, alpha=0.55)
    ax.axvline(best, color=style.VERMILION, lw=1.6)
    for end in between:
        ax.axvline(end, color=style.MUTED, lw=0.9, ls="--")


def _finding(comparison, names, values, between):
    """between: the intervals that comparison.json tells, of 90 %."""
    scatter = comparison.friction_scatter
    friction = f"; friction differs by {words.percent(scatter)} from test to test" if scatter > 0 else ""
    if len(names) > 1:
        r = np.corrcoef(np.array(values))
        np.fill_diagonal(r, 0)
        i, j = np.unravel_index(np.nanargmax(np.abs(r)), r.shape)
        if abs(r[i, j]) > 0.7:
            return (f"The tests know {_called(names[i])} and {_called(names[j])} better together than each "
                    f"(correlation {r[i, j]:.2f}){friction}")
    widths = [(high - low) / abs(np.median(v)) for (low, high), v in zip(between, values)]
    k = int(np.argmax(widths))
    low, high = between[k]
    size = max(abs(low), abs(high))
    digits = 2 + max(0, int(np.log10(size / (high - low)))) if high > low else 3  # that tell one end from the other
    return (f"The tests leave {_called(names[k])} open between {words.number(low, digits)} and {words.number(high, digits)}"
            f"{', and the other numbers less' if len(names) > 1 else ''}{friction}")


def _called(name):
    return validation.parameter(name).replace(": ", " ")
