"""Several sweeps side by side: what their studies differ in, and whether their medians differ by more than chance."""
import math
from dataclasses import dataclass

import numpy as np
import yaml

from . import words
from .model import counted_median
from .problem import USAGE, Problem

# What makes no other design: how much was computed, and how it was analysed.
NOT_DESIGN = ("name", "seed", "samples", "until", "block_size", "tolerance", "free_vibration_s", "fragility", "paths_from", "design")
KEYS_SHOWN = 3


@dataclass
class Design:
    sweep: object
    label: str


@dataclass
class Row:
    """One demand and capacity of all designs: medians, and each over that of the first."""
    what: str          # "largest slip > 0.1 m"
    curves: list       # [design] dictionary of a fragility function
    ratio: list        # [design] (value, lower, upper) of median over the first one's; nan for the first


@dataclass
class Designs:
    sweeps: list
    labels: list
    differing: list    # [(key, [value of each as text])]
    rows: list
    paired: bool       # the samples of all have the same motions
    level: float

    @property
    def im_symbol(self):
        return self.sweeps[0].im_symbol


def compare(sweeps):
    first = sweeps[0]
    if len({sweep.folder.resolve() for sweep in sweeps}) < len(sweeps):
        raise Problem("a sweep is given twice (it cannot stand beside itself): name each folder once", USAGE)
    for sweep in sweeps[1:]:
        if (sweep.im_name, sweep.im_unit) != (first.im_name, first.im_unit):
            raise Problem(f"{first.folder} was fitted over {first.im_name} and {sweep.folder} over {sweep.im_name}: several designs do not fit into "
                          f"one axis so; fit both over the same (freestand fit DIR --im {first.im_name} -o DIR2), or give every design over every intensity, in the "
                          "same order", USAGE)
    differing = _differing([_flat(sweep) for sweep in sweeps])
    paired = all(_motions(sweep) == _motions(first) for sweep in sweeps)
    level = float(first.attributes.get("confidence", 0.95))
    rows = [Row(what, each, [ratio(each[0], curve, paired, level) for curve in each]) for what, each in curves(sweeps)]
    return Designs(sweeps, _labels(sweeps, differing), differing, rows, paired, level)


def warnings(sweeps, labels):
    """What the fits warn of, but for what concerns other demands than the first of each: "label; label: warning"; without a label what all
    of them do."""
    told_by = {}
    for sweep, label in zip(sweeps, labels):
        others = tuple(f"{edp.name}: " for edp in sweep.edps[1:])
        for text in dict.fromkeys(map(str, sweep.summary.get("warnings", []))):
            if not text.startswith(others):
                told_by.setdefault(text, []).append(label)
    return [words.capitalised(text if len(told) == len(labels) else f"{'; '.join(told)}: {text}") for text, told in told_by.items()]


def same_study(sweeps):
    """Are they of one design? What was computed of it, and how it was analysed, may differ."""
    return not _differing([_flat(sweep) for sweep in sweeps])


def same_designs(sweeps, others):
    """Are they fits of the same designs, in the same order?"""
    return len(sweeps) == len(others) and all(same_study([one, other]) for one, other in zip(sweeps, others))


def _motions(sweep):
    return sweep.attributes.get("seed"), tuple(sweep.motions), sweep.attributes.get("resamples"), bool(sweep.motions)


def _flat(sweep):
    """The study as dotted keys with values as text."""
    try:
        study = yaml.safe_load(str(sweep.attributes.get("study", ""))) or {}
    except yaml.YAMLError:
        study = {}
    found = {}

    def walk(name, value):
        if isinstance(value, dict) and not _is_value(value):
            for key, part in value.items():
                walk(f"{name}.{key}" if name else str(key), part)
        elif isinstance(value, list) and value and all(isinstance(part, dict) for part in value):
            for i, part in enumerate(value):
                walk(f"{name}.{part['name']}" if "name" in part else name if len(value) == 1 else f"{name}[{i}]", {k: v for k, v in part.items() if k != "name"})
        elif value not in ([], {}):
            found[name] = value
    if isinstance(study, dict):
        walk("", {key: value for key, value in study.items() if key not in NOT_DESIGN})
    return found


DISTRIBUTIONS = ("uniform", "log_uniform", "normal", "lognormal", "triangular", "choice", "posterior")


def _is_value(value):
    return isinstance(value, dict) and any(key in value for key in DISTRIBUTIONS)


def _text(value):
    """"0.62", "0.18 (dispersion 0.3)", "0.5 to 0.9", "0.927 or 0.622"."""
    if not _is_value(value):
        return ", ".join(_text(part) for part in value) if isinstance(value, list) else f"{value:.4g}" if isinstance(value, float) else str(value)
    kind = next(key for key in DISTRIBUTIONS if key in value)
    what = value[kind]
    if kind in ("uniform", "log_uniform"):
        return f"{what[0]:g} to {what[1]:g}"
    if kind == "choice":
        return " or ".join(f"{one:g}" if isinstance(one, (int, float)) else str(one) for one in what)
    if kind == "lognormal":
        return f"{what['median']:g} (dispersion {what['dispersion']:g})"
    return f"{kind} " + ", ".join(str(part) for part in (what.values() if isinstance(what, dict) else [what]))


