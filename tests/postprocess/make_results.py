#!/usr/bin/python3
"""Small result folders with invented numbers, in the layout that freestand writes, for the tests of postprocess.

    make_results.py sweep DIR [SAMPLES]     samples.h5, fragility.h5, bins.csv, surface.csv, summary.json
    make_results.py history DIR             history.csv, summary.json

The demand of a sample is lognormal about a line in ln IM; one bin holds a mixture, so that it fails its test of fit; one
bin is nearly empty. Nothing here knows dynamics.
"""
import csv
import json
import pathlib
import sys

import h5py
import numpy as np
from scipy import stats

OUTCOMES = ["at_rest", "moved", "overturned", "painleve", "step_limit", "not_finite"]
EDGES = np.array([-1, -0.5, 0, 0.5, 1, 1.5, 2.25, 3, 4, 5, 6, 8.7, 9])  # two bins stand still, the last is nearly empty
ADEQUATE = 0.065  # of so few samples
CAPACITY = np.array([0.5, 1.0, 2.0, 3.0])
CELLS = 60
STUDY = """seed: 1
samples: {samples}
design: sobol
block: {{width_m: {{uniform: [0.5, 0.9]}}, height_m: {{uniform: [1.5, 2.0]}}, mass_kg: 150}}
friction: {{mu: {{uniform: [0.2, 0.8]}}}}
motions:
  - {{pulse: [A, B, C1], period_s: {{uniform: [0.3, 2.0]}}, peak_acceleration_g: {{uniform: [0.1, 2.0]}}}}
fragility: {{im: report, bins: {{count: 12}}, edp: [delta, peak_rotation_over_alpha, overturned]}}
"""


def draw(samples, seed):
    """The columns of /samples: name -> (values, unit, description)."""
    random = np.random.default_rng(seed)
    width = random.uniform(0.5, 0.9, samples)
    height = random.uniform(1.5, 2.0, samples)
    mu = random.uniform(0.2, 0.8, samples)
    period = random.uniform(0.3, 2.0, samples)
    pta = random.uniform(0.1, 2.0, samples)
    im = pta / mu - 1
    tip = np.log(np.maximum(pta * height / width, 1e-9)) + 0.5 * np.log(period)
    over = tip + 0.35 * random.normal(size=samples) > 1.5
    still = (im < 0) | (random.uniform(size=samples) < 0.3 * np.exp(-2 * np.maximum(im, 0)))
    outcome = np.where(over & ~still, 2, np.where(still, 0, 1)).astype(np.int32)
    outcome[:3] = [3, 4, 1]
    noise = random.normal(size=samples)
    mixed = (im > 2.25) & (im < 3.0)
    noise = np.where(mixed, np.where(noise > 0, 1.6, -1.6) + 0.2 * noise, noise)
    delta = np.exp(-0.9 + 1.15 * np.log(np.maximum(im, 1e-3)) + 0.8 * (0.5 - mu) + 0.45 * noise)
    rotation = np.exp(-2.2 + 0.8 * tip + 0.3 * random.normal(size=samples))
    moved = outcome == 1
    return {
        "block_width_m": (width, "m", "width of the block"),
        "block_height_m": (height, "m", "height of the block"),
        "friction_mu_k": (mu, "1", "kinetic friction coefficient"),
        "pulse_period_s": (period, "s", "period of the pulse"),
        "pta_g": (pta, "g", "peak floor acceleration"),
        "scale": (pta * 9.80665, "1", "factor on the motion"),
        "motion": (random.integers(0, 3, samples).astype(np.int32), "1", "index into /motions/name"),
        "edp_delta": (np.where(moved, delta, np.where(outcome == 0, 0.0, np.nan)), "1", "U w_p^2 / PTA"),
        "edp_peak_rotation_over_alpha": (np.where(moved, rotation, np.where(outcome == 0, 0.0, np.nan)), "1", "peak rotation / alpha"),
        "edp_connection_failed": ((random.uniform(size=samples) < 0.09 * np.maximum(im, 0)).astype(np.uint8), "1", "connection failed"),
        "edp_overturned": ((outcome == 2).astype(np.uint8), "1", "overturned"),
        "outcome": (outcome, "1", "how the sample ended"),
        "impacts": (random.poisson(2, samples).astype(np.int32), "1", "rocking impacts"),
        "events": (random.poisson(9, samples).astype(np.int32), "1", "mode changes and impacts"),
    }


