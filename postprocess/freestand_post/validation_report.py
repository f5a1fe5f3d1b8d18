"""What the page of a validation says: the verdict, the numbers beside it, the sentences."""
import math
import re

from . import validation, verdict, words
from . import validation_tables as tables
from .pictures import before_after, outcomes

FANNED_OUT = 5  # noise units that the floor's noise makes, beyond which a test tells little; as in the findings of `compare`
SECTIONS = ("ladder", "ranking", "recovered", "worst", "where", "peaks", "outcomes", "before_after", "sweep", "history", "draws")


def content(results, figures):
    of = {name: [] for name in SECTIONS}
    for figure in figures:
        of[figure["section"]].append(figure)
    reason = results.diagnosis.reason if results.diagnosis else ""
    unknown = results.diagnosis is not None and results.diagnosis.verdict == "unknown"
    order = () if reason == verdict.WITHDRAWN else ("recovered",) * unknown + ("ladder", "ranking", "outcomes", "peaks", "worst")
    hero = next((of[name][0] for name in order if of[name]), None)
    if hero:
        of[hero["section"]] = of[hero["section"]][1:]
    return {
        "title": _title(results), "lead": _lead(results), "headline": _headline(results), "hero": hero, "of": of,
        "sentences": _sentences(results), "suggestion": _suggestion(results), "tests": tables.tests(results),
        "parameters": tables.parameters(results), "candidates": tables.candidates(results), "chances": tables.chances(results), "proposal": tables.proposal(results), "sweep_note": before_after.mismatch(results),
        "candidates_text": f"All {words.plural(len(results.diagnosis.candidates), 'candidate')}" if results.diagnosis else "",
        "fitted_model": _fitted_model(results), "provenance": _provenance(results),
    }


def _fitted_model(results):
    """Whose numbers the page shows, where it is not plain."""
    if results.last:
        return results.labels[-1] if len(results.comparisons) > 1 else ""
    return validation.model_name(results.diagnosis.best.get("effects", [])) if results.diagnosis.effects else "base model"


def _title(results):
    """The verdict in one line."""
    name, diagnosis, last = results.name, results.diagnosis, results.last
    if diagnosis is None and results.after_found():
        return f"{name}: the model {validation.model_name(last.effects)}, held against the measurements"
    if diagnosis is None:
        return f"{name}: {_compared(last)}"
    was = results.after_found() and set(diagnosis.effects) <= set(last.effects)
    return f"{name}: {verdict.title(diagnosis, was)}"


def _compared(comparison):
    mine = comparison.calibration or comparison.holdout
    value, expected = mine.get("error", math.nan), mine.get("error_expected", math.nan)
    ratio = comparison.peak_ratio.get("ratio", math.nan)
    if comparison.unit == "noise units" and math.isfinite(expected):
        role = "calibration" if comparison.calibration else "holdout"
        tests = [test for test in comparison.tests if test["role"] == role]
        told = [test for test in tests if test["error_expected"] <= FANNED_OUT]
        whose = "its tests"
        if 0 < len(told) < len(tests):
            whose = "those tests that the floor's noise does not drown"
            value, expected = (math.sqrt(sum(test[key] ** 2 for test in told) / len(told)) for key in ("error_noise_units", "error_expected"))
        if value < 1.2 * expected and expected > FANNED_OUT:
            return "the floor's noise alone drowns its tests, which cannot judge the model"
        if value < 0.8 * expected:
            return f"the model is nearer to {whose} than the noise alone would be"
        if value < 1.2 * expected:
            return "the model is as good as the noise can tell"
        return f"the model misses {whose} by {validation.error(value)} times the sensor noise"
    if comparison.unit == "ln ratio" and math.isfinite(ratio):
        return f"the model predicts {words.number(ratio)} times the measured peaks"
    right, known = outcomes.score(comparison)
    if known:
        return f"the model gets {right} of {known} outcomes right"
    return f"model against measurement, error {validation.error(value)} ({comparison.unit})"


