"""An invented database, written by h5py as database_file.hpp says: two classes, two frictions, two floors, one reference."""
import math
import pathlib

import h5py
import numpy as np

TEXT = h5py.string_dtype("utf-8")
LOWER, UPPER = 1.15, 1 / 1.15  # of the median, for the band


def share(im, median, dispersion):
    return 0.5 * math.erfc(-math.log(im / median) / dispersion / math.sqrt(2))


def median(width, height, mu, demand, capacity, floor):
    return 2 * width / height * (1 + mu) * (capacity / 0.05) ** (0.4 if demand == "peak_slip_m" else 0) * (1 if floor == "ground" else 0.8)


def rows():
    """Entries and curves as dictionaries."""
    entries, curves = [], []
    for name, kind, width, height in (("case", "display case", 0.6, 1.8), ("shelf", "bookcase", 0.32, 1.8)):
        for mu in (0.3, 0.6):
            for floor in ("ground", "upper"):
                theirs = ({"reference_source": "a <book>", "reference_id": "E.1", "reference_intensity": "pgv_mps", "reference_demand": "overturned",
                           "reference_median": 0.29, "reference_dispersion": 0.5} if name == "shelf" else {})
                entry = {"id": f"{name}_mu{round(100 * mu)}_{floor}", "class": kind, "floor": floor, "friction": f"mu{round(100 * mu)}", "description": "five shelves, \"full\"",
                         "source": "assumed", "width_m": width, "height_m": height, "mass_kg": 100, "mu_k": mu, "mu_s": 1.2 * mu, "model": "slide_rock", "effects": "",
                         "shaking": floor, "scatter": "", "reference_source": "", "reference_id": "", "reference_intensity": "", "reference_demand": "",
                         "reference_capacity": math.nan, "reference_median": math.nan, "reference_dispersion": math.nan, "samples": 2000, "failed": 0, "motions": 2000,
                         "seed": 1, "version": 1, "fingerprint": "0", "kernel": "0", "program": "0.3.0", "git_commit": "abc", "created_utc": "2026-01-01T00:00:00Z", "study": "{}", **theirs}
                for demand, capacities in (("overturned", (0.5,)), ("peak_slip_m", (0.05, 0.1))):
                    for capacity in capacities:
                        m, d = median(width, height, mu, demand, capacity, floor), 0.4
                        points = [(im, share(im, m, d), share(im, LOWER * m, d), share(im, UPPER * m, d), 200) for im in np.geomspace(0.1, 3, 9)]
                        curves.append({"entry": len(entries), "intensity": "pgv_mps", "demand": demand, "capacity": capacity, "n": 1800, "im_least": 0.1, "im_most": 3.0,
                                       "family": "points" if name == "case" and demand == "peak_slip_m" else "lognormal", "median": m, "dispersion": d, "median_se": 0.02 * m, "dispersion_se": 0.01, "extrapolated": 0, "misfit": 0.01,
                                       "misfit_im": 0.5, "misfit_p": 0.5, "off_by": 0.02, "points": points})
                entries.append(entry)
    return entries, curves


def _write(group, table):
    for name in table[0]:
        values = [row[name] for row in table]
        group.create_dataset(name, data=values, dtype=TEXT if isinstance(values[0], str) else None)


def plateaus():
    """rows() whose shelves have curves that no lognormal describes. On the upper floor: one that comes near 1/2 early, stays there and
    passes it late, and one that never comes near. On the ground: one that passes 1/2 at once, with a fit that failed, and one that is
    beyond 1/2 from the start and falls below it again."""
    entries, curves = rows()
    ims = [float(im) for im in np.geomspace(0.1, 3, 9)]
    shares = {"shelf_mu30_upper": [0, 0.02, 0.2, 0.41, 0.497, 0.48, 0.46, 0.49, 0.55], "shelf_mu60_upper": [0, 0, 0, 0.02, 0.05, 0.1, 0.12, 0.1, 0.1],
              "shelf_mu30_ground": [0, 0, 0.1, 0.3, 0.8, 0.9, 0.95, 0.97, 0.99], "shelf_mu60_ground": [0.7, 0.75, 0.8, 0.8, 0.7, 0.6, 0.3, 0.2, 0.1]}
    for curve in curves:
        given = shares.get(entries[curve["entry"]]["id"])
        if given and curve["demand"] == "overturned":
            curve.update(family="points", median=84495251605170.33, median_se=1.2e21, dispersion=16.2, dispersion_se=5.8, extrapolated=1,
                         points=[(im, p, max(0, p - 0.07), min(1, p + 0.07), 200) for im, p in zip(ims, given)])
    return entries, curves


def make_database(folder, made=None):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    entries, curves = made or rows()
    with h5py.File(folder / "database.h5", "w") as root:
        root.attrs.update({"format": "freestand-catalogue/1", "name": "things & shelves", "revision": "1", "confidence": 0.95})
        root.create_dataset("classes", data=["display case", "bookcase"], dtype=TEXT)
        root.create_dataset("families", data=["lognormal", "not_refuted", "points"], dtype=TEXT)
        _write(root.create_group("intensities"), [{"name": "pgv_mps", "unit": "m/s", "symbol": "PGV", "summary": "peak velocity", "binary": 0}])
        _write(root.create_group("demands"), [{"name": "overturned", "unit": "1", "symbol": "", "summary": "it fell", "binary": 1},
                                              {"name": "peak_slip_m", "unit": "m", "symbol": "U", "summary": "largest slip", "binary": 0}])
        _write(root.create_group("entries"), entries)
        _write(root.create_group("curves"), [{name: value for name, value in curve.items() if name != "points"} for curve in curves])
        points = [{"curve": k, **dict(zip(("im", "probability", "lower", "upper", "n"), point))} for k, curve in enumerate(curves) for point in curve["points"]]
        _write(root.create_group("points"), points)
    return folder
