"""Where a model fails: its error, and how fast it grows, against the phase of motion, the speed and the path slid."""
import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 140
SHOWN = ("phase", "speed_mps", "path_m")
FEW = 5  # points below which a bin says nothing
SHARE = 0.01  # of all points, that a phase must hold to be called the worst; as in the findings of `compare`
ROWS = (("error_noise_units", "error\n({})"), ("growth_noise_units", "grows in 0.1 s by\n({})"))
WHILE = {"stuck": "while stuck", "onset": "as sliding begins", "slipping": "while sliding", "reversal": "as sliding turns round",
         "rocking": "while rocking", "after impact": "just after impacts", "at rest": "after coming to rest"}
CAPTION = ("Above: root mean square error of all instants of a phase, or of a range of speed or path. Once the model is off it stays off, "
           "so the lower row tells more: by how much the error changes within 0.1 s there. Dashed: what sensor noise alone would "
           "make. Hollow: a phase of less than 1 % of the time, too rare to be named.")


def pictures(results):
    if isinstance(results, Validation) and any(_tables(comparison) for comparison in results.comparisons):
        yield _picture(results)


def _tables(comparison):
    """Of the calibration tests, or of those held out where there are no others."""
    for role in ("calibration", "holdout"):
        found = {table.variable: table for table in comparison.tables[role] if np.isfinite(table.columns["error_noise_units"]).any()}
        if found:
            return found
    return {}


def _picture(results):
    shown = [name for name in SHOWN if any(name in _tables(comparison) for comparison in results.comparisons)]
    fig = style.figure(8.6, 4.6)
    axes = fig.subplots(2, max(len(shown), 1), sharey="row", sharex="col", squeeze=False)
    values = {key: [np.array([1.0])] for key, _ in ROWS}
    used = {name: _used(results, name) for name in shown}
    for comparison, label, colour in zip(results.comparisons, results.labels, results.colours):
        for j, name in enumerate(shown):
            table = _tables(comparison).get(name)
            for i, (key, _) in enumerate(ROWS):
                if table:
                    values[key].append(_line(axes[i, j], table, key, used[name], colour, label))
    for i, (key, label) in enumerate(ROWS):
        for ax in axes[i]:
            ax.axhline(1.0 if i == 0 else np.sqrt(2), color=style.MUTED, lw=1.0, ls=(0, (4, 2)), zorder=1)
            style.grid(ax)
        style.error_scale(axes[i, 0], "y", np.concatenate(values[key]))
        for ax in axes[i, 1:]:
            ax.set_yscale(axes[i, 0].get_yscale())
        if axes[i, 0].get_yscale() == "log":
            style.plain_log(axes[i, 0].yaxis, crowd=1.6)
        axes[i, 0].set_ylabel(label.format(results.unit))
    for j, name in enumerate(shown):
        found = (_tables(comparison).get(name) for comparison in results.comparisons)
        _foot(axes[1, j], next(table for table in found if table), used[name])
    if len(results.comparisons) > 1:
        style.legend_above(axes[0], ncol=3)
    fig.align_ylabels(axes[:, 0])
    finding = _finding(results)
    style.headline(fig, finding, "Error of the calibration tests (above), and how fast it grows (below); dashed: sensor noise alone.")
    return Picture("where", fig, finding, CAPTION, "where")


def _present(table, key):
    return np.isfinite(table.columns[key]) & (np.nan_to_num(table.count) >= FEW)


def _often(table):
    return np.nan_to_num(table.count) > SHARE * np.nansum(table.count)


def _used(results, name):
    """Positions of the named bins in which any model has points."""
    tables = [_tables(comparison)[name] for comparison in results.comparisons if name in _tables(comparison)]
    tables = [table for table in tables if table.count.size == tables[0].count.size]
    return np.flatnonzero(np.any([_present(table, "error_noise_units") for table in tables], axis=0))


def _line(ax, table, key, used, colour, label):
    good = _present(table, key)
    value = np.where(good, table.columns[key], np.nan)
    if table.label:
        used = used[used < value.size]
        place, often = np.arange(used.size), _often(table)[used]
        ax.vlines(place, 1.0, value[used], color=colour, lw=1.0, alpha=0.35)
        ax.plot(place[often], value[used][often], "o", ms=6, color=colour, mec="white", mew=0.6, label=label)
        ax.plot(place[~often], value[used][~often], "o", ms=5, color="white", mec=colour, mew=1.2)
    else:
        ax.plot(validation.scaled(table)[0] * table.centre[good], value[good], "-o", ms=4, lw=1.6, color=colour, mec="white", mew=0.5, label=label)
    return value


def _foot(ax, table, used):
    if table.label:
        ax.set(xticks=np.arange(used.size), xlim=(-0.6, used.size - 0.4))
        ax.set_xticklabels([table.label[i] for i in used], rotation=90, size=8)
    else:
        ax.set_xlabel(validation.scaled(table)[1])
        ax.locator_params(axis="x", nbins=5)


def _finding(results):
    table = _tables(results.first).get("phase")
    key = "growth_noise_units"
    if table is None or not _present(table, key).any():
        return "Where the model is off"
    value = np.where(_present(table, key) & _often(table), table.columns[key], np.nan)
    if not np.isfinite(value).any():
        return "Where the model is off"
    top = int(np.nanargmax(value))
    if value[top] < 1.2 * np.sqrt(2):
        return "In no phase does the error grow faster than sensor noise explains"
    by = "" if len(results.comparisons) == 1 else " of the base model" if results.labels[0] == "base" else f" ({results.labels[0]})"
    if not table.label:
        return f"The error{by} against speed and path"
    grown, mean = _in_its_channel(table, top)
    return f"The error{by} comes about mostly {WHILE.get(table.label[top], table.label[top])}: there it changes by {grown} in 0.1 s, {mean} on the average"


def _in_its_channel(table, top):
    """How much the error changes in a phase and on the average, of the channel in which it changes more: "4.5 mm", "1.9 mm"."""
    weight = np.nan_to_num(table.count)
    best = ("", "", 0.0)
    for key, factor, unit in (("growth_slip_m", 1000, "mm"), ("growth_rotation_rad", 1000, "mrad")):
        value = np.nan_to_num(table.columns[key])
        mean = np.sqrt((weight * value ** 2).sum() / weight.sum())
        if mean > 0 and value[top] / mean > best[2]:
            best = (words.quantity(factor * value[top], unit), words.quantity(factor * mean, unit), value[top] / mean)
    return best[:2]