def binomial(k, n):
    """Exact (Clopper-Pearson) 95 % interval."""
    low = stats.beta.ppf(0.025, k, n - k + 1) if k > 0 else 0.0
    high = stats.beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
    return low, high


def exceedance(part, capacity):
    """Three parts: overturned, still, lognormal."""
    tail = stats.norm.sf((np.log(capacity) - part["lambda"]) / part["omega"])
    return part["p_over"] + (1 - part["p_over"]) * (1 - part["p_still"]) * tail


def count_bin(still, over):
    """The counted columns of one bin; the rest is nan."""
    n, n_still, n_over = len(still), int(still.sum()), int(over.sum())
    part = {name: np.nan for name in PER_BIN}
    part.update(n=n, n_still=n_still, n_over=n_over, n_moved=n - n_still - n_over, fdr_rejected=0, status=3 if n >= 30 else 1)
    if n == 0:
        return part
    part["p_over"], standing = n_over / n, n - n_over
    part["p_over_lower"], part["p_over_upper"] = binomial(n_over, n)
    if standing:
        part["p_still"] = n_still / standing
        part["p_still_lower"], part["p_still_upper"] = binomial(n_still, standing)
    return part


def fit_bin(values, still, over, random):
    """One bin of one EDP as a dictionary of the per-bin columns."""
    part, moved = count_bin(still, over), np.log(values[~still & ~over])
    if len(moved) < 30:
        return part
    lam, omega = moved.mean(), moved.std()
    part.update({"lambda": lam, "omega": omega, "lambda_se": omega / np.sqrt(len(moved)),
                 "omega_se": omega / np.sqrt(2 * len(moved)), "mean": np.exp(lam + omega**2 / 2),
                 "standard_deviation": np.exp(lam + omega**2 / 2) * np.sqrt(np.expm1(omega**2))})
    statistic = stats.kstest((moved - lam) / omega, "norm").statistic
    repeats = random.normal(size=(200, min(len(moved), 400)))
    repeats = (repeats - repeats.mean(1, keepdims=True)) / repeats.std(1, keepdims=True)
    null = np.array([stats.kstest(row, "norm").statistic for row in repeats]) * np.sqrt(repeats.shape[1] / len(moved))
    part.update(ks_statistic=statistic, ks_p_textbook=stats.kstwo.sf(statistic, len(moved)),
                ks_critical_textbook=stats.kstwo.isf(0.05, len(moved)), ks_p_estimated=(1 + (null >= statistic).sum()) / 201,
                ks_critical_estimated=np.quantile(null, 0.95), ad_statistic=0.4, ad_p_estimated=0.3)
    fails, part["off_by"] = part["ks_p_estimated"] < 0.01, statistic + part["ks_critical_estimated"]
    part.update(fdr_rejected=int(fails), status=0 if part["off_by"] <= ADEQUATE else 2 if fails else 4)
    return part


PER_BIN = ("n n_still n_over n_moved p_still p_still_lower p_still_upper p_over p_over_lower p_over_upper lambda lambda_se "
           "omega omega_se mean standard_deviation ks_statistic ks_p_textbook ks_critical_textbook ks_p_estimated "
           "ks_critical_estimated ad_statistic ad_p_estimated off_by fdr_rejected status").split()
WHOLE = {"n", "n_still", "n_over", "n_moved", "fdr_rejected", "status"}


