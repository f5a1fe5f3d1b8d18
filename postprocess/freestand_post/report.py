"""One self-contained page from the results: text, tables and pictures; nothing is fetched."""
import json
import math
import pathlib

import jinja2
import numpy as np
from markupsafe import Markup

from . import decisions_report, over_intensities, pictures, reproduce_report, style, validation, validation_report, words
from .designs import Designs
from .model import kept_fits
from .pictures.coverage import classes, swept
from .reading import COUNTED, FITTED, OUTCOMES, REJECTED, TESTED, TOO_FEW, UNPROVEN, History, Sweep
from .reading_decisions import Risk
from .reading_reproduce import Reproduction
from .validation import Validation

HERE = pathlib.Path(__file__).parent
PROVENANCE = (("created_utc", "written (UTC)"), ("version", "freestand"), ("git_commit", "commit"), ("command", "command"),
              ("compiler", "compiler"), ("libraries", "libraries"), ("host", "host"), ("ranks", "MPI ranks"), ("seed", "seed"))


def page(results):
    """Html text from what command.read() found."""
    style.apply()
    figures = [_figure(picture) for result in results for picture in pictures.draw(result)]
    if isinstance(results[0], Validation):
        figures += [_figure(picture) for picture in _of_one_sweep(results[0])]
        return _render("validation.html", validation_report.content(results[0], figures))
    if isinstance(results[0], Reproduction):
        return _render("reproduce.html", reproduce_report.content(results[0], figures))
    if isinstance(results[0], Designs):
        return _render("designs.html", decisions_report.designs([r for r in results if isinstance(r, Designs)], [r for r in results if isinstance(r, Risk)], figures))
    if isinstance(results[0], over_intensities.Intensities):
        return _render("intensities.html", over_intensities.content(results[0], figures, decisions_report.risks(results, figures, named=True)))
    sweep = next((result for result in results if isinstance(result, Sweep)), None)
    history = next((result for result in results if isinstance(result, History)), None)
    content = _content(sweep, history, figures) if sweep or history else decisions_report.alone(results)
    content["risks"] = decisions_report.risks(results, figures)
    content["sensitivity"] = decisions_report.sensitivity(results, figures)
    return _render("page.html", content)


def _of_one_sweep(results):
    """The main fragility and overturning, where a validation comes with a single sweep."""
    if len(results.sweeps) != 1:
        return []
    wanted = [f"fragility_{edp.name}" for edp in results.sweeps[0].continuous()[:1]] + ["overturning"]
    return [picture for picture in pictures.draw(results.sweeps[0]) if picture.name in wanted]


def _render(template, content):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    environment.filters.update(number=words.number, p=words.p_value, fixed=words.fixed, count=words.count, error=validation.error)
    return environment.get_template(template).render(css=Markup((HERE / "page.css").read_text(encoding="utf-8")), **content)


def _content(sweep, history, figures):
    edps = [edp.name for edp in sweep.continuous()] if sweep else []
    main = edps[0] if edps else ""
    hero = _hero(sweep, main, figures)
    of = {name: [figure for figure in figures if figure["edp"] == name] for name in edps}
    return {
        "title": _title(sweep, history), "headline": _headline(sweep, main, hero) if sweep else _history_numbers(history),
        "hero": hero,
        "demand": [figure for figure in of.get(main, []) if figure is not hero and not figure["name"].startswith("goodness")],
        "fit_figure": next((figure for figure in of.get(main, []) if figure["name"].startswith("goodness")), None),
        "other": [{"name": words.capitalised(words.demand_meaning(name)), "figures": of[name], "table": _fit_table(sweep, name)}
                  for name in edps[1:]],
        "shared": [figure for figure in figures if figure is not hero and not figure["edp"] and figure["section"] not in ("risk", "sensitivity")],
        "fit": _fit_table(sweep, main) if main else None,
        "outcomes": _outcomes(sweep) if sweep else [], "computed": _computed(sweep) if sweep else None,
        "draws": _draws(sweep) if sweep else [], "drawn_of": f", of the {words.count(sweep.kept)} samples{sweep.part}" if sweep and sweep.part else "", "study": str(sweep.attributes.get("study", "")).strip() if sweep else "",
        "accuracy": _accuracy(sweep), "effects": _effects(sweep), "warnings": _warnings(sweep), "provenance": _provenance(sweep) if sweep else [],
    }


def _hero(sweep, main, figures):
    """The picture of the demand that the study names first; of the first one with capacities where that has none."""
    lead = next(iter(sweep.summary.get("edps", {})), "") if sweep else ""
    names = ["overturning" if lead == "overturned" else f"happening_{lead}", f"fragility_{lead}", f"fragility_{main}"]
    return next((figure for name in names for figure in figures if figure["name"] == name), None)


def _title(sweep, history):
    if sweep is None:
        return f"Response of one specimen: {history.folder.resolve().name}"
    return words.capitalised(str(sweep.summary.get("study_name") or sweep.folder.resolve().name)) + ": seismic fragility"


