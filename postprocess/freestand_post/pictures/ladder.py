"""The ladder: error on calibration tests and on tests held out, step by step of the model, over the floor of the noise."""
import math

import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 100
CAPTION = ("Each step is one more effect in the model. Calibration: the tests its numbers were fitted to; held out: tests that no fit "
           "has seen; dashed: what {floor} would make of the calibration tests.")
FLOOR = {"Brier": "chance alone, with the probabilities that are predicted,"}
LINES = (("error_calibration", "calibration", style.BLUE, "-o"), ("error_holdout", "held out", style.VERMILION, "-s"),
         ("noise_floor", "noise floor", style.MUTED, "--"))


def pictures(results):
    if isinstance(results, Validation) and len(results.ladder()) > 1:
        yield _picture(results, results.ladder())


def _picture(results, steps):
    fig = style.figure(7.4, 3.9)
    ax = fig.subplots()
    x = np.arange(len(steps))
    values = {key: np.array([step[key] for step in steps]) for key, *_ in LINES}
    for key, _, colour, form in LINES:
        ax.plot(x, values[key], form, color=colour, ms=6, mec="white", mew=0.8, lw=1.2 if key == "noise_floor" else 2.0)
    style.error_scale(ax, "y", np.concatenate(list(values.values())))
    ax.set(xticks=x, xticklabels=[step["step"].replace(" and ", "\nand ") for step in steps], xlim=(-0.3, len(steps) - 0.7),
           ylabel=f"error ({results.unit})")
    ax.tick_params(axis="x", length=0, pad=6)
    style.grid(ax)
    finding = _finding(results, steps)
    allowing = ", with the floor's noise and the friction of each test allowed for" * results.own_friction
    style.headline(fig, finding, f"Root mean square error in {results.unit} of each model of the ladder{allowing}."
                   if results.unit == "noise units" else f"Error ({results.unit}) of each model of the ladder.")
    _labels(ax, values, len(steps) - 1)
    return Picture("ladder", fig, finding, CAPTION.format(floor=FLOOR.get(results.unit, "the noise of sensors and floor motion alone")), "ladder")


def _labels(ax, values, last):
    """The name and last value of every line at its right end; the first values left of their points."""
    for at, side in ((last, 1), (0, -1)):
        shown = [(values[key][at], f"{name}  " * (side > 0) + validation.error(values[key][at]), colour)
                 for key, name, colour, _ in LINES if math.isfinite(values[key][at]) and (side > 0 or key != "noise_floor")]
        for (value, text, colour), y in zip(shown, style.spread_on(ax, [entry[0] for entry in shown], 0.075)):
            ax.annotate(text, (at, y), xytext=(10 * side, 0), textcoords="offset points", ha="left" if side > 0 else "right",
                        va="center", color=colour, weight="bold", size=9, annotation_clip=False)


def _finding(results, steps):
    first, last = steps[0], steps[-1]
    key = "error_holdout" if math.isfinite(first["error_holdout"]) and math.isfinite(last["error_holdout"]) else "error_calibration"
    what = "held-out" if key == "error_holdout" else "calibration"
    floor = last["noise_floor_holdout"] if key == "error_holdout" and math.isfinite(last["noise_floor_holdout"]) else last["noise_floor"]
    verb = "falls" if last[key] < first[key] else "rises"
    step = words.capitalised(validation.by(last["model"]))
    told = f"{step} the {what} error {verb} from {validation.error(first[key])} to {validation.error(last[key], results.unit)}"
    if not math.isfinite(floor):
        return told
    return told + (", at the noise floor" if last[key] < 1.2 * floor else f", above the noise floor of {validation.error(floor)}")
