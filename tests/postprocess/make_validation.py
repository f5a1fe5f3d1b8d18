"""comparison.json and diagnosis.json with invented numbers, in the layout that freestand writes, for the tests of postprocess."""
import json
import pathlib

import numpy as np

NOISE = 0.0004


def write(folder, name, value):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(json.dumps(value))
    return folder


def history(test, off, channels=("slip_m",), role="calibration"):
    """A slip that the model misses by `off` times the noise after the first second."""
    random = np.random.default_rng(7)
    time = np.arange(0, 4, 0.01)
    value = {"id": test, "role": role, "dt_s": 0.01, "time_s": time.tolist(),
             "floor_acceleration_mps2": (4 * np.sin(4 * time) * (time < 3)).tolist()}
    for name in channels:
        measured = 0.02 * np.clip(time - 0.5, 0, 1) + NOISE * random.normal(size=time.size)
        model = 0.02 * np.clip(time - 0.5, 0, 1) + off * NOISE * np.clip(time - 1, 0, 1)
        value[name] = {"noise": NOISE, "measured": measured.tolist(), "model": model.tolist(), "residual": (model - measured).tolist(),
                       "spread": [None] * time.size}
    return value


def tables(error):
    """Against phase (one empty), speed and path."""
    def table(variable, unit, label, centre, value):
        edge = [] if label else [c - 0.05 for c in centre] + [centre[-1] + 0.05]
        return {"variable": variable, "unit": unit, "label": label, "edge": edge, "centre": centre, "count": [40.0] * len(value),
                "error_noise_units": value, "growth_noise_units": [v and 0.3 * v + 1 for v in value],
                "growth_slip_m": [v and NOISE * (0.3 * v + 1) for v in value], "growth_rotation_rad": [v and 0.0 for v in value], "bias_noise_units": value}
    phases = ["stuck", "onset", "slipping", "reversal", "rocking", "after impact", "at rest"]
    centre = [0.1, 0.2, 0.3, 0.4]
    return [table("phase", "1", phases, [], [error, 1.1 * error, 2 * error, error, None, None, error]),
            table("speed_mps", "m/s", [], centre, [error, 1.5 * error, None, error]),
            table("path_m", "m", [], [0.00003, 0.00006, 0.00011, 0.00015], [error, error, 1.2 * error, error])]


def history_tests(error):
    found = []
    for i in range(4):
        value = error * (1 + 0.1 * i)
        found.append({"id": f"t0{i + 1}", "role": "holdout" if i == 3 else "calibration", "kind": "history", "source": "t.csv",
                      "error_noise_units": value, "error_relative": 0.01 * value, "error_floor_noise_allowed": 0.95 * value, "error_expected": 1.03,
                      "outcome": "moved", "channels": [],
                      "peaks": [{"name": "peak_slip_m", "measured": 0.04, "model": 0.04 + 0.001 * error}]})
    return found


def comparison(folder, effects=(), error=17.4, held_out=13.8, channels=("slip_m",), **changes):
    ratio = {"name": "effects.static_friction.ratio", "unit": "1", "value": 1.8, "lower": 1.0, "upper": 10.0, "interval": None,
             "calibrated": False}
    value = {"format": "freestand-comparison/2", "study": "study.yaml", "measurements": "/data/bench/dataset.yaml", "name": "bench",
             "effects": list(effects), "error_unit": "noise units", "method": "simplex method", "tests": history_tests(error),
             "findings": [f"calibration tests are missed by {error} noise units"],
             "calibration": {"error_noise_units": error, "error_relative": 0.2, "error": error, "error_expected": 1.03, "tests": 3},
             "holdout": {"error_noise_units": held_out, "error_relative": 0.1, "error": held_out, "error_expected": 1.04, "tests": 1},
             "parameters": [{"name": "friction.mu", "unit": "1", "value": 0.2991, "lower": 0.03, "upper": 1.2,
                             "interval": [0.284, 0.314], "calibrated": True}] + [ratio] * bool(effects),
             "peak_ratio": {"count": 4, "ratio": 1.09, "bias_ln": 0.09, "scatter_ln": 0.2},
             "histories": [history("t02", error, channels), history("t04", 0.8 * error, channels, "holdout")],
             "error_tables": {"calibration": tables(error), "holdout": tables(held_out)}, "ladder": []}
    return write(folder, "comparison.json", value | changes)


def peaks(folder, ratio=0.2, name="bench", stuck=0, stood=0):
    """Only peaks were measured; in the first `stuck` tests the model does not move, in the last `stood` the specimen did not."""
    random = np.random.default_rng(3)
    found = []
    for i, measured in enumerate(np.geomspace(0.01, 0.3, 9)):
        model = 0.0 if i < stuck else float(measured * ratio * np.exp(0.3 * random.normal()))
        measured = 0.0 if i >= 9 - stood else measured
        found.append({"id": f"a{i}", "role": "calibration", "kind": "peaks", "source": "pulse B", "error_noise_units": None,
                      "error_relative": 0.5, "error_floor_noise_allowed": None, "error_expected": None, "outcome": "moved", "channels": [],
                      "peaks": [{"name": "peak_slip_m", "measured": float(measured), "model": model}]})
    return comparison(folder, name=name, error_unit="ln ratio", tests=found, histories=[], holdout=None,
                      error_tables={"calibration": [], "holdout": []},
                      calibration={"error_noise_units": None, "error_relative": 0.8, "error": 1.6, "error_expected": None, "tests": 9},
                      peak_ratio={"count": 9, "ratio": ratio, "bias_ln": float(np.log(ratio)), "scatter_ln": 0.3, "within_ln": 0.23, "biased": abs(float(np.log(ratio))) > 0.23})


