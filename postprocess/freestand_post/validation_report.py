"""What the page of a validation says: the verdict, the numbers beside it, the tables."""
import math

import numpy as np

from . import validation, words
from .pictures import before_after
from .pictures.peaks import QUANTITY

FAR = 1.5      # times the error that noise alone would make, from which a test counts as missed
MANY = 30      # tests from which the table is folded
SECTIONS = ("ladder", "ranking", "recovered", "worst", "where", "peaks", "outcomes", "before_after", "sweep", "history")
ROLES = {"calibration": "calibration", "holdout": "held out"}


def content(results, figures):
    of = {name: [] for name in SECTIONS}
    for figure in figures:
        of[figure["section"]].append(figure)
    hero = next((of[name][0] for name in ("ladder", "ranking", "outcomes", "peaks", "worst") if of[name]), None)
    if hero:
        of[hero["section"]] = of[hero["section"]][1:]
    return {
        "title": _title(results), "lead": _lead(results), "headline": _headline(results), "hero": hero, "of": of,
        "sentences": _sentences(results), "suggestion": _suggestion(results), "tests": _tests(results),
        "parameters": _parameters(results), "candidates": _candidates(results), "sweep_note": before_after.mismatch(results),
        "provenance": _provenance(results),
    }


def _title(results):
    """The verdict in one line."""
    name, diagnosis, first, last = results.name, results.diagnosis, results.first, results.last
    if diagnosis is None and results.after_found():
        return f"{name}: the model {validation.model_name(last.effects)}, held against the measurements"
    if diagnosis is None:
        return f"{name}: {_compared(last)}"
    effects = validation.effects(diagnosis.effects)
    if diagnosis.verdict == "missing":
        was = "was" if results.after_found() else "is" if len(diagnosis.effects) == 1 else "are"
        return f"{name}: {effects} {'were' if was == 'was' and len(diagnosis.effects) > 1 else was} missing from the model"
    if diagnosis.verdict == "ambiguous":
        return f"{name}: {validation.effects(diagnosis.effects, ' or ')} is missing, and these tests cannot tell which"
    if diagnosis.verdict == "unknown":
        return f"{name}: the model lacks something that no effect of the catalogue explains"
    return f"{name}: no effect is missing from the model"


def _compared(comparison):
    mine = comparison.calibration or comparison.holdout
    value, expected = mine.get("error", math.nan), mine.get("error_expected", math.nan)
    ratio = comparison.peak_ratio.get("ratio", math.nan)
    if comparison.unit == "noise units" and math.isfinite(expected):
        if value < 1.2 * expected:
            return "the model is as good as the noise can tell"
        return f"the model misses its tests by {validation.error(value)} times the sensor noise"
    if comparison.unit == "ln ratio" and math.isfinite(ratio):
        return f"the model predicts {words.number(ratio)} of the measured peaks"
    return f"model against measurement, error {validation.error(value)} ({comparison.unit})"


def _lead(results):
    """What was asked, of what."""
    tests = results.last.tests if results.last else []
    roles = [(sum(test["role"] == role for test in tests), label) for role, label in ROLES.items()]
    parts = [f"{n} {label if label != 'calibration' else 'for calibration'}" for n, label in roles if n]
    number = f"{words.plural(len(tests), 'test')} ({words.listing(parts)})" if tests else "its measurements"
    if results.diagnoses:
        return f"Asked: which physical effect does the model lack against {number}? Error in {_unit(results.unit)}."
    return f"Asked: how well does the model predict {number}, and where does it fail? Error in {_unit(results.unit)}."


def _unit(unit):
    return {"noise units": "noise units (1: as good as the sensors can tell)", "ln ratio": "ln of predicted over measured peak (0: right)",
            "Brier": "Brier score (mean square of probability minus outcome; 0: right)"}.get(unit, unit)


