"""Peaks predicted against peaks measured, where a data set holds peaks only: log-log, the 1:1 line, and the bias."""
import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 150
QUANTITY = {"peak_slip_m": (100, "peak slip", "cm"), "residual_slip_m": (100, "slip that remains", "cm"),
            "peak_rotation_rad": (180 / np.pi, "peak rotation", "°"), "peak_acceleration_g": (1, "peak acceleration", "g")}
CAPTION = ("Each point is one test. On the black line the model is right; the grey band holds a factor of two. Dashed: the geometric mean "
           "of predicted over measured. Triangles at the lower edge: the model does not move at all; at the left edge: the specimen did not; "
           "in the corner: neither, which is right.")


def pictures(results):
    if not isinstance(results, Validation):
        return
    for name in QUANTITY:
        found = [_pairs(comparison, name) for comparison in results.comparisons]
        if any((measured > 0).any() for measured, _ in found):
            yield _picture(results, name, found)


def _pairs(comparison, name):
    pairs = [test["peaks"][name] for test in comparison.tests if test["kind"] == "peaks" and name in test["peaks"]]
    pairs = [(abs(measured), abs(model)) for measured, model in pairs if np.isfinite(measured) and np.isfinite(model)]
    return np.array([pair[0] for pair in pairs]), np.array([pair[1] for pair in pairs])


def _ratio(measured, model):
    """Geometric mean of predicted over measured, and the scatter of its logarithm, of the tests where both move."""
    moved = (model > 0) & (measured > 0)
    if not moved.any():
        return np.nan, np.nan
    logs = np.log(model[moved] / measured[moved])
    return float(np.exp(logs.mean())), float(logs.std(ddof=1)) if logs.size > 1 else np.nan


def _picture(results, name, found):
    factor, title, unit = QUANTITY[name]
    fig = style.figure(7.4, 5.8)
    ax = fig.subplots()
    every = factor * np.concatenate([np.concatenate(pair) for pair in found])
    low, high = every[every > 0].min() / 1.5, every.max() * 1.5
    line = np.array([low, high])
    ax.fill_between(line, line / 2, line * 2, color=style.EMPTY, lw=0, zorder=0)
    ax.plot(line, line, color=style.INK, lw=1.0, zorder=1)
    for (measured, model), step, colour, form in zip(found, results.labels, results.colours, "os^Dv"):
        bias, scatter = _ratio(measured, model)
        label = f"{step}: {validation.error(bias)}" + (f", scatter {words.number(scatter)} in ln" if np.isfinite(scatter) else "")
        edge = low * 1.06
        x, y = (np.where(values > 0, factor * values, edge) for values in (measured, model))
        for shown, marker, size, text in (((measured > 0) & (model > 0), form, 6.5, label), (model == 0, "v", 7, None),
                                          ((measured == 0) & (model > 0), "<", 7, None)):
            ax.plot(x[shown], y[shown], marker, ms=size, color=colour, mec="white", mew=0.8, zorder=3, label=text)
        ax.plot(line, bias * line, color=colour, lw=1.3, ls=(0, (4, 2)), zorder=2)
    ax.set(xscale="log", yscale="log", xlim=(low, high), ylim=(low, high), aspect="equal",
           xlabel=f"measured {title} ({unit})", ylabel=f"predicted {title} ({unit})")
    for axis in (ax.xaxis, ax.yaxis):
        style.plain_log(axis, crowd=1.4)
    above = np.median(np.concatenate([model - measured for measured, model in found])) > 0
    ax.legend(frameon=False, loc="lower right" if above else "upper left", fontsize=8.8, title="predicted over measured",
              title_fontsize=8.8, alignment="left", handletextpad=0.3, borderaxespad=0.2)
    finding = _finding(results, found, title, results.comparisons[-1].peak_ratio.get("biased", False) if name == "peak_slip_m" else True)
    style.headline(fig, finding, "Black: right; grey band: a factor of two; dashed: mean of predicted over measured.")
    return Picture(f"peaks_{name}", fig, finding, CAPTION, "peaks")


def _finding(results, found, title, biased):
    """biased: as the comparison found of peak slips, with all that it knows of noise and chance; of other peaks their mean is told."""
    measured, model = found[-1]
    bias, scatter = _ratio(measured, model)
    if not model.any():
        return f"The model does not move in any of the {words.plural(measured.size, 'test')}"
    if not np.isfinite(bias):
        return "The model moves in no test in which the specimen does"
    share = (f"predicts {words.number(bias)} times the measured {title}" if biased
             else f"predicts the {title} without a bias that these tests show")
    before = _ratio(*found[0])[0]
    if len(found) > 1 and np.isfinite(before):
        step = words.capitalised(validation.by(results.labels[-1]))
        return f"{step} the model {share}, {validation.by(results.labels[0])} {words.number(before)}"
    return f"The model {share}" + (f", with a scatter of {words.number(scatter)} in ln" if np.isfinite(scatter) else "")