def outcomes(folder, intensity=False, number=40):
    """Only falling or standing was measured; every tenth test ends on the wrong side."""
    found = []
    for i in range(number):
        p = i / (number - 1)
        over = (p > 0.5) != (i % 10 == 3)
        found.append({"id": f"b{i:03d}", "role": "calibration", "kind": "outcome", "source": "m.csv", "error_noise_units": None,
                      "error_relative": None, "error_floor_noise_allowed": None, "error_expected": None, "outcome": "moved", "channels": [],
                      "peaks": [], "overturned_measured": over, "overturned_probability": p}
                     | ({"floor_peak_g": 0.05 + 0.6 * p} if intensity else {}))
    return comparison(folder, error_unit="Brier", tests=found, histories=[], holdout=None, peak_ratio={"count": 0, "ratio": None,
                      "bias_ln": None, "scatter_ln": None}, error_tables={"calibration": [], "holdout": []},
                      calibration={"error_noise_units": None, "error_relative": None, "error": 0.15, "error_expected": None,
                                   "tests": number})


def candidate(effect, left_out, rival=False):
    return {"effect": effect, "effects": [part for part in effect.split("+") if part], "visible": True,
            "parameters": {"friction.mu": {"value": 0.2816, "unit": "1", "interval": [0.2803, 0.283]},
                           **({f"effects.{effect}.speed_mps": {"value": 0.1, "unit": "m/s", "interval": None,
                                                                                  "no_interval": "it was not fitted to the end"}} if effect else {})},
            "error_calibration": 0.9 * left_out, "error_left_out": left_out, "error_left_out_se": 0.15 * left_out,
            "error_left_out_floor_noise_allowed": 1.0, "chi_square_left_out": 9.0, "delta_bic": -1000.0 / left_out, "score_left_out_above_best": 0.0, "score_left_out_above_best_se": 0.1,
            "as_good_as_best": rival, "numbers_as_met_in_practice": True, "left_out_refitted": True}


def recovered():
    speed = np.linspace(0.05, 0.9, 8)
    law = 0.2 + 0.1 * np.exp(-speed / 0.1)

    def table(variable, unit, centre, mu, share, law):
        mu = np.asarray(mu, float)
        return {"variable": variable, "unit": unit, "edge": [], "centre": list(map(float, centre)), "count": [16.0] * len(mu),
                "mu": mu.tolist(), "mu_deviation": (0.1 * mu).tolist(), "mu_lower": (mu - 0.02).tolist(),
                "mu_upper": (mu + 0.02).tolist(), "force_mps2": [0.1] * len(mu), "force_lower_mps2": [0.0] * len(mu),
                "force_upper_mps2": [0.2] * len(mu), "share_explained": share,
                "law": {"effects": ["rate_weakening"], "mu": list(map(float, law)), "follows": variable == "speed_mps"}}
    empty = table("normal_g", "g", [], [], 0.0, [])
    return {"samples": 200, "base_mu": 0.25, "mean_mu": 0.24, "sample_noise_mu": 0.02,
            "tables": [table("time_s", "s", [1, 2, 3], [0.24, 0.25, 0.24], 0.01, [0.3] * 3),
                       table("speed_mps", "m/s", speed, law + 0.004, 0.6, law),
                       table("direction", "1", [-1, 1], [0.26, 0.22], 0.1, [0.3, 0.3]), empty]}


def chance(question, about, p):
    return {"question": question, "about": about, "p": p, "level": 0.05, "observed": 30.0, "chance_reaches": 10.0, "simulations": 2000,
            "tries": 13 if question == "is its gain luck" else 1, "told_apart": 0.92 if question == "is the lead chance" else None}


def diagnosis(folder, verdict="missing", **changes):
    rivals = {"missing": 1, "ambiguous": 2}.get(verdict, 0)
    names = ["rate_weakening", "static_friction", "floor_tilt", "wall_impact"] + [f"effect_{i}" for i in range(9)]
    floor = {"none": 17.0, "unknown": 6.0}.get(verdict, 1.2)
    found = [candidate(name, floor if i < max(rivals, 1) else floor + 1.2 * i, i < rivals) for i, name in enumerate(names)]
    suggestion = {"between": names[:2], "specimen": None, "separation_noise_units": 41.9,
                  "motion": {"pulse": "C2", "period_s": 1.2, "peak_acceleration_g": 1.0, "vertical_peak_acceleration_g": 0.6},
                  "sentence": "a pulse C2 of 1.2 s and 1 g would part them by 41.9 noise units"}
    value = {"format": "freestand-diagnosis/2", "study": "study.yaml", "measurements": "/data/bench/dataset.yaml", "name": "bench",
             "error_unit": "noise units", "verdict": verdict, "effects": names[:rivals],
             "best": next((each["effect"] for each in changes.get("candidates", found)), None),
             "reason": "none_suffices" if verdict == "unknown" else None,
             "sentences": ["rate_weakening brings the left-out error from 17.7 to 1.2"], "findings": [],
             "noise_floor": 1.08, "base": candidate("", 17.7), "candidates": found, "recovered_force": recovered(),
             "suggested_motion": suggestion if verdict == "ambiguous" else None,
             "tests_of_chance": [chance("does an effect help", "13 effects", 0.0005)]
             + [chance("is it enough", "the model as it is", 0.0005), chance("does one more help", names[0], 0.4), chance("is its gain luck", names[0], 0.0065)]
             + [chance("is the lead chance", f"{names[0]} before {name}", p) for name, p in ((names[1], 0.31 if rivals > 1 else 0.012), (names[2], 0.0005))]}
    return write(folder, "diagnosis.json", value | changes)
