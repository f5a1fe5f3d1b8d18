"""A verdict in words: the title of the page and the finding over the candidates, both from the rows that stand under them."""
import math

from . import validation, words

WITHDRAWN = "data"  # reason of a verdict that was withdrawn: the measurements look wrong


def faults(diagnosis):
    """What the laboratory states wrongly, of what the verdict speaks of."""
    return [validation.FAULTS[row["effect"]] for row in diagnosis.candidates if row["as_good_as_best"] and row["effect"] in validation.FAULTS]


def title(diagnosis, was=False):
    """What the page is called. was: the model has the effect by now."""
    several, named = len(diagnosis.effects) > 1, validation.effects(diagnosis.effects)
    if diagnosis.verdict == "missing":
        verb = ("were" if was else "are") if several else ("was" if was else "is")
        return f"the missing effect{'s' * several} {verb} {named}"
    if diagnosis.verdict == "ambiguous" and faults(diagnosis):
        return f"the missing effect is {named}, or {words.listing(faults(diagnosis), 'or')} is off"
    if diagnosis.verdict == "ambiguous":
        return f"the missing effect is {_rivals(diagnosis)}, and these tests cannot tell which"
    if diagnosis.verdict == "bad_data" and faults(diagnosis):
        return f"no effect is needed: {words.listing(faults(diagnosis), 'or')} is off"
    if diagnosis.verdict == "none":
        return _whose_friction(diagnosis) + "these tests show no missing effect"
    if diagnosis.proposal and diagnosis.reason == "one_law":
        return (f"one law of no catalogue, {validation.effect(diagnosis.proposal['effect'])}, does for {validation.effects(diagnosis.best['effect'].split('+'))}: "
                f"it leaves {_error(diagnosis.proposal)} of {_error(diagnosis.base)}")
    if diagnosis.proposal:
        return (f"no effect of the catalogue explains it; {validation.effect(diagnosis.proposal['effect'])}, a law of no catalogue, "
                f"leaves {_error(diagnosis.proposal)} of {_error(diagnosis.base)}")
    if diagnosis.unit == "ln ratio" and diagnosis.reason in ("none_helps", "none_suffices"):
        lacks = "the model" if diagnosis.reason == "none_helps" else "even the best effect of the catalogue"
        return f"{lacks} misses the peaks by more than one test misses another, so something else is wrong"
    return {WITHDRAWN: "no verdict, since the measurements look wrong in a sign, a clock, a unit, an offset or a dimension",
            "none_helps": "the model misses more than noise explains, and no effect of the catalogue predicts the tests left out better, beyond chance",
            "none_suffices": "no effect of the catalogue explains all that the model misses"}.get(
                diagnosis.reason, "the model lacks something that no effect of the catalogue explains")


def friction_scatters(diagnosis):
    return diagnosis.raw.get("decided_by") == "friction_scatter"


def _whose_friction(diagnosis):
    if not friction_scatters(diagnosis):
        return ""
    odd = (diagnosis.raw.get("friction_scatter") or {}).get("odd_test")
    return f"test {odd} has a friction of its own; " if odd else "friction differs from test to test; "


def gains_beyond_chance(diagnosis):
    """Does the best effect gain more than it would where nothing is missing?"""
    return any(row["question"] == "does an effect help" and row["p"] <= row["level"] for row in diagnosis.chances)


def leaves_more_than_chance(diagnosis):
    """Does the base leave more than data from itself would?"""
    return any(row["question"] == "is it enough" and row["about"] == "the model as it is" and row["p"] <= row["level"] for row in diagnosis.chances)


def best_in_words(diagnosis, name):
    """The candidate with the least left-out error, as far as the verdict names it."""
    if diagnosis.verdict != "none" and diagnosis.reason != "none_helps":
        return f"with {name}, on tests left out of the fit"
    if diagnosis.verdict == "none" and friction_scatters(diagnosis):
        return f"best effect on tests left out, {name}: friction that differs from test to test explains it"
    if diagnosis.raw.get("enough_if"):
        return f"with {name}, on tests left out: within its tolerance"
    if gains_beyond_chance(diagnosis):
        return f"best candidate, {name}: " + ("not needed" if diagnosis.verdict == "none" else "no better on tests left out")
    return f"best candidate, {name}: better by no more than chance"


def _rivals(diagnosis):
    """"static friction or a tilt of the floor"; of pairs "floor tilt with viscous drag or floor tilt with a spring"."""
    rivals = [row["effect"].split("+") for row in diagnosis.candidates if row["as_good_as_best"]]
    if all(len(names) == 1 for names in rivals):
        return validation.effects(diagnosis.effects, " or ")
    return words.listing([validation.effects(names, " with ") for names in rivals], "or")