def surface_of(parts, values, still, over, which):
    """probability, lower, upper, empirical over bin x capacity."""
    shape = (len(parts), len(CAPACITY))
    result = {name: np.full(shape, np.nan) for name in ("probability", "lower", "upper", "empirical")}
    for i, part in enumerate(parts):
        if part["n"] < 30:
            continue
        inside = which == i
        beyond = np.array([(over[inside] | (~still[inside] & (values[inside] > c))).mean() for c in CAPACITY])
        p = exceedance(part, CAPACITY) if part["status"] == 0 else beyond
        half = 1.96 * np.sqrt(np.maximum(p * (1 - p), 1e-4) / part["n"]) * 2
        result["probability"][i], result["empirical"][i] = p, beyond
        result["lower"][i], result["upper"][i] = np.clip(p - half, 0, 1), np.clip(p + half, 0, 1)
    return result


def write_axis(group, name, column, values, still, over, which, bins):
    edge = np.quantile(column, np.linspace(0, 1, 7))
    axis = group.create_group(f"axis/{name}")
    axis["edge"], axis["centre"] = edge, (edge[1:] + edge[:-1]) / 2
    axis["centre"].make_scale(name)
    cell = np.clip(np.searchsorted(edge, column) - 1, 0, 5)
    table = np.full((bins, 6, len(CAPACITY)), np.nan)
    count = np.zeros((bins, 6), np.int64)
    for i in range(bins):
        for j in range(6):
            inside = (which == i) & (cell == j)
            count[i, j] = inside.sum()
            if count[i, j] >= 30:
                table[i, j] = [(over[inside] | (~still[inside] & (values[inside] > c))).mean() for c in CAPACITY]
    axis["probability"], axis["n"] = table, count
    axis["lower"], axis["upper"] = np.clip(table - 0.1, 0, 1), np.clip(table + 0.1, 0, 1)


def write_edp(root, name, attributes, parts):
    group = root.create_group(f"edp/{name}")
    group.attrs.update(attributes)
    for column in PER_BIN:
        kind = np.int64 if column in WHOLE else float
        group[column] = np.array([part[column] for part in parts], kind)
        group[column].dims[0].attach_scale(root["im/centre"])
    return group


def provenance(form, samples):
    return {"format": form, "study": STUDY.format(samples=samples), "seed": 1, "samples": samples, "version": "0.1.0",
            "git_commit": "0123456789abcdef0123456789abcdef01234567", "compiler": "GNU 12.2.0", "host": "example",
            "libraries": json.dumps({"hdf5": "1.10.8", "sundials": "6.4.1"}), "created_utc": "2025-01-01T00:00:00Z",
            "command": "freestand run study.yaml -o results", "ranks": 2}


