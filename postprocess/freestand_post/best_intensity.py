"""Several designs over several intensities: which of these tells best what happens, by the ranking of each design."""
import math

from . import words

FIGURES = {"binary": ("deviance_explained", "share of the deviance that a lognormal curve over the intensity explains", 1),
           "continuous": ("scatter", "standard deviation of ln demand about a line over ln intensity", -1)}


def table(over):
    """over: Designs over each intensity. Of the demand that the first study names first: {what, figure, columns, rows, finding}; None where there
    is one intensity, or no ranking of them all."""
    sweeps = over[0].sweeps
    edp = next((edp for edp in sweeps[0].edps), None)
    if len(over) < 2 or edp is None:
        return None
    key, figure, sign = FIGURES["binary" if edp.kind == "binary" else "continuous"]
    own = {one.sweeps[0].im_name: one.im_symbol for one in over}
    rows, winners, near = [], [], []
    for sweep, label in zip(sweeps, over[0].labels):
        ranked = [row for row in sweep.summary.get("ranking", {}).get("demands", {}).get(edp.name, []) if row.get(key) is not None]
        mine = {row["im"]: row for row in ranked if row["im"] in own}
        if len(mine) < len(own):
            return None
        ordered = sorted(mine.values(), key=lambda row: -sign * row[key])
        winners.append(ordered[0]["im"])
        if not _parted(*ordered[:2], key):
            near.append(label)
        rows.append({"design": words.capitalised(label), "cells": [_cell(mine[im], key) for im in own],
                     "best": f"{words.intensity(ranked[0]['im'])}: {_cell(ranked[0], key)}"})
    what = f"what happened ({words.happening(edp.name)})" if edp.kind == "binary" else edp.label
    return {"figure": figure, "columns": list(own.values()), "rows": rows, "finding": _finding(what, own, winners, over[0].labels) + _nearness(near, over[0].labels)}


def _cell(row, key):
    return words.plus_minus(row[key], row[f"{key}_se"] or 0.0)


def _parted(better, other, key):
    """By two standard errors, as if the two were independent: they share their motions, which parts them better than that."""
    return abs(better[key] - other[key]) > 2 * math.hypot(better[f"{key}_se"] or 0.0, other[f"{key}_se"] or 0.0)


def _nearness(near, labels):
    if not near:
        return ""
    return f"; by no more than two standard errors {'in any of them' if len(near) == len(labels) else 'for ' + words.listing(near)}"


def _finding(what, own, winners, labels):
    if len(set(winners)) == 1:
        others = [symbol for im, symbol in own.items() if im != winners[0]]
        return f"{words.capitalised(own[winners[0]])} tells {what} better than {words.listing(others, 'or')}, in each of the designs"
    told = [f"{own[im]} for {label}" for im, label in zip(winners, labels)]
    return f"Which one tells {what} best depends on the design: {words.listing(told)}"