def finding(diagnosis):
    """The same over the candidates, with the numbers of their rows."""
    best, base = diagnosis.best, _error(diagnosis.base)
    name = validation.effect(best.get("effect", ""))
    if diagnosis.reason == WITHDRAWN and not faults(diagnosis):
        return "What each effect would leave, were the measurements right: none is named"
    if not best:
        return f"No candidate was fitted to the end; the base leaves {base} {diagnosis.unit}"
    if diagnosis.verdict == "none" and friction_scatters(diagnosis):
        return (f"A friction of its own in each test explains what the base misses: the base leaves {base} {diagnosis.unit} on tests left out, the "
                f"effect that is best there, {name}, {_error(best)}")
    if diagnosis.raw.get("enough_if"):
        return f"No effect is needed: if {diagnosis.raw['enough_if']}, within its tolerance, the model is enough that leaves {base} {diagnosis.unit} as it stands"
    if diagnosis.verdict == "none" and gains_beyond_chance(diagnosis):
        leaves = "more than noise explains, but no more than one reading strays by" if leaves_more_than_chance(diagnosis) else "no more than noise explains"
        return (f"No effect is needed: the base leaves {base} {diagnosis.unit}, {leaves}, the floor's noise allowed for; the best, {name}, "
                f"{_error(best)}, more than chance and less than matters")
    if diagnosis.reason == "none_helps" and gains_beyond_chance(diagnosis):
        return f"No candidate predicts the tests left out any better: the base leaves {base} {diagnosis.unit}, the best, {name}, {_error(best)}"
    if diagnosis.verdict == "none" or diagnosis.reason == "none_helps":
        return (f"No candidate predicts the tests left out better than the base by more than chance: the base leaves {base} "
                f"{diagnosis.unit}, the best, {name}, {_error(best)}")
    if diagnosis.reason == "one_law":
        together = validation.effects(best["effect"].split("+"))
        return (f"{together.capitalize()} together would be enough, with more numbers than one law takes: they leave {_error(best)} {diagnosis.unit}, the base "
                f"{base}{_others(diagnosis, [best])}")
    if diagnosis.verdict == "unknown":
        return (f"The best candidate, {name}, still misses the tests left out by {_error(best)} {diagnosis.unit}; the base leaves "
                f"{base}{_others(diagnosis, [best])}")
    rivals = [row for row in diagnosis.candidates if row["as_good_as_best"]]
    if diagnosis.verdict == "ambiguous" and len(rivals) > 1:
        each = words.listing(f"{validation.effect(row['effect'])} ({_error(row)})" for row in rivals)
        return f"Chance does not part {each}; the base leaves {base} {diagnosis.unit}{_others(diagnosis, rivals)}"
    return f"With {name} the left-out error falls from {base} to {_error(best)} {diagnosis.unit}{_others(diagnosis, [best])}"


def _error(row):
    return validation.error(row.get("error_left_out", math.nan))


def _others(diagnosis, named):
    """What candidates leave that the verdict does not name: those at least as good with what is held against them, then the next."""
    rest = [row for row in diagnosis.candidates if row["visible"] and row["left_out_refitted"] and math.isfinite(row["error_left_out"])
            and all(row["effect"] != other["effect"] for other in named)]
    bar = min(row["error_left_out"] for row in named)
    low = [row for row in rest if row["error_left_out"] <= bar or (not row["numbers_as_met_in_practice"] and row["error_left_out"] < 1.1 * bar)]
    alike = {}
    for row in low:
        alike.setdefault(_against(row, named[0]), []).append(f"{validation.effect(row['effect'])} leaves {_error(row)}")
    parts = [words.listing(told) + reason for reason, told in alike.items()]
    worse = [row["error_left_out"] for row in rest if row not in low]
    if worse:
        parts.append(f"the next best leaves {validation.error(min(worse))}")
    return "".join(f"; {part}" for part in parts)


def _against(row, best):
    """Why a row with the lesser error is not the best, as far as the row says."""
    if row["remark"]:
        return f", {row['remark']}"
    if not row["numbers_as_met_in_practice"]:
        return ", with numbers that are not met in practice"
    if len(row["effects"]) > len(best["effects"]):
        return ", with more effects"
    if row["error_left_out_floor_noise_allowed"] > best["error_left_out_floor_noise_allowed"]:
        return (f", but {validation.error(row['error_left_out_floor_noise_allowed'])} against {validation.error(best['error_left_out_floor_noise_allowed'])} where the "
                "floor's noise is allowed for")
    return ", which chance does not part from it"
