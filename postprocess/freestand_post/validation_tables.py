"""The tables on the page of a validation: tests, fitted numbers, candidates."""
import math
import pathlib

import numpy as np

from . import validation, words
from .pictures.peaks import QUANTITY

FAR = 1.5      # times the error that noise alone would make, from which a test counts as missed
MANY = 30      # tests from which the table is folded
ROLES = {"calibration": "calibration", "holdout": "held out"}


def tests(results):
    """The table of tests: columns, one error column per model, folded where it is long."""
    if not results.last:
        return None
    last = results.last
    kinds = {test["kind"] for test in last.tests}
    quantities = [name for name in QUANTITY if name != "residual_slip_m" and any(name in test["peaks"] for test in last.tests)]
    earlier = [{test["id"]: test for test in comparison.tests} for comparison in results.comparisons]
    table = {"labels": results.labels, "several": len(results.comparisons) > 1, "history": "history" in kinds,
             "of_mean": any(math.isfinite(test["error_of_mean"]) for test in last.tests), "outcome": "outcome" in kinds, "peaks_only": kinds == {"peaks"}, "quantities": [words.with_unit(QUANTITY[name][1], QUANTITY[name][2]) for name in quantities], "rows": [],
             "allowing": "allowing for floor noise" + " and a friction of its own" * any(math.isfinite(test["own_friction"]) for test in last.tests),
             "missed": 0, "many": len(last.tests) > MANY, "count": len(last.tests)}
    for test in last.tests:
        found = [tests.get(test["id"]) for tests in earlier]
        row = {"id": test["id"], "role": ROLES.get(test["role"], test["role"]),
               "relative": words.percent(test["error_relative"]) if math.isfinite(test["error_relative"]) else "–",
               "explained": test["error_floor_noise_allowed"], "expected": test["error_expected"], "of_mean": test["error_of_mean"],
               "errors": [other["error_noise_units"] if other else math.nan for other in found],
               "peaks": [_peak(test, found, name) for name in quantities], "measured": "", "probabilities": [], "far": _far(test)}
        if test["kind"] == "outcome" or isinstance(test["overturned_measured"], bool):
            row["measured"] = "overturned" if test["overturned_measured"] else "stood"
        row["probabilities"] = [words.probability(other["overturned_probability"]) if other else "–" for other in found]
        table["missed"] += row["far"]
        table["rows"].append(row)
    return table


def _peak(test, found, name):
    """Measured, and what every model gives."""
    factor = QUANTITY[name][0]
    measured = test["peaks"].get(name, (math.nan, math.nan))[0]
    models = [other["peaks"].get(name, (math.nan, math.nan))[1] if other else math.nan for other in found]
    ratio = abs(models[-1] / measured) if measured else math.nan
    return {"measured": words.number(factor * abs(measured), 3), "models": [words.number(factor * abs(model), 3) for model in models],
            "ratio": words.number(ratio, 3) if math.isfinite(ratio) else "–"}


def _far(test):
    if test["kind"] == "history":
        value = test["error_floor_noise_allowed"] if math.isfinite(test["error_floor_noise_allowed"]) else test["error_noise_units"]
        return value > FAR * np.nan_to_num(test["error_expected"], nan=1.0)
    if test["kind"] == "outcome":
        return isinstance(test["overturned_measured"], bool) and (test["overturned_probability"] > 0.5) != test["overturned_measured"]
    if isinstance(test["overturned_measured"], bool) and test["overturned_measured"] != (test["outcome"] == "overturned"):
        return True
    measured, model = test["peaks"].get("peak_slip_m", (math.nan, math.nan))
    if measured == 0:
        return abs(model) > 0
    return math.isfinite(measured) and not 0.5 < abs(model / measured) < 2


def parameters(results):
    """Of the last model, with what the diagnosis knows of its intervals; without a comparison of the effect that the diagnosis
    names, or of the base."""
    if not results.last:
        named = results.diagnosis.best if results.diagnosis.effects else results.diagnosis.base
        return [_parameter(row) for row in named.get("parameters", [])]
    rows = [dict(row) for row in results.last.parameters]
    fitted = [row for diagnosis in results.diagnoses for row in [diagnosis.base] + diagnosis.candidates if row]
    same = next((row for row in fitted if set(row["effects"]) == set(results.last.effects)), None)
    if same:
        known = {entry["name"]: entry["interval"] for entry in same["parameters"]}
        for row in rows:
            if not math.isfinite(row["interval"][0]) and math.isclose(row["value"], next(
                    (entry["value"] for entry in same["parameters"] if entry["name"] == row["name"]), math.nan), rel_tol=1e-2):
                row["interval"] = known.get(row["name"], row["interval"])
    return [_parameter(row) for row in rows]


