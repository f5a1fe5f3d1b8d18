"""What the pages say of decisions: annual risk, shares of variance, several designs side by side."""
import math
import pathlib

from . import best_intensity, words
from .designs import headline, ratio, shown_half, verdict, warnings
from .halved import halving
from .pictures import designs as designs_picture
from .reading_decisions import Risk, Sensitivity


def risks(results, figures, named=False):
    """Sections of the Risk values, in their order; `figures`: those of all results."""
    found = [result for result in results if isinstance(result, Risk)]
    drawn = iter([figure for figure in figures if figure["section"] == "risk"])
    return [_risk(risk, next(drawn) if risk.told() else None, named or len(found) > 1) for risk in found]


def _risk(risk, figure, named):
    return {"name": f"{risk.study_name} ({risk.sweep})" if named else "", "figure": figure, "warnings": risk.warnings,
            "level": words.level(risk.confidence), "years": [f"{years:g}" for years in risk.years], "rows": [_row(risk, row) for row in risk.rows]}


def _row(risk, row):
    def chance(value):
        return f"{words.number(100 * value)} %" if math.isfinite(value) else "–"

    return {"title": words.capitalised(row.title), "rate": words.a_year(row.rate[0]), "interval": _span(words.a_year, *row.rate[1:]),
            "chances": [(chance(value), _span(chance, low, high)) for _, value, low, high in row.in_years],
            "median": _half_from_above(risk, row.median_im), "sweep": _share(row.outside_sweep), "hazard": _share(row.outside_hazard),
            "by": "counted shares" if row.by != "function" else "fitted curve, with no bin to check it" if row.why.startswith("no bin") else "fitted curve", "why": row.why, "refused": row.refused}


def _half_from_above(risk, im):
    if math.isnan(im):
        return "–"
    return words.quantity(im, risk.im_unit) if math.isfinite(im) else f"> {words.quantity(risk.edge[-1], risk.im_unit)}"


def _span(text, low, high):
    return f"{text(low)} to {text(high)}" if math.isfinite(low) and math.isfinite(high) else "–"


def _share(value):
    return words.percent(value) if math.isfinite(value) else "–"


def sensitivity(results, figures):
    found = next((result for result in results if isinstance(result, Sensitivity)), None)
    if found is None:
        return None
    known = [answer for answer in found.answers if answer.shares]
    largest = {}
    for answer in known:
        for share in answer.shares:
            largest[share.parameter] = max(largest.get(share.parameter, -math.inf), share.share[0], 0 if math.isnan(share.total[0]) else share.total[0])  # as the picture
    of = [{share.parameter: share for share in answer.shares} for answer in known]
    rows = [{"name": words.capitalised(words.sampled(name)), "cells": [_cell(shares[name]) if name in shares else "–" for shares in of]}
            for name in sorted(largest, key=largest.get, reverse=True)]
    return {"figure": next((figure for figure in figures if figure["section"] == "sensitivity"), None), "columns": [answer.title for answer in known], "rows": rows,
            "together": [words.share(*answer.together[:2]) for answer in known], "samples": [words.count(answer.samples) for answer in known], "total": bool(found.pairs),
            "empty": [(answer.title, answer.why_empty) for answer in found.answers if not answer.shares]}


def _cell(share):
    return words.share(*share.share[:2]) + (f" ({words.share(*share.total[:2])})" if math.isfinite(share.total[0]) else "")


def alone(results):
    """The page of a risk or a sensitivity whose sweep was not given."""
    name = next((risk.study_name for risk in results if isinstance(risk, Risk)), "") or results[0].folder.resolve().name
    what = "annual risk" if any(isinstance(result, Risk) for result in results) else "shares of the scatter"
    return {"title": f"{words.capitalised(name)}: {what}", "headline": [], "hero": None, "demand": [], "fit_figure": None, "other": [], "shared": [],
            "fit": None, "outcomes": [], "computed": None, "draws": [], "study": "", "accuracy": None, "effects": [], "warnings": [],
            "provenance": []}