def _figure(picture):
    title, subtitle = style.take_headline(picture.figure)
    svg = style.inline_svg(style.svg(picture.figure), picture.name.replace("_", "-"), picture.finding)
    return {"name": picture.name, "edp": picture.edp, "section": picture.section, "finding": title or picture.finding,
            "reading": subtitle, "svg": Markup(svg), "caption": picture.caption}


def _headline(sweep, main, hero):
    """The numbers at the top: (value, what)."""
    total = max(sweep.samples, 1)
    numbers = [(words.count(sweep.samples), "samples"),
               (words.percent(sweep.outcomes.get("moved", 0) / total), "moved and stood"),
               (words.percent(sweep.outcomes.get("overturned", 0) / total), "overturned")]
    if hero and hero["name"] == "overturning":
        numbers[1:] = numbers[:0:-1]
    elif hero and hero["name"].startswith("happening"):
        edp = next(edp for edp in sweep.edps if hero["name"] == f"happening_{edp.name}")
        counted = np.nansum(edp.surface["empirical"][:, 0] * edp.bins["n"]) / max(np.nansum(edp.bins["n"]), 1)
        numbers.insert(1, (words.percent(counted), words.happening(edp.name)))
    elif main:
        edp = next(edp for edp in sweep.edps if edp.name == main)
        status, label = edp.bins["status"], edp.label
        numbers.append((f"{(status == FITTED).sum()} of {np.isin(status, TESTED).sum()}", f"bins of {label} have a lognormal that is adequate"))
    timing = sweep.summary.get("timing", {})
    if timing.get("wall_s"):
        numbers.append((_duration(timing["wall_s"]), f"on {words.plural(timing.get('ranks', 1), 'core')}{_phases(timing)}"))
    return numbers


def _phases(timing):
    """": motions and spectra 3 s, sweep 5.1 s (20 000 samples a second), accuracy check 0.9 s ...": where the time went."""
    parts = [(name, timing[key]) for key, name in (("motions_s", "motions and spectra"), ("sweep_s", "sweep"), ("accuracy_s", "accuracy check"), ("write_s", "writing"), ("fit_s", "fit"))
             if timing.get(key, 0) >= 0.05]
    rate = f" ({words.count(timing['samples_per_s'])} samples a second)" if timing.get("samples_per_s") else ""
    return (": " if parts else "") + ", ".join(f"{name} {_duration(seconds)}" + (rate if name == "sweep" else "") for name, seconds in parts)


def _history_numbers(history):
    summary = history.summary
    table = (("peak_slip_m", 100, "cm", "largest slip"), ("residual_slip_m", 100, "cm", "slip that remains"),
             ("peak_rotation_rad", 180 / math.pi, "°", "largest rotation"), ("peak_acceleration_g", 1, "g", "peak equipment acceleration"))
    return [(f"{words.number(factor * float(summary[key]))} {unit}".replace(" °", "°"), what)
            for key, factor, unit, what in table if isinstance(summary.get(key), (int, float))]


def _duration(seconds):
    return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


def _fit_table(sweep, name):
    edp = next(edp for edp in sweep.edps if edp.name == name)
    verdict = {FITTED: "off by at most {:.2f}", TOO_FEW: "too few samples", COUNTED: "too few moved, or no lognormal fits: counted",
               REJECTED: "fails, may be off by {:.2f}", UNPROVEN: "not refuted, may be off by {:.2f}"}
    kept = kept_fits(edp)
    rows = []
    for i in range(sweep.centre.size):
        row = {key: edp.bins[key][i] for key in edp.bins}
        row.update(range=words.span(sweep.edge[i], sweep.edge[i + 1]), median=math.exp(row["lambda"]),
                   failed=row["status"] == REJECTED, empty=row["status"] in (TOO_FEW, COUNTED),
                   verdict=verdict.get(row["status"], "unknown").format(row["off_by"])
                   + (": fit kept" if kept[i] else ": counted" if row["status"] in (REJECTED, UNPROVEN) else ""))
        row.update({key: np.nan_to_num(row[key]) for key in ("n", "n_still", "n_moved", "n_over")})
        rows.append(row)
    return {"rows": rows, "symbol": words.with_unit(edp.label, edp.unit),
            "im": words.with_unit(sweep.im_symbol, sweep.im_unit)}


def _outcomes(sweep):
    total = max(sweep.samples, 1)
    return [{"name": words.OUTCOMES.get(name, name), "count": sweep.outcomes.get(name, 0), "colour": style.OUTCOME.get(name, style.INK),
             "percent": 100 * sweep.outcomes.get(name, 0) / total, "share": words.percent(sweep.outcomes.get(name, 0) / total)}
            for name in OUTCOMES]