def _differing(flats):
    """(key, values): keys in which the studies differ; of a group that some do not have (a chain, an effect) one entry for all of it."""
    keys = list(dict.fromkeys(key for flat in flats for key in flat))
    found, groups = [], set()
    for key in keys:
        values = [flat.get(key) for flat in flats]
        if all(value == values[0] for value in values):
            continue
        group = ".".join(key.split(".")[:2]) if key.startswith("effects.") else key.split(".")[0]
        has = [any(other == group or other.startswith(group + ".") for other in flat) for flat in flats]
        if all(has):
            found.append((key, ["" if value is None else _text(value) for value in values]))
        elif group not in groups:
            groups.add(group)
            found.append((group, ["with" if one else "without" for one in has]))
    return found


def _labels(sweeps, differing):
    labels = []
    for i, sweep in enumerate(sweeps):
        parts = [_part(key, values[i]) for key, values in differing if values[i]]
        label = ", ".join(parts[:KEYS_SHOWN]) + (" …" if len(parts) > KEYS_SHOWN else "")
        labels.append(label or sweep.folder.resolve().name)
    if len(set(labels)) < len(labels):
        labels = [label if label == sweep.folder.resolve().name else f"{label} ({sweep.folder.resolve().name})" for label, sweep in zip(labels, sweeps)]
    if len(set(labels)) < len(labels):
        labels = [str(sweep.folder) for sweep in sweeps]
    return labels


def _part(key, value):
    if value in ("with", "without"):
        return f"{value} {key.removeprefix('effects.').replace('_', ' ')}"
    name = words.sampled(key.removeprefix("motions."))
    unit = words.split_unit(key)[1]
    return f"{name} {value}" + (f"\u00a0{unit}" if unit else "")


def curves(sweeps):
    """(what, [curve of each]): overturning, then each demand and capacity that all hold."""
    if all(sweep.overturning for sweep in sweeps):
        yield "overturning", [sweep.overturning for sweep in sweeps]
    for edp in sweeps[0].edps:
        others = [next((one for one in sweep.edps if one.name == edp.name and one.unit == edp.unit), None) for sweep in sweeps]
        if edp.name == "overturned" or not all(other is not None and other.functions for other in others):
            continue
        for i, capacity in enumerate(edp.capacity):
            places = [np.flatnonzero(np.isclose(other.capacity, capacity)) for other in others]
            if all(place.size for place in places):
                what = words.happening(edp.name) if edp.kind == "binary" else f"{words.demand_meaning(edp.name)} > {words.chosen(capacity, edp.unit)}"
                yield what, [other.functions[int(place[0])] for other, place in zip(others, places)]


def ratio(first, curve, paired, level):
    """Median over the first one's, with its interval from resampled motions: the same motions of both where they are paired. Where a curve is
    not adequate, by where the counted shares reach one half: no interval is known of that."""
    if curve is first or not (first["median"] > 0 and curve["median"] > 0):
        return (math.nan,) * 3
    if not (first["adequate"] and curve["adequate"]):
        known = [counted_median(one) for one in (first, curve)]
        return known[1] / known[0] if all(0 < one < math.inf for one in known) else math.nan, math.nan, math.nan
    a, b = np.log(first["resampled_median"]), np.log(curve["resampled_median"])
    if not paired:
        a = a[::-1]  # another order: as if drawn by themselves
    size = min(a.size, b.size)
    change = b[:size] - a[:size]
    change = change[np.isfinite(change)]
    value = math.log(curve["median"] / first["median"])
    if change.size < 50:
        return math.exp(value), math.nan, math.nan
    low, high = np.quantile(change, [(1 - level) / 2, (1 + level) / 2])
    return tuple(math.exp(one) for one in (value, low, high))


def shown_median(sweep, curve):
    """The median as a headline has it, by the counted shares where the curve is not adequate: one beyond what was swept is not known but for
    its side."""
    median = curve["median"] if curve["adequate"] else counted_median(curve)
    beyond = curve["extrapolated"] if curve["adequate"] else median in (0, math.inf)
    if math.isnan(median):
        return "–"
    if not beyond:
        return words.quantity(median, sweep.im_unit)
    above = median > (sweep.edge[0] + sweep.edge[-1]) / 2
    return ("> " if above else "< ") + words.chosen(float(f"{sweep.edge[-1 if above else 0]:.3g}"), sweep.im_unit)


def headline(sweep, curve, what):
    """(the median, what it is)"""
    return shown_median(sweep, curve), f"median {sweep.im_symbol} of {what}{'' if curve['adequate'] else ', counted'}"


def shown_half(curve):
    """Where the counted shares reach one half, in a table."""
    median = counted_median(curve)
    return words.number(median, 3) if 0 < median < math.inf else "–"


def verdict(found):
    """Is such a ratio beyond chance?"""
    _, low, high = found
    if not math.isfinite(low):
        return "not known"
    return "yes" if low > 1 or high < 1 else "no"