def designs(over, risk_results, figures):
    """The page of several designs; `over`: their Designs over each intensity."""
    found = over[0]
    names = list(dict.fromkeys(str(sweep.summary.get("study_name") or "") for sweep in found.sweeps))
    title = words.capitalised(names[0]) if len(names) == 1 and names[0] else "Several designs"
    drawn = iter([figure for figure in figures if figure["section"] == "designs"])
    parts = [{"im": one.im_symbol, "im_unit": words.UNITS.get(one.sweeps[0].im_unit, one.sweeps[0].im_unit), "figures": [next(drawn)] if designs_picture.panels(one) else [],
              "rates": rates(one, [risk for risk in risk_results if len(over) == 1 or risk.im_symbol == one.im_symbol]), "medians": _medians(one)} for one in over]
    finding = next((part["rates"]["finding"] for part in parts if part["rates"]), "")
    return {"title": f"{title}: side by side", "lead": "; ".join(words.capitalised(label) for label in found.labels) + ".", "finding": finding,
            "headline": [number for one in over for number in _headline(one)], "parts": parts, "best": best_intensity.table(over),
            "differing": found.differing, "folders": [sweep.folder.resolve().name for sweep in found.sweeps],
            "level": words.level(found.level), "paired": found.paired, "warnings": _warnings(over),
            "risks": risks(risk_results, figures, named=True), "provenance": [line for one in over for line in _provenance(one, len(over) > 1)]}


def _warnings(over):
    labels = [f"{label}, over {one.im_symbol}" if len(over) > 1 else label for one in over for label in one.labels]
    return warnings([sweep for one in over for sweep in one.sweeps], labels)


def rates(found, risk_results):
    """Annual rates by design: (headline, columns, rows); the first design is that of the first risk. None where there is but one."""
    if len(risk_results) < 2:
        return None
    tables = [{(row.edp, words.plain(row.capacity)): row for row in risk.rows} for risk in risk_results]
    events = sorted(_events(risk_results[0]), key=lambda key: key[0] != "overturned")
    labels = [_design(found, risk) for risk in risk_results]
    rows = [{"design": words.capitalised(label), "cells": [_rate(table.get(key), tables[0][key]) for key in events]} for label, table in zip(labels, tables)]
    return {"columns": [words.capitalised(tables[0][key].title) for key in events], "rows": rows, "level": words.level(risk_results[0].confidence),
            "finding": _lowest(tables[0][events[0]].title, labels, [table[events[0]].rate if events[0] in table else (math.nan,) * 3 for table in tables],
                           _medians_differ(found, labels, tables[0][events[0]])) if events else "",
            "halved": halving(found, labels, events, tables),
            "hazards": any(list(risk.hazard_rate) != list(risk_results[0].hazard_rate) or risk.im_symbol != risk_results[0].im_symbol for risk in risk_results)}


