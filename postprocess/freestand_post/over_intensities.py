"""One design over several intensities: the same samples, fitted over each."""
from dataclasses import dataclass

from . import designs, words


@dataclass
class Intensities:
    sweeps: list       # fits of one study, each over its own intensity
    events: list       # (what, [curve over each])

    @property
    def level(self):
        return self.sweeps[0].level


def compare(sweeps):
    """What several sweeps are, as a list: Intensities where they are of one study, each over its own intensity; else the Designs over each
    intensity, where every design was fitted over every one; else what designs.compare() makes of them."""
    if len({sweep.im_name for sweep in sweeps}) == len(sweeps) and designs.same_study(sweeps):
        return [Intensities(sweeps, list(designs.curves(sweeps)))]
    over = {}
    for sweep in sweeps:
        over.setdefault((sweep.im_name, sweep.im_unit), []).append(sweep)
    groups = list(over.values())
    if any(len(group) < 2 for group in groups) or not all(designs.same_designs(groups[0], group) for group in groups[1:]):
        return [designs.compare(sweeps)]
    return [designs.compare(group) for group in groups]


def content(found, figures, risks):
    """What the page shows."""
    first = found.sweeps[0]
    symbols = words.listing([sweep.im_symbol for sweep in found.sweeps])
    name = words.capitalised(str(first.summary.get("study_name") or first.folder.resolve().name))
    what, curves = next(((what, curves) for what, curves in found.events if all(_known(curve) for curve in curves)), ("", []))
    return {"title": f"{name}: over {symbols}", "lead": f"One sweep of {words.plural(first.samples, 'sample')}, fitted over {symbols}.",
            "headline": [designs.headline(sweep, curve, what) for sweep, curve in zip(found.sweeps, curves)],
            "figures": [figure for figure in figures if figure["section"] != "risk"], "rows": list(_rows(found)), "warnings": designs.warnings(found.sweeps, [f"over {sweep.im_symbol}" for sweep in found.sweeps]), "level": found.level, "risks": risks,
            "provenance": [(sweep.im_symbol, f"{sweep.folder.resolve().name}: {words.count(sweep.samples)} samples, seed {sweep.attributes.get('seed', '–')}, "
                            f"freestand {sweep.attributes.get('version', '–')}, {sweep.attributes.get('created_utc', '')}") for sweep in found.sweeps]}


def _known(curve):
    return curve["median"] > 0


def _rows(found):
    for what, curves in found.events:
        for i, (sweep, curve) in enumerate(zip(found.sweeps, curves)):
            yield {"what": words.capitalised(what) if i == 0 else "", "im": words.with_unit(sweep.im_symbol, sweep.im_unit),
                   "median": words.plus_minus(curve["median"], curve["median_se"]),
                   "counted": designs.shown_half(curve),
                   "dispersion": words.plus_minus(curve["dispersion"], curve["dispersion_se"]),
                   "mark": ("*" if curve["extrapolated"] else "") + ("" if curve["adequate"] or not _known(curve) else "†")}
