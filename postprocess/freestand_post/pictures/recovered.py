"""The friction, or the force that the base lacks, recovered from the measured motion itself, against what it may depend on, with the law of
the best effect."""
import dataclasses

import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 120
COLUMNS, SHOWN = 3, 6
TELLS = 0.05  # share of the scatter, beyond what chance explains, that makes a variable worth a panel beyond the first three
NAMED = ("missing", "ambiguous")  # verdicts that name an effect, so that there is a law to draw
CAPTION = ("Recovered without any effect model: the friction coefficient that balances the measured acceleration while the block slips, or, where that "
           "tells more, as of a spring, which cancels in friction there and back, the force that is missing beside the base's friction, over the mass. "
           "The first and last 0.06 s of each slip are left out, and with them its low speeds. Points: mean of a bin; band: 95 % interval of that mean; dashed: the constant of the base model; line: the law of the "
           "effect that the verdict names, or that is proposed, at the same instants. Percentages: share of the scatter that the variable explains, and what bands as wide would explain by chance. First the variable of the law, then the most telling.")


@dataclasses.dataclass(frozen=True)
class Quantity:
    """What is drawn: columns of its mean, its band and its law."""
    mean: str
    lower: str
    upper: str
    law: str
    label: str
    noun: str
    unit: str = ""


FRICTION = Quantity("mu", "mu_lower", "mu_upper", "law", "friction coefficient μ", "friction")
FORCE = Quantity("force_mps2", "force_lower_mps2", "force_upper_mps2", "law_force_mps2", "force over mass (m/s²)", "missing force", " m/s²")


def _quantity(table):
    beyond = table.share_of_force_explained - table.share_of_force_by_chance
    tells_more = beyond >= TELLS and not table.share_explained - table.share_by_chance >= beyond
    return FORCE if tells_more and table.variable in ("position_m", "time_s") else FRICTION


def _share(table):
    return table.share_of_force_explained if _quantity(table) is FORCE else table.share_explained


def _chance(table):
    return table.share_of_force_by_chance if _quantity(table) is FORCE else table.share_by_chance


def _beyond_chance(table):
    return _share(table) - _chance(table)


def pictures(results):
    if isinstance(results, Validation):
        for k, diagnosis in enumerate(results.diagnoses):
            tables = _telling(diagnosis)
            if tables:
                yield _picture(diagnosis, tables, k)


def _telling(diagnosis):
    known = [table for table in diagnosis.recovered if np.isfinite(table.columns["mu"]).sum() > 1]
    known.sort(key=lambda table: (not _follows(diagnosis, table), -np.nan_to_num(_beyond_chance(table))))
    telling = [table for table in known if _beyond_chance(table) >= TELLS or _follows(diagnosis, table)]
    return (telling if len(telling) > 4 else telling[:3] if len(telling) > 2 else known[:3])[:SHOWN]


def _has_law(diagnosis, table):
    """A law is drawn of the effect that the verdict names, or of the one proposed, and of no other."""
    shown = diagnosis.proposal or diagnosis.best
    mine = set(table.law_effects) == set(shown.get("effects", []))
    return (diagnosis.verdict in NAMED or diagnosis.proposal) and mine and np.isfinite(table.columns.get(_quantity(table).law, np.zeros(0))).any()


def _follows(diagnosis, table):
    return _has_law(diagnosis, table) and table.law_follows


def _laws(diagnosis, tables):
    """Of each panel: its law where one is to be drawn. A law of one variable says nothing in the panels of the others."""
    some = any(_follows(diagnosis, table) for table in diagnosis.recovered)
    return [table.columns[_quantity(table).law] if _follows(diagnosis, table) or (_has_law(diagnosis, table) and not some)
            else np.full(table.centre.size, np.nan) for table in tables]