def _events(risk):
    """What happens or not, and of each other demand the middle capacity."""
    for edp in dict.fromkeys(row.edp for row in risk.rows):
        mine = [row for row in risk.rows if row.edp == edp]
        yield edp, words.plain(mine[len(mine) // 2].capacity)


def _design(found, risk):
    """The label of the sweep that the rates are of."""
    own = [label for sweep, label in zip(found.sweeps, found.labels) if sweep.folder.resolve().name == pathlib.Path(risk.sweep).name]
    return own[0] if len(own) == 1 else f"{risk.study_name} ({risk.sweep})"


def _rate(row, first):
    if row is None or not math.isfinite(row.rate[0]):
        return {"rate": "–", "band": "", "ratio": "–"}
    ratio = row.rate[0] / first.rate[0] if first.rate[0] > 0 else math.nan
    return {"rate": words.a_year(row.rate[0]), "band": _span(words.a_year, *row.rate[1:]), "ratio": words.number(ratio)}


def _lowest(what, labels, found, medians_differ=lambda a, b: False):
    """Which design has the lowest rate, by what factor below the first, and from which ones its band does not part it. medians_differ: do
    those of two designs (by position) differ by more than chance? Pairs of samples with the same motion tell more than two bands."""
    told = [i for i, rate in enumerate(found) if math.isfinite(rate[0])]
    if len(told) < 2:
        return ""
    least = min(told, key=lambda i: found[i][0])
    rate, first = found[least][0], found[0][0]
    below = f", {words.number(first / rate)} times below {labels[0]}" if least and first > 0 and rate > 0 else ""
    near = [i for i in told if i != least and not found[least][2] < found[i][1]]
    by_medians = [labels[i] for i in near if medians_differ(least, i)]
    by_nothing = [labels[i] for i in near if not medians_differ(least, i)]
    untold = [labels[i] for i in range(len(found)) if i not in told]
    has = f"{labels[least]} has the lowest annual rate of “{what}”: {words.a_year(rate)}{below}"
    return ((f"Of those that are told, {has}" if untold else words.capitalised(has))
            + (f"; the bands of these rates do not part it from {words.listing(by_medians)}, but the medians differ by more than chance" if by_medians else "")
            + (f"; not parted by more than their bands from {words.listing(by_nothing)}" if by_nothing else "")
            + (f"; none is told of {words.listing(untold)}" if untold else ""))


def _medians_differ(found, labels, event):
    """Of two designs of `labels`, for the event of a rate."""
    what = "overturning" if event.edp == "overturned" else event.title
    row = next((row for row in found.rows if row.what == what), None)
    place = [found.labels.index(label) if label in found.labels else None for label in labels]
    if row is None or None in place:
        return lambda a, b: False
    return lambda a, b: not (row.curves[place[a]]["extrapolated"] and row.curves[place[b]]["extrapolated"]) and verdict(ratio(row.curves[place[a]], row.curves[place[b]], found.paired, found.level)) == "yes"


def _headline(found):
    row = next((row for row in found.rows if all(math.isfinite(curve["median"]) for curve in row.curves)), None)
    if row is None:
        return []
    medians = [headline(sweep, curve, row.what) for sweep, curve in zip(found.sweeps, row.curves)]
    return [(shown, f"{what}: {label}") for (shown, what), label in zip(medians, found.labels)]


def _mark(ratio, *curves):
    """Of a ratio of medians: not all of which are swept, or are those of curves that hold."""
    if not math.isfinite(ratio):
        return ""
    return "†" if not all(curve["adequate"] for curve in curves) else "*" if any(curve["extrapolated"] for curve in curves) else ""


def _medians(found):
    rows = []
    for row in found.rows:
        for i, (curve, label) in enumerate(zip(row.curves, found.labels)):
            mark = ("*" if curve["extrapolated"] else "") + ("" if curve["adequate"] or not math.isfinite(curve["median"]) else "†")
            value, low, high = row.ratio[i]
            rows.append({"what": words.capitalised(row.what) if i == 0 else "", "design": label,
                         "median": words.plus_minus(curve["median"], curve["median_se"]) + mark, "counted": shown_half(curve),
                         "dispersion": words.plus_minus(curve["dispersion"], curve["dispersion_se"]),
                         "ratio": "" if i == 0 else words.fixed(value, 2) + _mark(value, row.curves[0], curve), "interval": "" if i == 0 or not math.isfinite(low) else f"{low:.2f} to {high:.2f}",
                         "verdict": "" if i == 0 else verdict(row.ratio[i])})
    return rows


def _provenance(found, several):
    return [(f"{label}, over {found.im_symbol}" if several else label, f"{sweep.folder.resolve().name}: {words.count(sweep.samples)} samples, seed {sweep.attributes.get('seed', '–')}, "
             f"freestand {sweep.attributes.get('version', '–')}, {sweep.attributes.get('created_utc', '')}") for sweep, label in zip(found.sweeps, found.labels)]