def make_sweep(folder, samples=6000, seed=1):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    columns = draw(samples, seed)
    outcome, im = columns["outcome"][0], columns["pta_g"][0] / columns["friction_mu_k"][0] - 1
    counts = np.bincount(outcome, minlength=6)
    random = np.random.default_rng(seed + 1)
    with h5py.File(folder / "samples.h5", "w") as root:
        root.attrs.update(provenance("freestand-samples/2", samples))
        root["samples/sample"] = np.arange(samples)
        root["samples/sample"].make_scale("sample")
        for name, (values, unit, description) in columns.items():
            root[f"samples/{name}"] = values
            root[f"samples/{name}"].attrs.update(unit=unit, description=description)
            root[f"samples/{name}"].dims[0].attach_scale(root["samples/sample"])
        root["samples/outcome"].attrs["flag_meanings"] = " ".join(OUTCOMES)
        root["motions/name"] = np.array(["A", "B", "C1"], dtype=h5py.string_dtype())
        root["motions/group"] = np.full(3, -1, np.int32)
    usable = (outcome <= 2) & (im >= EDGES[0]) & (im < EDGES[-1])
    which = np.where(usable, np.searchsorted(EDGES, im, side="right") - 1, -1)
    still, over = outcome == 0, outcome == 2
    summary_edps = {}
    with h5py.File(folder / "fragility.h5", "w") as root:
        root.attrs.update(provenance("freestand-fragility/1", samples))
        root.attrs.update(im="report", im_unit="1", outcome_counts=counts)
        root.attrs["outcome_names"] = np.array(OUTCOMES, dtype=h5py.string_dtype())
        root["im/edge"] = EDGES
        root["im/centre"] = [im[which == i].mean() if (which == i).any() else (EDGES[i] + EDGES[i + 1]) / 2 for i in range(len(EDGES) - 1)]
        root["im/centre"].make_scale("im")
        for name, symbol in (("delta", "Δ"), ("peak_rotation_over_alpha", "θ/α")):
            values = columns[f"edp_{name}"][0]
            parts = [fit_bin(*(column[which == i] for column in (values, still, over)), random) for i in range(len(EDGES) - 1)]
            group = write_edp(root, name, {"unit": "1", "symbol": symbol, "kind": "continuous"}, parts)
            group["capacity"] = CAPACITY
            group["capacity"].make_scale("capacity")
            for key, table in surface_of(parts, values, still, over, which).items():
                group[f"surface/{key}"] = table
            moved = (which >= 0) & ~still & ~over
            ln_edge = np.linspace(np.log(values[moved]).min(), np.log(values[moved]).max() + 1e-9, CELLS + 1)
            group["distribution/ln_edge"] = ln_edge
            group["distribution/count"] = np.array(
                [np.histogram(np.log(values[moved & (which == i)]), ln_edge)[0] for i in range(len(EDGES) - 1)])
            for axis in ("friction_mu_k", "pulse_period_s"):
                write_axis(group, axis, columns[axis][0], values, still, over, which, len(EDGES) - 1)
            status = np.array([part["status"] for part in parts])
            summary_edps[name] = {"bins": len(parts), "fitted": int((status == 0).sum()), "rejected": int((status == 2).sum()),
                                  "too_few": int((status == 1).sum()), "not_refuted": int((status == 4).sum())}
            write_csv(folder, name, parts, group)
        nobody = np.zeros(samples, bool)
        ones = [count_bin(nobody[which == i], over[which == i]) for i in range(len(EDGES) - 1)]
        binary = write_edp(root, "overturned", {"unit": "1", "symbol": "overturned", "kind": "binary"}, ones)
        binary["capacity"] = np.array([0.5])
        for key in ("probability", "lower", "upper", "empirical"):
            binary[f"surface/{key}"] = np.array([[part["p_over"]] for part in ones])
        write_happening(root, "connection_failed", columns["edp_connection_failed"][0] > 0, which, ones)
        write_overturning(root, ones)
    (folder / "summary.json").write_text(json.dumps({
        "format": "freestand-summary/1", "study_name": "refrigerator", "samples": samples, "seed": 1,
        "outcomes": dict(zip(OUTCOMES, map(int, counts))), "im": "report", "edps": summary_edps,
        "motion_entries": 7,
        "timing": {"wall_s": 20.5, "sweep_s": 12.5, "accuracy_s": 2.0, "write_s": 1.0, "fit_s": 5.0, "samples_per_s": samples / 12.5, "ranks": 2},
        "files": ["samples.h5", "fragility.h5", "bins.csv", "surface.csv"],
        "warnings": ["1 sample met Painlevé's paradox and is in no fit."]}, indent=1))
    return folder


def write_happening(root, name, happened, which, parts):
    group = write_edp(root, name, {"unit": "1", "symbol": name.replace("_", " "), "kind": "binary"}, parts)
    group["capacity"] = np.array([0.5])
    k = np.array([happened[which == i].sum() for i in range(len(parts))])
    n = np.array([part["n"] for part in parts])
    few = n < 30
    share, limits = k / np.maximum(n, 1), np.array([binomial(*pair) for pair in zip(k, n)])
    for key, values in (("probability", share), ("lower", limits[:, 0]), ("upper", limits[:, 1]), ("empirical", share)):
        group[f"surface/{key}"] = np.where(few, np.nan, values)[:, None]


