"""Probability of what happens or not (a connection that fails) against intensity: counted shares with their bands."""
import numpy as np

from .. import style, words
from ..model import crossing
from ..reading import Sweep
from . import Picture

order = 55
CAPTION = ("Points: share of all samples of each bin, overturned ones among them, in which it happened; bars and band: {level} interval, "
           "from resampled motions and never narrower than the exact binomial one.")


def pictures(results):
    if isinstance(results, Sweep):
        for edp in results.happenings():
            yield _picture(results, edp)


def _picture(sweep, edp):
    p, lower, upper = (edp.surface[key][:, 0] for key in ("probability", "lower", "upper"))
    fig = style.figure(7.4, 3.8)
    ax = fig.subplots()
    ax.fill_between(sweep.centre, lower, upper, color=style.BLUE, alpha=0.15, lw=0)
    ax.plot(sweep.centre, p, color=style.BLUE)
    good = np.isfinite(p) & np.isfinite(lower)
    ax.errorbar(sweep.centre[good], p[good], yerr=np.maximum([p[good] - lower[good], upper[good] - p[good]], 0), fmt="o", ms=4.5,
                color=style.INK, mec="white", mew=0.5, elinewidth=1.0, capsize=2)
    if not np.isfinite(p).any():
        ax.text(0.5, 0.5, "no bin has enough samples", transform=ax.transAxes, ha="center", color=style.MUTED)
    top = np.nanmax(np.concatenate([upper, p, [0.0]]))
    ax.set(xlim=sweep.view, ylim=(0, 1.015 if top > 0.5 or top == 0 else 1.25 * top),
           xlabel=words.with_unit(sweep.im_symbol, sweep.im_unit), ylabel=f"P({edp.label})")
    style.grid(ax)
    finding = _finding(sweep, edp, p)
    style.headline(fig, finding, f"Share of the samples of each bin, with {sweep.level} intervals." + _beside(sweep, edp))
    return Picture(f"happening_{edp.name}", fig, finding, CAPTION.format(level=sweep.level), "sweep")


def _beside(sweep, edp):
    """The median of the fitted curve, which tables and exports give, and why it is another number than where the shares reach one half."""
    curve = edp.functions[0] if edp.functions else {}
    if not curve.get("median", np.nan) > 0:
        return ""
    return (f" One lognormal over all bins has its median at {words.quantity(curve['median'], sweep.im_unit)}"
            + (", and is adequate." if curve["adequate"] else ": it smooths over the bins and is not known to be adequate, so the shares count."))


def _finding(sweep, edp, p):
    what = words.capitalised(words.happening(edp.name))
    if not np.isfinite(p).any():
        return f"{what}: too few samples to tell how often"
    if np.nanmax(p) == 0:
        return f"{what} in none of the samples"
    half = crossing(sweep.centre, p, 0.5)
    if np.isfinite(half):
        return f"{what} in half of the samples, as counted, once {sweep.im_symbol} reaches {words.quantity(half, sweep.im_unit)}"
    top = int(np.nanargmax(p))
    return f"{what} in at most {words.percent(p[top])} of the samples, {words.is_(f'at {sweep.im_symbol}', sweep.centre[top], sweep.im_unit)}"
