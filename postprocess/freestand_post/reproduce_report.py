"""The page of `freestand reproduce`: ours beside the print, one picture for each table or figure that has one."""
import math

from . import words
from .reading_reproduce import AGREES, ALONE, DISAGREES, WITH_ITSELF, number

VERDICT = {AGREES: "agrees", DISAGREES: "disagrees", WITH_ITSELF: "the print disagrees with itself", ALONE: "not printed"}
SHOWN_OPEN = 12  # numbers of one table or figure that are shown without a click
PROVENANCE = (("created_utc", "written (UTC)"), ("version", "freestand"), ("git_commit", "commit"), ("command", "command"), ("compiler", "compiler"),
              ("host", "host"), ("ranks", "MPI ranks"))


def content(found, figures):
    provenance = [(label, str(found.provenance[key])) for key, label in PROVENANCE if found.provenance.get(key) not in (None, "")]
    return {"title": _title(found), "lead": _lead(found), "headline": _headline(found), "own": bool(found.own_peaks), "places": [_place(place, figures) for place in found.places],
            "off": [_row(item, place) for place in found.places for item in place.items if item["verdict"] in (DISAGREES, WITH_ITSELF)], "provenance": provenance}


def _title(found):
    if found.own_peaks:
        return f"Measured peaks of {found.own_peaks}: line, bins, fit and fragility"
    return f"{found.agree} of {found.printed} numbers of the report agree within rounding"


def _lead(found):
    if found.own_peaks:
        return ("Demand Δ = U ω²/PTA over intensity IM = PTA/(μ g) − 1, as Konstantinidis and Makris (2005) treat their own peaks: mean and standard deviation grow with IM "
                "through the origin, and a lognormal with these moments gives the fragility.")
    return ("Konstantinidis and Makris (PEER report 2005/07), computed again: what follows from its printed tables by its own equations, and what freestand's simulations give. A number "
            "agrees where the print's last digit reaches ours, or reaches what ours becomes while the printed inputs go through all that they may have been before they were rounded (a "
            "thousand draws)."
            + ("" if found.records else " Without --records the outcomes of table 7.1 are computed under the report's pulses alone."))


def _headline(found):
    if found.own_peaks:
        place = found.places[0]
        return [(words.number(place.value(name), 3), what) for name, what in (("slope", "slope of the mean demand"), ("sd_slope", "slope of its standard deviation"), ("r2", "r²"), ("ks_p", "p of the fit"))]
    return [(str(found.agree), "numbers agree"), (str(found.with_itself), "in which the print disagrees with itself"), (str(found.disagree), "that disagree otherwise")] + _statements(found)


def _statements(found):
    """What the report says in words, or as a range, is none of the numbers that are counted."""
    off = [item for place in found.places for item in place.items if item["kind"] == "statement" and item["verdict"] in (DISAGREES, WITH_ITSELF)]
    return [(str(len(off)), "statement in words that disagrees, beside the numbers" if len(off) == 1 else "statements in words that disagree, beside the numbers")] if off else []


def _place(place, figures):
    rows = [_row(item, place) for item in place.items]
    printed = place.printed()
    agree = sum(item["verdict"] == AGREES for item in printed)
    return {"id": place.id, "place": place.place, "what": words.capitalised(place.what), "count": f"{agree} of {len(printed)}" if printed else "–", "all": agree == len(printed),
            "figures": [figure for figure in figures if figure["section"] == place.id], "rows": rows, "folded": len(rows) > SHOWN_OPEN, "left_out": place.left_out,
            "alone": not printed and all(row["print"] == "–" for row in rows)}


def _row(item, place):
    if item["kind"] == "statement":
        return {"what": _sentence(item["what"]), "place": place.place, "ours": item["ours"], "print": item["print"] or "–", "difference": "", "verdict": VERDICT[item["verdict"]], "why": item["why"],
                "words": True, "off": item["verdict"] in (DISAGREES, WITH_ITSELF)}
    unit = item["unit"]
    ours, printed = number(item["ours"]), number(item["print"])
    return {"what": _sentence(item["what"]), "place": place.place, "ours": _digits(ours) + _unit(unit), "print": _as_printed(printed, item["print_unit"]) + _unit(unit) if math.isfinite(printed) else "–",
            "difference": words.number(number(item["difference"]), 2), "verdict": VERDICT[item["verdict"]], "why": item["why"], "words": False, "off": item["verdict"] in (DISAGREES, WITH_ITSELF)}


def _sentence(text):
    """A capital at its start, where that is a word and no symbol."""
    return text if len(text.split(" ")[0]) < 3 and text[0] in "pr" else words.capitalised(text)


def _digits(value):
    return words.plain(value) if math.isfinite(value) and value == round(value) and abs(value) < 1e4 else words.number(value, 4)


def _as_printed(value, last):
    """With as many decimals as the print has."""
    return words.fixed(value, max(0, round(-math.log10(last)))) if last and last < 1 else words.plain(value)


def _unit(unit):
    return "" if unit == "1" else f"\u00a0{words.UNITS.get(unit, unit)}"