def _parameter(row):
    unit = "" if row["unit"] in ("", "1") else words.UNITS.get(row["unit"], row["unit"])
    bounds = [row.get("lower", math.nan), row.get("upper", math.nan)]
    return {"name": validation.parameter(row["name"]), "value": words.number(row["value"], 4), "unit": unit,
            "interval": _interval(*row["interval"], row.get("open", "")) or (f"none: {row['no_interval']}" if row.get("no_interval") else "–"),
            "bounds": f"{words.plain(bounds[0])} to {words.plain(bounds[1])}" if np.isfinite(bounds).all() else "–"}


def _interval(low, high, open_end):
    """open_end: where the tests leave the number open, and its range alone ends the interval."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return ""
    low, high = words.number(low, 4), words.number(high, 4)
    return {"both": "not determined", "above": f"{low} or more", "below": f"{high} or less"}.get(open_end, f"{low} to {high}")


def candidates(results):
    """Every candidate of the first diagnosis with its numbers."""
    if not results.diagnosis:
        return []
    rows = []
    base = dict(results.diagnosis.base, effect="") if results.diagnosis.base else None
    for row in ([base] if base else []) + results.diagnosis.candidates:
        values = [_parameter(entry) for entry in row["parameters"]]
        rows.append({"name": validation.effect(row["effect"]) or "base model", "visible": row["visible"], "judged": row["left_out_refitted"],
                     "remark": row["remark"] if row["left_out_refitted"] else "",
                     "rival": row["as_good_as_best"] and row is not base, "calibration": row["error_calibration"], "left_out": row["error_left_out"], "se": row["error_left_out_se"],
                     "delta_bic": words.count(round(row["delta_bic"])).replace("-", "−") if math.isfinite(row["delta_bic"]) else "–",
                     "values": "; ".join(_short(value) for value in values)})
    return rows


def proposal(results):
    """The law that is proposed after the verdict unknown: its formula, its numbers, and how it is added."""
    found = results.diagnosis.proposal if results.diagnosis else {}
    if not found:
        return {}
    return {"beside": ("Several effects of the catalogue would be enough together, with more numbers." if results.diagnosis.reason == "one_law" else
                        "No effect of the catalogue is enough."),
            "law": found["law"], "rows": [_parameter(row) for row in found["parameters"]],
            "error": validation.error(found["error_left_out"]), "base": validation.error(results.diagnosis.base.get("error_left_out", math.nan)),
            "command": f"freestand add {pathlib.Path(results.diagnosis.raw.get('study') or 'STUDY.yaml').name} "
                       f"{results.diagnosis.folder.name}/proposed_law.yaml -o WITH_LAW.yaml"}


def chances(results):
    """How likely chance is to do what the verdict rests on."""
    if not results.diagnosis:
        return []
    return [{"question": _question(row, results.diagnosis.unit == "ln ratio"), "p": words.number(row["p"], 2) if row["p"] * row["simulations"] > 1.5 * _tries(row) else
             f"less than {words.number(_tries(row) / max(row['simulations'], 1), 2)}", "sets": words.count(row["simulations"]),
             "apart": f"{100 * row['told_apart']:.0f} %" if math.isfinite(row["told_apart"]) else ""}
            for row in results.diagnosis.chances]


def _tries(row):
    tries = row.get("tries", math.nan)
    return tries if math.isfinite(tries) else 1


def _question(row, of_peaks):
    if row["question"] == "does an effect help":
        return f"that the best of {row['about']} gains as much where nothing is missing"
    if row["question"] == "is it enough" and of_peaks:
        return f"that {_named(row['about'])} misses tests by so much more than one test misses another where it is the truth"
    if row["question"] == "is it enough":
        return f"that {_named(row['about'])} leaves as much where it is the truth"
    if row["question"] == "does one more help":
        return f"that one more effect gains as much where {_named(row['about'])} is the truth"
    if row["question"] == "is its gain luck":
        return f"that one of all effects tried gains as much as {_named(row['about'])} by the readings which the floor's noise does not turn elsewhere"
    best, _, rival = row["about"].partition(" before ")
    return f"that {_named(best)} leads {_named(rival)} by as much where {_named(rival)} is the truth"


def _named(effects):
    if effects == "the model as it is":
        return effects
    return words.listing(validation.effect(name) for name in effects.split(" and "))


def _short(value):
    name = value["name"].split(": ")[-1]
    return f"{name} {value['value']}" + (f" {value['unit']}" if value["unit"] else "") + \
        (f" ({value['interval']})" if value["interval"] != "–" else "")