def write_overturning(root, parts):
    n = np.array([part["n"] for part in parts])
    k = np.array([part["n_over"] for part in parts])
    centre = root["im/centre"][()]
    grid = np.geomspace(EDGES[EDGES > 0][0], EDGES[-1], 80)
    use = centre > 0
    medians, dispersions = (axis.ravel() for axis in np.meshgrid(np.linspace(1, 12, 60), np.linspace(0.2, 1.5, 40), indexing="ij"))
    shares = stats.norm.cdf(np.log(centre[use] / medians[:, None]) / dispersions[:, None])
    most_likely = stats.binom.logpmf(k[use], n[use], shares).sum(axis=1).argmax()
    best = medians[most_likely], dispersions[most_likely]
    group = root.create_group("overturning")
    group.attrs.update(median=best[0], dispersion=best[1], median_se=0.1, dispersion_se=0.05, penalised=0, im="report", im_least=0.02,
                       im_most=8.6, extrapolated=0, misfit=0.08, misfit_im=2.6, misfit_p=0.21)
    p = stats.norm.cdf(np.log(grid / best[0]) / best[1])
    group["grid"], group["probability"] = grid, p
    group["lower"], group["upper"] = np.clip(p - 0.03, 0, 1), np.clip(p + 0.03, 0, 1)


def write_csv(folder, name, parts, group):
    first = not (folder / "bins.csv").exists() or name == "delta"
    with open(folder / "bins.csv", "w" if first else "a", newline="") as file:
        out = csv.writer(file)
        if first:
            out.writerow(["edp", "im_lower", "im_upper"] + PER_BIN)
        for i, part in enumerate(parts):
            out.writerow([name, EDGES[i], EDGES[i + 1]] + [part[column] for column in PER_BIN])
    with open(folder / "surface.csv", "w" if first else "a", newline="") as file:
        out = csv.writer(file)
        if first:
            out.writerow("im edp capacity probability lower upper empirical status".split())
        for i, part in enumerate(parts):
            for j, capacity in enumerate(CAPACITY):
                out.writerow([(EDGES[i] + EDGES[i + 1]) / 2, name, capacity]
                             + [group[f"surface/{key}"][i, j] for key in ("probability", "lower", "upper", "empirical")]
                             + [part["status"]])


def make_history(folder, overturned=False):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    time = np.arange(0, 5, 0.005)
    floor = np.where(time < 1.5, 6.0 * np.sin(2 * np.pi * time / 0.75), 0.0)
    slip = 0.12 * np.clip((time - 0.2) / 1.5, 0, 1) * np.cos(3 * np.clip(time - 0.2, 0, 1.5))
    slip -= slip[0]
    rotation = 0.15 * np.exp(-0.9 * (time - 0.4)) * np.sin(2 * np.pi * (time - 0.4) / 0.8)
    rotation[(time < 0.4) | (time > 3.2)] = 0
    mode = np.full(len(time), "rest", dtype=object)
    mode[(time > 0.2) & (time < 0.4)] = "slide"
    mode[(time >= 0.4) & (time <= 3.2)] = "rock"
    mode[(time >= 0.4) & (time <= 1.7)] = "slide_rock"
    if overturned:
        after = time > 2.0
        rotation[after] = np.minimum(1.58, 0.02 * np.exp(4 * (time[after] - 2.0)))
        mode[after] = np.where(rotation[after] > 1.57, "overturned", "rock")
    with open(folder / "history.csv", "w", newline="") as file:
        out = csv.writer(file)
        out.writerow("time_s,floor_acceleration_mps2,slip_m,slip_velocity_mps,rotation_rad,rotation_rate_radps,mode".split(","))
        out.writerows(zip(time, floor, slip, np.gradient(slip, time), rotation, np.gradient(rotation, time), mode))
    (folder / "summary.json").write_text(json.dumps({
        "peak_slip_m": float(np.abs(slip).max()), "residual_slip_m": float(slip[-1]), "slid_path_m": 0.31,
        "peak_rotation_rad": float(np.abs(rotation).max()), "overturned": overturned,
        "outcome": "overturned" if overturned else "moved", "peak_acceleration_g": 0.62, "events": 17}, indent=1))
    return folder


if __name__ == "__main__":
    kinds = {"sweep": lambda: make_sweep(sys.argv[2], *map(int, sys.argv[3:4])), "history": lambda: make_history(sys.argv[2])}
    if len(sys.argv) < 3 or sys.argv[1] not in kinds:
        sys.exit(__doc__)
    kinds[sys.argv[1]]()
