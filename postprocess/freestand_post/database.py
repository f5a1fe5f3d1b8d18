"""A database of many entries as one page: its numbers go in as JSON, and a script of the page draws what its reader chooses."""
import json
import pathlib
from dataclasses import dataclass
from statistics import NormalDist

import h5py
import jinja2
import numpy as np
from markupsafe import Markup

from . import closing, words
from .problem import Problem

HERE = pathlib.Path(__file__).parent
NAME, FORMAT = "database.h5", "freestand-catalogue/1"
SCRIPTS = ("database_curves.js", "database_draw.js", "database_pictures.js", "database_references.js", "database.js")  # the last one begins to draw


@dataclass
class Database:
    folder: pathlib.Path
    attributes: dict
    classes: list
    intensities: list   # words: name, unit, symbol, summary
    demands: list       # words, and binary
    entries: dict       # column -> values [entry]
    curves: dict        # column -> values [curve]
    points: dict        # column -> values [point]


def is_database(folder):
    return (folder / NAME).exists()


def _column(dataset):
    return [text.decode() for text in dataset[()]] if dataset.dtype.kind == "O" else dataset[()]


def _table(group):
    return {name: _column(dataset) for name, dataset in group.items()}


def _rows(table):
    return [dict(zip(table, row)) for row in zip(*table.values())]


def read_database(folder):
    path = folder / NAME
    try:
        closing.refuse_damaged(path, "build it again")
        with h5py.File(path) as root:
            if root.attrs.get("format") != FORMAT:
                raise Problem(f"{path} cannot be used (its format is \"{root.attrs.get('format', '')}\", not \"{FORMAT}\"): build the database again")
            return Database(folder, dict(root.attrs), _column(root["classes"]), _rows(_table(root["intensities"])),
                            _rows(_table(root["demands"])), *(_table(root[name]) for name in ("entries", "curves", "points")))
    except (OSError, KeyError) as why:
        raise Problem(f"{path} cannot be used ({why}): build the database again") from why


def _number(value):
    """A number as JSON has it, with all its digits (the figures' csv come from it); null where it is not known."""
    value = float(value)
    return None if not np.isfinite(value) else int(value) if value == int(value) and abs(value) < 1e9 else value


ENTRY_WORDS = ("id", "class", "floor", "friction", "description", "source", "scatter", "effects", "created_utc", "program",
               "reference_source", "reference_id", "reference_intensity", "reference_demand")
ENTRY_NUMBERS = ("width_m", "height_m", "mass_kg", "mu_k", "mu_s", "samples", "failed", "motions", "version",
                 "reference_capacity", "reference_median", "reference_dispersion")
CURVE_NUMBERS = ("capacity", "n", "im_least", "im_most", "median", "dispersion", "median_se", "dispersion_se", "extrapolated", "misfit", "off_by")
POINT_NUMBERS = ("im", "probability", "lower", "upper", "n")


def content(database):
    """What the page's script reads."""
    entries, curves, points, confidence = database.entries, database.curves, database.points, float(database.attributes["confidence"])
    ends = np.searchsorted(points["curve"], np.arange(len(curves["entry"]) + 1))
    shown = [[[_number(points[name][i]) for name in POINT_NUMBERS] for i in range(ends[k], ends[k + 1])] for k in range(len(curves["entry"]))]
    symbol = {word["name"]: words.intensity(word["name"], word["symbol"]) for word in database.intensities}
    return {
        "name": database.attributes["name"], "confidence": confidence, "normal": NormalDist().inv_cdf((1 + confidence) / 2), "classes": list(database.classes),
        "intensities": [{"name": w["name"], "unit": words.UNITS.get(w["unit"], w["unit"]), "symbol": symbol[w["name"]], "summary": w["summary"]}
                        for w in database.intensities],
        "demands": [{"name": w["name"], "unit": words.UNITS.get(w["unit"], w["unit"]), "symbol": words.demand(w["name"], w["symbol"]),
                     "meaning": words.demand_meaning(w["name"]), "binary": bool(w["binary"])} for w in database.demands],
        "entries": [{**{name: str(entries[name][i]) for name in ENTRY_WORDS}, **{name: _number(entries[name][i]) for name in ENTRY_NUMBERS}}
                    for i in range(len(entries["id"]))],
        "curves": [{"entry": int(curves["entry"][k]), "im": str(curves["intensity"][k]), "demand": str(curves["demand"][k]),
                    "family": str(curves["family"][k]), **{name: _number(curves[name][k]) for name in CURVE_NUMBERS}, "points": shown[k]}
                   for k in range(len(curves["entry"]))]}


def _headline(database):
    entries = database.entries
    numbers = [(words.count(len(entries["id"])), "entries"), (words.count(len(database.classes)), "classes of equipment"),
               (words.count(int(np.sum(entries["samples"]))), "samples")]
    floors, frictions = set(entries["floor"]) - {""}, np.round(entries["mu_k"], 6)
    if len(floors) > 1:
        numbers.append((words.count(len(floors)), "floors"))
    ends = [words.number(end) for end in (frictions.min(), frictions.max())]
    numbers.append((" to ".join(dict.fromkeys(ends)), "friction μ"))
    return numbers


def _references(database):
    return any(database.entries["reference_source"])


def page(database):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    data = json.dumps(content(database), ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")
    sources = sorted(set(database.entries["reference_source"]) - {""})
    css = "".join((HERE / name).read_text(encoding="utf-8") for name in ("page.css", "database.css"))
    script = "(() => {\n\"use strict\";\n" + "".join((HERE / name).read_text(encoding="utf-8") for name in SCRIPTS) + "})();\n"
    programs = sorted(set(zip(database.entries["program"], database.entries["git_commit"])))
    provenance = [("revision", str(database.attributes["revision"])), ("freestand", ", ".join(f"{version} ({commit})" for version, commit in programs)),
                  ("computed (UTC)", f"{min(database.entries['created_utc'])} to {max(database.entries['created_utc'])}")]
    return environment.get_template("database.html").render(
        css=Markup(css), title=words.capitalised(str(database.attributes["name"])) + ": fragility", headline=_headline(database), provenance=provenance,
        data=Markup(data), script=Markup(script), sources=sources,
        level=words.level(float(database.attributes["confidence"])))
