"""The value of the one number in which designs differ that halves the annual rate of the first: "the base width that halves it"."""
import math

import numpy as np

from . import words


def halving(found, labels, events, tables):
    """A sentence for each event that has one. found: Designs; tables: the rows of each risk, labels: the designs that they are of."""
    if len(found.differing) != 1 or sorted(labels) != sorted(found.labels):
        return []
    key, texts = found.differing[0]
    try:
        value = np.array([float(texts[found.labels.index(label)]) for label in labels])
    except ValueError:
        return []
    if len(set(value)) < value.size or not (value > 0).all():
        return []
    return [sentence for event in events if (sentence := _sentence(key, value, event, tables))]


def _sentence(key, value, event, tables):
    rates = np.array([table[event].rate if event in table else (math.nan,) * 3 for table in tables])
    if not (rates[:, 0] > 0).all():
        return ""
    name, unit = words.sampled(key), words.split_unit(key)[1]
    wanted = 0.5 * rates[0, 0]
    what = f"the annual rate of “{tables[0][event].title}” of {name} {words.chosen(value[0], unit)}"
    at = _crossing(value, rates[:, 0], wanted)
    if math.isnan(at):
        least, most = words.chosen(value.min(), unit), words.chosen(value.max(), unit)
        return f"No {name} from {least} to {most} halves {what}."
    # The band of the other designs' rates, whose first one is what is halved.
    ends = [_crossing(value, np.where(np.arange(value.size) == 0, rates[:, 0], rates[:, side]), wanted) for side in (1, 2)]
    # A limit that no design reaches is told as beyond the last of them on its side.
    known = [end for end in ends if math.isfinite(end)]
    least, most = words.chosen(value.min(), unit), words.chosen(value.max(), unit)
    if len(known) == 2:
        band = f" ({words.number(min(known))} to {words.number(max(known))})"
    elif known and known[0] < at:
        band = f" ({words.number(known[0])} to beyond {most}, the largest of the designs)"
    elif known:
        band = f" (below {least}, the smallest of the designs, to {words.number(known[0])})"
    else:
        band = f" (its band reaches beyond the designs, {least} to {most})"
    return f"{words.capitalised(name)} {words.quantity(at, unit)}{band} halves {what}: read between the designs, ln rate over ln {name}."


def _crossing(value, rate, wanted):
    """Nearest to the first design, where ln rate over ln value, straight between designs, comes to what is wanted; nan: nowhere."""
    if not (rate > 0).all():
        return math.nan
    order = np.argsort(value)
    x, y = np.log(value[order]), np.log(rate[order] / wanted)
    found = [x[i] + (x[i + 1] - x[i]) * y[i] / (y[i] - y[i + 1]) for i in range(x.size - 1) if y[i] != y[i + 1] and y[i] * y[i + 1] <= 0]
    return math.exp(min(found, key=lambda at: abs(at - math.log(value[0])))) if found else math.nan