def _headline(results):
    diagnosis, first, last = results.diagnosis, results.first, results.last
    found = []
    if diagnosis:
        best = next((row for row in diagnosis.candidates if row["rival"]), None) or min(
            diagnosis.candidates, key=lambda row: row["error_left_out"], default={})
        found.append((diagnosis.base.get("error_left_out", math.nan), "base model, on tests left out of the fit"))
        found.append((best.get("error_left_out", math.nan), f"with {validation.effect(best.get('effect', ''))}, on tests left out of the fit"))
    else:
        found.append((first.calibration.get("error", math.nan), f"on calibration tests{_of(results, 0)}"))
        if last is not first:
            found.append((last.calibration.get("error", math.nan), f"on calibration tests{_of(results, -1)}"))
    if last:
        found.append((last.holdout.get("error", math.nan), f"on held-out tests, which no fit has seen{_of(results, -1)}"))
    found.append((diagnosis.noise_floor if diagnosis else last.calibration.get("error_expected", math.nan), "noise floor: what noise alone would make"))
    return [(validation.error(value), what) for value, what in found if math.isfinite(value)]


def _of(results, k):
    label = results.labels[k]
    return "" if len(results.comparisons) == 1 else ", base model" if label == "base" else f", {label}"


def _sentences(results):
    """[(heading, [sentence])]: verdict and findings, each once."""
    groups, said = [], set()
    for k, diagnosis in enumerate(results.diagnoses):
        groups.append(("Diagnosis", diagnosis.sentences + diagnosis.findings))
    for label, comparison in zip(results.labels, results.comparisons):
        groups.append(("" if len(results.comparisons) == 1 else "Base model" if label == "base" else
                       words.capitalised(f"model {label}" if label.startswith("with ") else label), comparison.findings))
    kept = []
    for heading, sentences in groups:
        fresh = [words.capitalised(sentence) + ("" if sentence.endswith(".") else ".") for sentence in sentences if sentence not in said]
        said.update(sentences)
        if fresh:
            kept.append((heading, [_named(results, sentence) for sentence in fresh]))
    return kept


def _named(results, sentence):
    """Names of effects as a reader wants to see them."""
    known = {name for diagnosis in results.diagnoses for row in diagnosis.candidates for name in row["effects"]}
    for name in sorted(known, key=len, reverse=True):
        sentence = sentence.replace(name, validation.effect(name)).replace(words.capitalised(name), words.capitalised(validation.effect(name)))
    return sentence


def _suggestion(results):
    found = next((diagnosis.suggestion for diagnosis in results.diagnoses if diagnosis.suggestion), None)
    if not found:
        return None
    motion, rows = found["motion"], []
    for key, label, unit in (("pulse", "pulse", ""), ("period_s", "period", "s"), ("peak_acceleration_g", "peak acceleration", "g"),
                             ("vertical_peak_acceleration_g", "vertical peak acceleration", "g")):
        value = motion.get(key, math.nan)
        if isinstance(value, str) or (math.isfinite(value) and value):
            rows.append((label, value if isinstance(value, str) else words.quantity(value, unit)))
    if found["specimen"]:
        rows.append(("specimen", found["specimen"]))
    if math.isfinite(found["separation_noise_units"]):
        rows.append(("parts them by", f"{validation.error(found['separation_noise_units'])} noise units"))
    return {"between": validation.effects(found["between"]), "sentence": words.capitalised(found["sentence"]), "rows": rows}


