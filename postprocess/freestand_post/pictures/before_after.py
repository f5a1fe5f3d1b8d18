"""Fragility with the model before and after an effect was added: the main demand parameter, and overturning."""
import json

import numpy as np
import yaml

from .. import style, validation, words
from ..model import chosen_capacities
from ..validation import Validation
from . import Picture

order = 170
CAPTION = "The same sweep with the model before and after: probability that {what}, against {im}; bands: {level}."


def pictures(results):
    if isinstance(results, Validation) and len(results.sweeps) > 1:
        before, after = results.sweeps[0], results.sweeps[-1]
        if before.im == after.im and _same_shaking(before, after) and (_common(before, after) or _both_overturn(before, after)):
            yield _picture(before, after)


def mismatch(results):
    """Why two sweeps are not drawn together; empty where they are, or where there are not two."""
    if len(results.sweeps) < 2:
        return ""
    before, after = results.sweeps[0], results.sweeps[-1]
    if before.im != after.im:
        return f"The sweeps are not drawn together: one is over {before.im_symbol}, the other over {after.im_symbol}."
    if not _same_shaking(before, after):
        return (f"The sweeps are not drawn together: {before.im_symbol} holds {OF_THE_MODEL[str(before.im)]} of the model, which is another one after, so that "
                "one value is two shakings. Sweep both over pga_g, pta_g or sa_g (im: pga_g).")
    return "" if _common(before, after) or _both_overturn(before, after) else "The sweeps share no demand parameter and capacity."


# Intensities that hold numbers of the model, by the keys of a study that give these: PTA/(mu g) - 1 is another shaking where mu is another one.
OF_THE_MODEL = {"report": "friction", "pga_over_g_tan_alpha": "block", "p_pgv_over_g_tan_alpha": "block"}


def _same_shaking(before, after):
    key = OF_THE_MODEL.get(str(before.im))
    if not key:
        return True
    given = [yaml.safe_load(str(sweep.attributes.get("study", ""))) or {} for sweep in (before, after)]
    one, other = (study.get(key) for study in given)
    return one == other and "posterior" not in str(one)


def _common(before, after):
    """The first demand parameter of both, and the positions of a few capacities that both hold: (edp, edp, [(i, j)])."""
    for edp in before.continuous():
        other = next((entry for entry in after.continuous() if entry.name == edp.name and entry.unit == edp.unit), None)
        pairs = [(i, int(np.argmin(np.abs(other.capacity - c)))) for i, c in enumerate(edp.capacity)] if other else []
        pairs = [(i, j) for i, j in pairs if np.isclose(edp.capacity[i], other.capacity[j])]
        if pairs:
            return edp, other, _shown(before, after, edp, other, pairs)
    return None


def _change(before, after, first, second, i, j):
    """Of P(EDP > capacity i) at the intensities of the first sweep; NaN where the other does not reach."""
    p, q = first.surface["probability"][:, i], second.surface["probability"][:, j]
    good = np.isfinite(q)
    if good.sum() < 2:
        return np.full(len(p), np.nan)
    return np.interp(before.centre, after.centre[good], q[good], left=np.nan, right=np.nan) - p


def _largest(before, after, first, second, pair):
    change = np.abs(_change(before, after, first, second, *pair))
    return np.nanmax(change) if np.isfinite(change).any() else -1


def _shown(before, after, first, second, pairs):
    """Two capacities at most, the one that changes most among them."""
    if len(pairs) <= 2:
        return pairs
    most = max(pairs, key=lambda pair: _largest(before, after, first, second, pair))
    others = [pairs[k] for k in chosen_capacities(first, 3) if k < len(pairs) and pairs[k] != most]
    return sorted([most] + others[:1])


def _both_overturn(before, after):
    return all(sweep.overturning and np.isfinite(sweep.overturning["probability"]).any() for sweep in (before, after))


def names(results):
    """What the sweeps are called: by the effects of their models, by folder where those do not part them."""
    found = []
    for sweep in (results[0], results[-1]):
        try:
            held = [entry["name"] for entry in json.loads(str(sweep.attributes.get("effects", "[]")))]
        except (ValueError, TypeError, KeyError):
            held = []
        found.append(validation.model_name(held))
    return found if found[0] != found[1] else [results[0].folder.resolve().name, results[-1].folder.resolve().name]


def _picture(before, after):
    common, over = _common(before, after), _both_overturn(before, after)
    panels = (len(common[2]) if common else 0) + over
    fig = style.figure(7.4 if panels < 3 else 8.6, 3.9)
    axes = fig.subplots(1, panels, sharey=True, squeeze=False)[0]
    sides = list(zip((before, after), (style.VERMILION, style.BLUE), names([before, after])))
    for k, (i, j) in enumerate(common[2] if common else ()):
        for (sweep, colour, name), edp, at in zip(sides, common[:2], (i, j)):
            _band(axes[k], sweep.centre, *(edp.surface[key][:, at] for key in ("probability", "lower", "upper")), colour, name)
        axes[k].set_title(f"P({common[0].label} > {words.chosen(common[0].capacity[i], common[0].unit)})", weight="bold", pad=5)
    if over:
        for sweep, colour, name in sides:
            curve = sweep.overturning
            _band(axes[-1], curve["grid"], curve["probability"], curve["lower"], curve["upper"], colour, name, mark="")
        axes[-1].set_title("P(overturned)", weight="bold", pad=5)
    low, high = min(before.view[0], after.view[0]), max(before.view[1], after.view[1])
    for ax in axes:
        ax.set(xlim=(low, high), ylim=(0, 1.015), xlabel=words.with_unit(before.im_symbol, before.im_unit))
        style.grid(ax)
    axes[0].set_ylabel("probability")
    style.legend_above(axes, ncol=2)
    finding = _finding(before, after, common, sides[1][2])
    level = " and ".join(dict.fromkeys((before.level, after.level))) + " intervals"
    style.headline(fig, finding, f"The same sweep with both models; bands: {level}.")
    exceeds = [f"the {words.demand_meaning(common[0].name)} exceeds a capacity (a specimen that overturns exceeds them all)"] if common else []
    text = CAPTION.format(what=", and that ".join(exceeds + ["the specimen overturns"] * over), im=before.im_symbol, level=level)
    return Picture("before_after", fig, finding, text, "before_after")


def _band(ax, x, p, low, high, colour, name, mark="o"):
    ax.fill_between(x, low, high, color=colour, alpha=0.15, lw=0)
    ax.plot(x, p, "-" + mark, ms=3.5, color=colour, lw=1.8, label=name)


def _finding(before, after, common, name):
    if not common:
        return f"Overturning {validation.by(name)}, and before"
    first, second, pairs = common
    i, j = max(pairs, key=lambda pair: _largest(before, after, first, second, pair))
    p, change = first.surface["probability"][:, i], _change(before, after, first, second, i, j)
    if not np.isfinite(change).any():
        return "The two sweeps share too little to compare the fragilities"
    at = int(np.nanargmax(np.abs(change)))
    what = f"P({first.label}\u00a0>\u00a0{words.chosen(first.capacity[i], first.unit)})"
    if abs(change[at]) < 0.02:
        return f"{words.capitalised(validation.by(name))} {what} changes by less than 0.02 at every intensity"
    verb = "rises" if change[at] > 0 else "falls"
    return (f"{words.capitalised(validation.by(name))} {what} {verb} by up to {words.number(abs(change[at]))}, from "
            f"{words.probability(p[at])} to {words.probability(p[at] + change[at])} {words.is_(f'at {before.im_symbol}', before.centre[at], before.im_unit)}")