def _picture(diagnosis, tables, k):
    rows = -(-len(tables) // COLUMNS)
    fig = style.figure(8.6, 1.15 + 2.15 * rows)
    axes = fig.subplots(rows, COLUMNS, squeeze=False)
    for ax in axes.flat[len(tables):]:
        ax.set_axis_off()
    laws = _laws(diagnosis, tables)
    for ax, table, law in zip(axes.flat, tables, laws):
        _panel(ax, table, law, diagnosis.base_mu)
    for quantity in (FRICTION, FORCE):
        mine = [i for i, table in enumerate(tables) if _quantity(table) is quantity]
        for i in mine:
            axes.flat[i].set_ylim(*_range(diagnosis.base_mu, [tables[j] for j in mine], [laws[j] for j in mine]))
            if i % COLUMNS == 0 or i - 1 not in mine:
                axes.flat[i].set_ylabel(quantity.label)
            else:
                axes.flat[i].tick_params(labelleft=False)
    finding = _finding(diagnosis, tables)
    law = [name for name in tables[0].law_effects if name]
    line = f"blue: law of {validation.effects(law) or 'the model'}; " if any(np.isfinite(law).any() for law in laws) else ""
    left_out = len([table for table in diagnosis.recovered if np.isfinite(table.columns["mu"]).any()]) - len(tables)
    style.headline(fig, finding, f"Black: recovered from the measured motion; band: 95 % interval; {line}dashed: base model."
                   + (f" Not shown: {words.plural(left_out, 'variable')} that tell less." if left_out > 0 else ""))
    return Picture("recovered" if k == 0 else f"recovered_{k + 1}", fig, finding, CAPTION, "recovered")


def _panel(ax, table, law, base):
    factor, label = validation.scaled(table)
    quantity = _quantity(table)
    mu, x = table.columns[quantity.mean], factor * table.centre
    good = np.isfinite(mu) & np.isfinite(x)
    low, high = table.columns[quantity.lower], table.columns[quantity.upper]
    if np.isfinite(base):
        ax.axhline(0 if quantity is FORCE else base, color=style.MUTED, lw=1.0, ls=(0, (4, 2)), zorder=1)
    if table.variable == "direction":
        error = np.vstack([mu - low, high - mu])[:, good]
        ax.errorbar(x[good], mu[good], yerr=np.nan_to_num(np.maximum(error, 0)), fmt="o", ms=5.5, color=style.INK, elinewidth=6, alpha=0.9,
                    ecolor="#cfd4da", mec="white", mew=0.8, zorder=3)
        ax.plot(x[good], law[good], "_", ms=34, mew=2.2, color=style.BLUE, zorder=4)
        ax.set(xlim=(-1.8, 1.8), xticks=[-1, 1], xticklabels=["towards −", "towards +"], xlabel=validation.short_variable(table))
    else:
        ax.fill_between(x[good], low[good], high[good], color="#dfe3e8", lw=0, zorder=0)
        ax.plot(x[good], mu[good], "o", ms=4.5, color=style.INK, mec="white", mew=0.6, zorder=3)
        ax.plot(x[good], law[good], color=style.BLUE, lw=2.0, zorder=2)
        ax.set_xlabel(label)
        ax.locator_params(axis="x", nbins=5)
    share = _share(table)
    explained = f": {words.percent(max(share, 0.0))} (chance {words.percent(_chance(table))})" if np.isfinite(share) else ""
    ax.set_title(words.capitalised(validation.short_variable(table)) + explained, size=8.8, weight="bold",
                 color=style.INK if _beyond_chance(table) >= TELLS else style.MUTED, pad=4)
    style.grid(ax)


def _range(base_mu, tables, laws):
    """Of panels of one quantity. Holds every mean and law, and the bands where they are not far wider than those."""
    quantity = _quantity(tables[0])
    shown = np.concatenate([[0 if quantity is FORCE else base_mu]] + [table.columns[quantity.mean] for table in tables] + laws)
    low, high = np.nanmin(shown), np.nanmax(shown)
    room = max(0.35 * (high - low), 0.06 * max(abs(high), 1e-3))
    return low - room, high + room


def _finding(diagnosis, tables):
    top = tables[0]
    share, quantity = _share(top), _quantity(top)
    follows = _follows(diagnosis, top)
    if not _beyond_chance(top) >= TELLS and not follows:
        return "While it slips, the recovered friction follows none of these: what is missing, if anything, acts elsewhere"
    mu, x = top.columns[quantity.mean], top.centre
    good = np.flatnonzero(np.isfinite(mu))
    first, last = mu[good[0]], mu[good[-1]]
    name = validation.short_variable(top)
    if follows:
        law, ends = top.columns[quantity.law], (good[:1], good[-1:]) if top.variable == "direction" else (good[:2], good[-2:])
        from_to = [f"{words.number(a, digits)} to {words.number(b, digits)}"
                   for a, b in ([np.nanmean(values[end]) for end in ends] for values in (mu, law))
                   for digits in [2 if words.number(a) != words.number(b) else 3]]
        return (f"Over the {name} the recovered {quantity.noun} goes from {from_to[0]}{quantity.unit}; the law of "
                f"{validation.effects(top.law_effects)} from {from_to[1]}{quantity.unit}")
    if top.variable == "direction":
        return f"Recovered {quantity.noun} is {words.number(last)}{quantity.unit} one way and {words.number(first)}{quantity.unit} the other"
    ends = [good[:3], good[-3:]]
    inner = [np.nanmean(mu[end]) for end in ends]
    halves = (top.columns[quantity.upper] - top.columns[quantity.lower]) / 2
    band = max(np.nanmean(halves[end]) for end in ends)
    spread, half = np.nanmax(mu) - np.nanmin(mu), np.nanmedian(halves[good])
    if spread > 2 * half and abs(inner[1] - inner[0]) < 0.5 * spread and share > 0.3:
        return (f"Recovered {quantity.noun} goes up and down with the {name}, between {words.number(np.nanmin(mu))} and "
                f"{words.number(np.nanmax(mu))}{quantity.unit}: {words.percent(share)} of its scatter")
    if abs(inner[1] - inner[0]) < max(band, 0.3 * (np.nanmax(mu) - np.nanmin(mu))):
        return (f"Recovered {quantity.noun} scatters most with the {name} ({words.percent(share)} explained), without a clear trend")
    verb = "falls" if inner[1] < inner[0] else "rises"
    return (f"Recovered {quantity.noun} {verb} with the {name}: about {words.number(inner[0])} below "
            f"{words.quantity(x[good[min(2, good.size - 1)]], top.unit)}, {words.number(inner[1])}{quantity.unit} above "
            f"{words.quantity(x[good[-min(3, good.size)]], top.unit)}")