def _tests(results):
    """The table of tests: columns, one error column per model, folded where it is long."""
    if not results.last:
        return None
    last = results.last
    kinds = {test["kind"] for test in last.tests}
    quantities = [name for name in QUANTITY if name != "residual_slip_m" and any(name in test["peaks"] for test in last.tests)]
    earlier = [{test["id"]: test for test in comparison.tests} for comparison in results.comparisons]
    table = {"labels": results.labels, "several": len(results.comparisons) > 1, "history": "history" in kinds, "outcome": "outcome" in kinds,
             "quantities": [words.with_unit(QUANTITY[name][1], QUANTITY[name][2]) for name in quantities], "rows": [],
             "missed": 0, "many": len(last.tests) > MANY, "count": len(last.tests)}
    for test in last.tests:
        found = [tests.get(test["id"]) for tests in earlier]
        row = {"id": test["id"], "role": ROLES.get(test["role"], test["role"]), "relative": words.percent(test["error_relative"])
               if math.isfinite(test["error_relative"]) else "–", "explained": test["error_explained"], "expected": test["error_expected"],
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
    return {"measured": words.number(factor * abs(measured), 3), "models": [words.number(factor * abs(model), 3) for model in models]}


def _far(test):
    if test["kind"] == "history":
        value = test["error_explained"] if math.isfinite(test["error_explained"]) else test["error_noise_units"]
        return value > FAR * np.nan_to_num(test["error_expected"], nan=1.0)
    if test["kind"] == "outcome":
        return isinstance(test["overturned_measured"], bool) and (test["overturned_probability"] > 0.5) != test["overturned_measured"]
    measured, model = test["peaks"].get("peak_slip_m", (math.nan, math.nan))
    return math.isfinite(measured) and measured != 0 and not 0.5 < abs(model / measured) < 2


def _parameters(results):
    """Of the last model, with what the diagnosis knows of its intervals; of the best candidate where there is no comparison."""
    rows = [dict(row) for row in results.last.parameters] if results.last else []
    effects = results.last.effects if results.last else []
    candidates = [row for diagnosis in results.diagnoses for row in [diagnosis.base] + diagnosis.candidates if row]
    same = next((row for row in candidates if set(row["effects"]) == set(effects)), None)
    if same:
        known = {entry["name"]: entry["interval"] for entry in same["parameters"]}
        for row in rows:
            if not math.isfinite(row["interval"][0]) and math.isclose(row["value"], next(
                    (entry["value"] for entry in same["parameters"] if entry["name"] == row["name"]), math.nan), rel_tol=1e-2):
                row["interval"] = known.get(row["name"], row["interval"])
    elif not rows and candidates:
        rows = []
    return [_parameter(row) for row in rows]


def _parameter(row):
    low, high = row["interval"]
    unit = "" if row["unit"] in ("", "1") else words.UNITS.get(row["unit"], row["unit"])
    bounds = [row.get("lower", math.nan), row.get("upper", math.nan)]
    return {"name": validation.parameter(row["name"]), "value": words.number(row["value"], 4), "unit": unit,
            "interval": f"{words.number(low, 4)} to {words.number(high, 4)}" if math.isfinite(low) and math.isfinite(high) else "–",
            "bounds": f"{words.plain(bounds[0])} to {words.plain(bounds[1])}" if np.isfinite(bounds).all() else "–"}


def _candidates(results):
    """Every candidate of the first diagnosis with its numbers."""
    if not results.diagnosis:
        return []
    rows = []
    base = dict(results.diagnosis.base, effect="") if results.diagnosis.base else None
    for row in ([base] if base else []) + results.diagnosis.candidates:
        values = [_parameter(entry) for entry in row["parameters"]]
        rows.append({"name": validation.effect(row["effect"]) or "base model", "visible": row["visible"], "rival": row["rival"] and row is not base,
                     "calibration": row["error_calibration"], "left_out": row["error_left_out"], "se": row["error_left_out_se"],
                     "delta_bic": words.count(row["delta_bic"]).replace("-", "−") if math.isfinite(row["delta_bic"]) else "–",
                     "values": "; ".join(_short(value) for value in values)})
    return rows


def _short(value):
    name = value["name"].split(": ")[-1]
    return f"{name} {value['value']}" + (f" {value['unit']}" if value["unit"] else "") + \
        (f" ({value['interval']})" if value["interval"] != "–" else "")


PROVENANCE = (("created_utc", "written (UTC)"), ("version", "freestand"), ("git_commit", "commit"), ("command", "command"),
              ("study", "study"), ("measurements", "measurements"), ("method", "method of the fit"))


def _provenance(results):
    rows = []
    for document in results.comparisons + results.diagnoses:
        for key, label in PROVENANCE:
            value = document.raw.get(key)
            if isinstance(value, str) and value and (label, value) not in rows:
                rows.append((label, value))
    rows.sort(key=lambda row: [label for _, label in PROVENANCE].index(row[0]))
    folders = [str(document.folder) for document in results.comparisons + results.diagnoses + results.sweeps]
    return rows + [("folders", ", ".join(folders))]
