"""Probability of overturning against intensity: one lognormal curve over all bins, and the counted shares with their intervals."""
import numpy as np

from .. import style, words
from ..model import crossing
from ..reading import Sweep
from . import Picture

order = 50
POINTS = ("Points: share of overturned samples in each bin; bars: {level} interval, with motions as the unit, of which each may make many "
          "samples, and never narrower than the exact binomial one.")
CURVE = (" Line and band: lognormal curve fitted to all bins at once by maximum likelihood; errors and band from resampled motions.")


def pictures(results):
    if not isinstance(results, Sweep) or not results.edps:
        return
    bins = next((edp.bins for edp in results.edps if edp.name == "overturned"), results.edps[0].bins)
    can_fall = results.model in ("rock", "slide_rock") or np.nansum(bins["n_over"])
    if np.isfinite(bins["p_over"]).any() and can_fall:
        yield _picture(results, bins)


def _picture(sweep, bins):
    im, curve = sweep.im_symbol, sweep.overturning
    fig = style.figure(7.4, 4.0)
    ax = fig.subplots()
    drawn = bool(curve) and np.isfinite(curve["probability"]).any()
    if drawn:
        ax.fill_between(curve["grid"], curve["lower"], curve["upper"], color=style.VERMILION, alpha=0.15, lw=0)
        ax.plot(curve["grid"], curve["probability"], color=style.VERMILION)
    p, x = bins["p_over"], sweep.centre
    error = np.vstack([p - bins["p_over_lower"], bins["p_over_upper"] - p])
    good = np.isfinite(p) & np.isfinite(error).all(axis=0)
    ax.errorbar(x[good], p[good], yerr=np.maximum(error[:, good], 0), fmt="o", ms=4.5, color=style.INK, mec="white", mew=0.5,
                elinewidth=1.0, capsize=2)
    top = max(np.nanmax(bins["p_over_upper"][good], initial=0.0), np.nanmax(curve["upper"], initial=0.0) if drawn else 0.0)
    ax.set(xlim=sweep.view, ylim=(0, 1.015 if top > 0.5 else min(1.0, 1.25 * top + 0.005)),
           xlabel=words.with_unit(im, sweep.im_unit), ylabel="P(overturned)")
    style.grid(ax)
    if drawn and sweep.view[0] < curve["median"] < sweep.view[1] and ax.get_ylim()[1] > 0.5:
        ax.plot([curve["median"]] * 2 + [sweep.view[0]], [0, 0.5, 0.5], color=style.MUTED, lw=0.8, ls=(0, (1, 2)))
    finding = _finding(sweep, bins, curve, drawn, im)
    style.headline(fig, finding, _subtitle(sweep, bins, curve, drawn))
    return Picture("overturning", fig, finding, _caption(sweep, curve, drawn), "sweep")


def _caption(sweep, curve, drawn):
    text = POINTS.format(level=sweep.level) + (CURVE if drawn else "")
    if drawn and np.isfinite(curve["misfit"]):
        text += (f" It misses the counted shares by up to {words.probability(curve['misfit'])}, "
                 f"{words.is_(f'at {sweep.im_symbol}', curve['misfit_im'], sweep.im_unit)} (p {words.equals(words.p_value(curve['misfit_p']))})"
                 + (": one curve is too simple." if curve["misfit_p"] < 0.05 else "."))
    return text


def _finding(sweep, bins, curve, drawn, im):
    if not np.nansum(bins["n_over"]):
        return "No specimen overturned in the range swept"
    median = curve.get("median", np.nan) if drawn else np.nan
    half = crossing(sweep.centre, bins["p_over"], 0.5)
    if drawn and not curve["adequate"] and np.isfinite(half):
        return f"By the counted shares, half of the specimens overturn at {words.is_(im, half, sweep.im_unit)}"
    if drawn and curve["adequate"] and np.isfinite(median) and sweep.edge[0] <= median <= sweep.edge[-1]:
        return f"By the fitted curve, half of the specimens overturn at {words.is_(im, median, sweep.im_unit)}"
    shares = bins["p_over"][np.isfinite(bins["p_over"])]
    if shares.min() == shares.max():
        return f"{words.percent(shares[0])} of the specimens fall at every intensity swept"
    top = int(np.flatnonzero(bins["p_over"] == shares.max())[-1])
    if top == np.flatnonzero(np.isfinite(bins["p_over"]))[-1]:
        return (f"{words.percent(bins['p_over'][top])} of the specimens fall at the end of the range swept, "
                f"{words.is_(im, sweep.centre[top], sweep.im_unit)}")
    return (f"Overturning peaks {words.is_(f'at {im}', sweep.centre[top], sweep.im_unit)}, "
            f"where {words.percent(bins['p_over'][top])} of the specimens fall")


def _counted(sweep, bins):
    """Where the shares of the bins themselves reach one half, which is another number than the median of one curve through all of them."""
    half = crossing(sweep.centre, bins["p_over"], 0.5)
    return f"; the counted shares reach one half at {words.quantity(half, sweep.im_unit)}" if np.isfinite(half) else ""


def _subtitle(sweep, bins, curve, drawn):
    if not drawn:
        return f"Counted shares with {sweep.level} intervals; no curve could be fitted."
    beyond = " (beyond the range swept: an extrapolation)" if curve["extrapolated"] else ""
    text = (f"Lognormal curve: median {words.plus_minus(curve['median'], curve['median_se'])}{beyond}, dispersion "
            f"{words.plus_minus(curve['dispersion'], curve['dispersion_se'])} (standard errors){_counted(sweep, bins)}")
    return text + ("; penalised, since the outcomes separate." if curve["penalised"] else f"; bars: {sweep.level} intervals.")