def _lead(results):
    """What was asked, of what."""
    tests = results.last.tests if results.last else []
    roles = [(sum(test["role"] == role for test in tests), label) for role, label in tables.ROLES.items()]
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
        known = ", the friction of each test known" * bool((diagnosis.raw.get("friction_scatter") or {}).get("beside"))
        best = diagnosis.best
        found.append((diagnosis.base.get("error_left_out", math.nan), f"base model, on tests left out of the fit{known}"))
        best = diagnosis.proposal or best
        name = validation.effect(best.get("effect", ""))
        found.append((best.get("error_left_out", math.nan), verdict.best_in_words(diagnosis, name) + known))
    else:
        for k in sorted({0, len(results.comparisons) - 1}):
            comparison = results.comparisons[k]
            if comparison.unit == "ln ratio":
                found.append((comparison.peak_ratio.get("ratio", math.nan), f"predicted over measured peak{_of(results, k)}"))
                found.append((comparison.peak_ratio.get("scatter_ln", math.nan), f"scatter of its logarithm{_of(results, k)}"))
            else:
                unit = "Brier score " if comparison.unit == "Brier" else ""
                found.append((comparison.calibration.get("error", math.nan), f"{unit}on calibration tests{_of(results, k)}"))
    if last:
        own = ", with a friction of its own in each" * results.own_friction
        found.append((last.holdout.get("error_floor_noise_allowed" if own else "error", math.nan),
                      f"on held-out tests, which no fit has seen{own}{_of(results, -1)}"))
    return [(validation.error(value), what) for value, what in found if math.isfinite(value)] + _noise_floor(results)


def _noise_floor(results):
    """One number, or why there are more."""
    if results.unit == "Brier":
        value = results.diagnosis.noise_floor if results.diagnosis else results.last.calibration.get("error_expected", math.nan)
        return [(validation.error(value), "what chance alone would make")] if math.isfinite(value) else []
    low, high = map(validation.error, results.noise_floors())
    if low == "–":
        return []
    what = "noise floor: what noise alone would make"
    return [(low, what)] if low == high else \
        [(f"{low} to {high}", f"{what}, which models and tests answer differently")]


def _of(results, k):
    label = results.labels[k]
    return "" if len(results.comparisons) == 1 else ", base model" if label == "base" else f", {label}"


def _sentences(results):
    """[(heading, [sentence])]: verdict and findings, each once."""
    groups, said = [], set()
    for k, diagnosis in enumerate(results.diagnoses):
        groups.append(("Diagnosis" if k == 0 else f"Diagnosis {k + 1}", diagnosis.sentences + diagnosis.findings))
    for label, comparison in zip(results.labels, results.comparisons):
        groups.append(("" if len(results.comparisons) == 1 else "Base model" if label == "base" else
                       f"Model {label}" if label.startswith("with ") else label, comparison.findings))
    kept = []
    for heading, sentences in groups:
        fresh = [_capitalised(sentence) + ("" if sentence.endswith((".", "?")) else ".") for sentence in sentences if sentence not in said]
        said.update(sentences)
        if fresh:
            kept.append((heading, [_named(results, sentence) for sentence in fresh]))
    return kept


def _capitalised(sentence):
    """A sentence that starts with a key keeps it."""
    first = sentence.split(" ", 1)[0]
    return sentence if "." in first else words.capitalised(sentence)


def _named(results, sentence):
    """Names of effects and variables as a reader wants to see them."""
    known = {name for diagnosis in results.diagnoses for row in diagnosis.candidates for name in row["effects"]}
    known.update(name for comparison in results.comparisons for name in comparison.effects)
    if sentence.startswith("Not tried"):
        known.update(re.findall(r"[a-z]+(?:_[a-z]+)+", sentence.rsplit(":", 1)[-1]))
    for name in sorted(known, key=len, reverse=True):
        shown = validation.effect(name)
        sentence = sentence.replace(name, shown).replace(words.capitalised(name), words.capitalised(shown))
    for name in validation.VARIABLES:
        if "_" in name:
            sentence = re.sub(rf"(?<![\w.]){name}(?![\w.])", validation.VARIABLES[name], sentence)
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
    if math.isfinite(found["separation_noise_units"]) and "noise units" in found["sentence"]:
        rows.append(("parts them by", f"{validation.error(found['separation_noise_units'])} noise units"))
    return {"between": validation.effects(found["between"]), "sentence": words.capitalised(found["sentence"]), "rows": rows}


PROVENANCE = (("created_utc", "written (UTC)"), ("version", "freestand"), ("git_commit", "commit"), ("command", "command"),
              ("study", "study"), ("measurements", "measurements"), ("method", "method of the fit"))


def _fitted(document):
    """A comparison at given numbers fits nothing."""
    return not hasattr(document, "parameters") or any(row.get("calibrated") for row in document.parameters)


def _provenance(results):
    rows = []
    for document in results.comparisons + results.diagnoses:
        for key, label in PROVENANCE:
            value = document.raw.get(key) if key != "method" or _fitted(document) else None
            if isinstance(value, str) and value and (label, value) not in rows:
                rows.append((label, value))
    rows.sort(key=lambda row: [label for _, label in PROVENANCE].index(row[0]))
    folders = [str(document.folder) for document in results.comparisons + results.diagnoses + results.sweeps]
    return rows + [("folders", ", ".join(folders))]
