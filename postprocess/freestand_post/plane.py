"""Whether records shake the floor in both horizontal directions: no column of samples.h5 says so."""
import csv
import json

import numpy as np
import yaml


def in_plane(sweep):
    """Found among the records of a sweep: True of those with a second horizontal direction, False of those along a line; {True, False} of
    both. Samples tell it; where none does, the study and its tables, as far as they are still there."""
    if "friction_ratio_across" in sweep.draws:  # refused where any motion is along a line
        return {True}
    if sweep.model != "slide" or not _effects(sweep) <= {"static_friction", "vertical_shaking"}:  # in a plane all others are refused
        return {False}
    return _at_rest(sweep) or _of_study(sweep)


def _effects(sweep):
    try:
        return {entry["name"] for entry in json.loads(str(sweep.attributes.get("effects", "[]")))}
    except (ValueError, TypeError, KeyError):
        return set()


def _at_rest(sweep):
    """What stays at rest feels what the floor does. Its peak acceleration is of all directions, that of the floor (pta_g) of the first one:
    they are equal along a line, but for rounding."""
    if "vertical_shaking" in _effects(sweep) or not sweep.peak_acceleration_g.size or not {"motion", "pta_g"} <= set(sweep.draws):
        return set()
    motion = sweep.draws["motion"].astype(int)
    told = (sweep.outcome == 0) & (sweep.is_record[motion] == 1) & np.isfinite(sweep.peak_acceleration_g)
    more = told & (sweep.peak_acceleration_g > (1 + 1e-9) * np.abs(sweep.draws["pta_g"]))
    return {bool(more[told & (motion == i)].any()) for i in np.unique(motion[told])}


def _of_study(sweep):
    folder = sweep.folder / sweep.summary.get("samples_in", "")
    try:
        entries = yaml.safe_load(str(sweep.attributes.get("study", "")))["motions"]
        written = yaml.safe_load((folder / "study.yaml").read_text(encoding="utf-8")) if (folder / "study.yaml").exists() else {}
        base = folder / written.get("paths_from", "")
    except (yaml.YAMLError, TypeError, KeyError, AttributeError, OSError, UnicodeDecodeError):
        return set()
    return {pair for entry in entries if isinstance(entry, dict) and "pulse" not in entry for pair in _of_entry(entry, base)}


def _of_entry(entry, base):
    if "records" not in entry or any(key.startswith("rotate") for key in entry):  # made by a recipe; turned into one direction
        return {False}
    if "cross_records" in entry:
        return {True}
    table = base / str(entry["records"])
    try:
        lines = [line for line in table.read_text(encoding="utf-8-sig").splitlines() if line.strip() and not line.lstrip().startswith("#")]
        return {bool((row.get("cross") or "").strip()) for row in csv.DictReader(lines)} or {False}
    except (OSError, UnicodeDecodeError, csv.Error):
        return {False}  # a pattern, or a record itself
