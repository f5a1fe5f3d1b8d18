"""Invented designs (sweeps with curves over all intensities), risk.json and sensitivity.json, as the program writes them."""
import json
import pathlib
import tempfile
import unittest

import h5py
import numpy as np
from scipy import stats
from freestand_post import designs, reading

import support

RESAMPLES = 400
STUDY = """name: statue
seed: 1
block: {{width_m: {width}, height_m: 1.8, mass_kg: 200}}
friction: {{mu_k: {mu}}}
{chain}motions:
  - records: "records/*.AT2"
    scale_to: {{pta_g: {{uniform: [0.1, 2]}}}}
"""


def curve(group, medians, dispersions, resampled, edge, own=False):
    """Curves over IM into a group; as attributes and plain rows where it is one of its `own`, as overturning."""
    grid = np.linspace(max(edge[0], edge[-1] / 100), edge[-1], 81)
    p = stats.norm.cdf(np.log(grid[None, :] / medians[:, None]) / dispersions[:, None])
    numbers = {"median": medians, "dispersion": dispersions, "median_se": 0.05 * medians, "dispersion_se": 0.05 * dispersions,
               "misfit": 0.02 + 0 * medians, "misfit_im": medians, "misfit_p": 0.3 + 0 * medians, "penalised": 0 * medians,
               "extrapolated": 0 * medians, "adequate": 1 + 0 * medians}
    for name in ("grid", "probability", "lower", "upper", "resampled_median", "resampled_dispersion", *([] if own else numbers)):
        if name in group:
            del group[name]
    group["grid"] = grid
    rows = {"probability": p, "lower": np.clip(p - 0.03, 0, 1), "upper": np.clip(p + 0.03, 0, 1), "resampled_median": resampled,
            "resampled_dispersion": np.repeat(dispersions[:, None], RESAMPLES, axis=1)}
    for name, values in rows.items():
        group[name] = values[0] if own else values
    for name, values in numbers.items():
        if own:
            group.attrs[name] = values[0]
        else:
            group[name] = values


def make_design(folder, study, overturning, scatter=0.1, own_scatter=0.01, seed=1, of_own=0):
    """Turns a copy of a sweep into a design: its study, its median of overturning, and resampled medians that scatter with those of the
    other designs by `scatter` and by themselves by `own_scatter` (of ln)."""
    common = np.random.default_rng(99).normal(size=RESAMPLES)
    by_itself = np.random.default_rng(of_own).normal(size=RESAMPLES)
    factor = np.exp(scatter * common + own_scatter * by_itself)
    with h5py.File(folder / "fragility.h5", "a") as root:
        root.attrs.update(study=study, seed=seed, resamples=RESAMPLES)
        edge = root["im/edge"][()]
        curve(root["overturning"], np.array([overturning]), np.array([0.4]), overturning * factor[None, :], edge, own=True)
        medians = overturning * np.linspace(0.3, 0.9, root["edp/delta/capacity"].size)
        curve(root.require_group("edp/delta/functions"), medians, 0 * medians + 0.5, medians[:, None] * factor[None, :], edge)
    return folder


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="freestand-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def design(self, name, median, width=0.6, mu=0.3, chain="", **more):
        study = STUDY.format(width=width, mu=mu, chain=chain)
        return make_design(support.sweep_copy(self.folder / name), study, median, **more)

    def sweeps(self, *folders):
        return designs.compare([reading.read_sweep(folder) for folder in folders])


def row(edp, capacity, rate, share, **more):
    band = {"annual_rate": rate, "lower": 0.8 * rate if rate else None, "upper": 1.3 * rate if rate else None}
    years = [{"years": n, **{key: None if value is None else 1 - np.exp(-value * n) for key, value in
                             zip(("probability", "lower", "upper"), band.values())}} for n in (50, 475)]
    return {"edp": edp, "unit": "m", "capacity": capacity, "title": edp, "recommended": "function", "why": "the fitted curve is adequate",
            "refused": "", **band, "in_years": years, "by_function": band, "by_counts": band, "outside_sweep": 0.01, "outside_hazard": 0.02,
            "median_im": 0.4, "share_by_im": share, **more}


def make_risk(folder, name="refrigerator", sweep="out", times=1):
    folder.mkdir(parents=True)
    edge = np.geomspace(0.05, 3, 25)
    share = np.diff(stats.norm.cdf(np.log(edge / 0.4) / 0.5)).tolist()
    rows = [row("peak_slip_m", 0.05, 1.2e-2 * times, share), row("peak_slip_m", 0.2, 2.3e-3 * times, share, recommended="counts"),
            row("peak_slip_m", 0.8, None, [], median_im=None, refused="71 % of the rate may come from intensities outside of the sweep"),
            row("overturned", None, 3.1e-4 * times, share)]
    (folder / "risk.json").write_text(json.dumps({
        "format": "freestand-risk/1", "sweep": sweep, "study_name": name, "command": "", "im": "pga_g", "im_unit": "g", "period_s": None,
        "confidence": 0.95, "hazard": {"im": [0.05, 3], "annual_rate": [0.1, 1e-5]}, "swept": [0.1, 2], "years": [50, 475],
        "im_edge": edge.tolist(), "demands": rows, "warnings": ["much of the rate comes from afar: peak_slip_m > 0.8 m (71 %)"]}))
    return folder


def make_sensitivity(folder, pairs=1000):
    def estimate(value, se=0.01):
        return {"value": value, "se": se, "lower": max(0, value - 2 * se), "upper": value + 2 * se}

    def answer(edp, kind, capacity, shares, why=""):
        one = {"edp": edp, "unit": "m", "kind": kind, "capacity": capacity, "title": edp, "samples": 6000, "motions": 40, "mean": 0.3,
               "variance": 0.21, "why_empty": why, "shares": {}}
        for name, value in shares.items():
            one["shares"][name] = {"share": estimate(value)}
            if pairs:
                one["shares"][name].update(total=estimate(value + 0.08, 0.03), pairs=pairs)
        if shares:
            one["together"] = estimate(sum(shares.values()), 0.02)
        return one

    names = ("motion.pta_g", "motion", "friction.mu_k", "block.width_m")
    (folder / "sensitivity.json").write_text(json.dumps({
        "format": "freestand-sensitivity/1", "confidence": 0.95, "pairs": pairs, "parameters": [{"name": name, "unit": "1"} for name in names],
        "answers": [answer("peak_slip_m", "ln_demand", None, dict(zip(names, (0.45, 0.2, 0.12, -0.002)))),
                    answer("peak_slip_m", "exceeds", 0.1, dict(zip(names, (0.35, 0.15, 0.1, 0.0)))),
                    answer("peak_slip_m", "exceeds", 0.8, {}, "it happens in 12 of 6000 samples, fewer than 30"),
                    answer("overturned", "happens", None, dict(zip(names, (0.2, 0.3, 0.05, 0.1))))]}))
    return folder