def _computed(sweep):
    names = [words.short_column(name) for name in swept(sweep, limit=None)]
    kinds = _motions(sweep)
    entries = int(sweep.summary.get("motion_entries", 1))
    motions = f" under {kinds}" if kinds else ""
    one_motion = motions + (f", by one of the study's {words.plural(entries, 'entry').replace('entrys', 'entries')} of motions" if kinds and entries > 1 else "")
    over = f" over {words.listing(names)}" if names else ""
    return (f"Each of {words.plural(sweep.samples, 'sample')} is one specimen{one_motion}: its {words.MOTIONS.get(sweep.model, sweep.model)} motion was integrated, its demand "
            f"measured, and the demands of all samples reduced to probabilities in {words.plural(sweep.centre.size, 'bin')} of "
            f"{sweep.im_symbol}. The sweep runs{over}." if names else
            f"{words.plural(sweep.samples, 'sample')}{motions}, in {words.plural(sweep.centre.size, 'bin')} of {sweep.im_symbol}.")


def _motions(sweep):
    """"one of 26 records or a pulse of 2 kinds (A, B)": what a sample is shaken by. Records named in several entries count once."""
    records = {name for name, record in zip(sweep.motions, sweep.is_record) if record == 1}
    pulses = [name for name, record in zip(sweep.motions, sweep.is_record) if not record]
    found = []
    if records:
        pairs = {(True,): " in two horizontal directions", (False, True): ", some of them in two horizontal directions"}.get(tuple(sorted(set(sweep.is_pair[sweep.is_record == 1].tolist()))), "")
        found.append((f"one of {words.plural(len(records), 'record')}" if len(records) > 1 else "one record") + pairs + _upstairs(sweep))
    if pulses:
        found.append(f"a pulse of {words.plural(len(pulses), 'kind')} ({', '.join(pulses)})" if len(pulses) > 1 else f"a pulse {pulses[0]}")
    return (", or " if "," in found[0] else " or ").join(found) if found else ""


def _upstairs(sweep):
    """" of the ground, on storey 1 or 3 of a building": where the records shake, of samples that stand in a building."""
    storey = sweep.draws.get("storey", np.zeros(0))
    storeys = [str(int(value)) for value in np.unique(storey[np.isfinite(storey)])]
    if storeys in ([], ["0"]):
        return ""
    outside = np.isnan(storey) & (sweep.is_record[sweep.draws["motion"].astype(int)] == 1)
    buildings = list(dict.fromkeys(building for building, _ in sweep.amplification))
    of = f"one of the buildings {words.listing(buildings)}" if len(buildings) > 1 else "a building"
    return f" of the ground, {'as it is or ' if outside.any() else ''}on storey {words.listing(storeys, 'or')} of {of}"


def _draws(sweep):
    rows = []
    for name in swept(sweep, limit=None):
        values = sweep.draws[name][np.isfinite(sweep.draws[name])]
        levels = classes(sweep, name)
        rows.append({"name": words.column(name), "classes": ", ".join(levels[1]) if levels else "",
                     "low": values.min(), "middle": np.median(values), "high": values.max()})
    return rows


def _accuracy(sweep):
    """What a paired run of some samples at a tighter tolerance says of the errors."""
    found = sweep.summary.get("accuracy") if sweep else None
    if not found or not found.get("samples_checked"):
        return None
    rows = [{**edp, "name": words.with_unit(words.capitalised(words.demand_meaning(name)), edp["unit"])}
            for name, edp in found["edps"].items()]
    return {"rows": rows, "checked": found["samples_checked"], "flips": found["outcome_flips"],
            "upper": words.percent(found["flip_share_upper"]), "tolerance": found["tolerance"], "tighter": found["tighter_tolerance"]}


def _effects(sweep):
    """The effects that the study's model has: law, source, and each parameter as the study gives it."""
    try:
        entries = json.loads(str(sweep.attributes.get("effects", "[]"))) if sweep else []
    except ValueError:
        return []
    for entry in entries:
        entry["values"] = ", ".join(f"{p['name']} {p['value']}" for p in entry["parameters"])
        entry["title"] = entry["name"].replace("_", " ")
    return entries


def _warnings(sweep):
    if sweep is None:
        return []
    found = [str(warning) for warning in sweep.summary.get("warnings", [])]
    if not sweep.summary:
        found.append("summary.json is not there: times and warnings of the run are unknown.")
    if not sweep.draws:
        found.append("samples.h5 is not there: the page says nothing about what the sweep covered.")
    if not sweep.overturning:
        found.append("No overturning curve was fitted.")
    return found


def _provenance(sweep):
    rows = []
    for key, label in PROVENANCE:
        value = sweep.attributes.get(key)
        if value in (None, ""):
            continue
        if key == "libraries":
            try:
                value = ", ".join(f"{name} {version}" for name, version in json.loads(value).items())
            except (ValueError, AttributeError):
                pass
        rows.append((label, str(value)))
    return rows
