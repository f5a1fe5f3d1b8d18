"""The three-part demand model, evaluated from the parameters in fragility.h5.

P(EDP > C) = p_over + (1 - p_over) (1 - p_still) (1 - Phi((ln C - lambda)/omega))      bins whose lognormal is adequate (status 0)
P(EDP > C) = (n_over + samples beyond C) / n, from the stored histogram of ln EDP      bins without one (2, 3, 4)
nan                                                                                    bins with too few samples (status 1)
"""
import numpy as np
from scipy.special import ndtr

from .reading import FITTED, REJECTED, TOO_FEW, UNPROVEN


def exceedance(edp, capacity):
    """[im, capacity] probabilities for any capacities > 0."""
    capacity = np.asarray(capacity, float)
    bins = edp.bins
    kept = kept_fits(edp)
    result = np.full((bins["n"].size, capacity.size), np.nan)
    for i, status in enumerate(bins["status"]):
        if (status == FITTED or kept[i]) and bins["omega"][i] > 0:
            tail = ndtr((bins["lambda"][i] - np.log(capacity)) / bins["omega"][i])
            over, still = bins["p_over"][i], np.nan_to_num(bins["p_still"][i])
            result[i] = over + (1 - over) * (1 - still) * tail
        elif status != TOO_FEW and bins["n"][i] > 0:
            beyond = np.concatenate([np.cumsum(edp.cells[i][::-1])[::-1], [0.0]])
            standing = np.interp(np.log(capacity), edp.ln_edge, beyond) if edp.cells.shape[1] else 0.0  # no cells: none that moved stood
            result[i] = (bins["n_over"][i] + standing) / bins["n"][i]
    return result


def kept_fits(edp):
    """[im] true where a lognormal is not known to be adequate and the study told to keep it all the same."""
    counted = np.isclose(edp.surface["probability"], edp.surface["empirical"], rtol=0, atol=1e-9).all(axis=1)
    return np.isin(edp.bins["status"], (REJECTED, UNPROVEN)) & ~counted


def crossing(x, y, level):
    """Least x at which the polyline y(x) passes `level` from below; nan where it does not."""
    good = np.isfinite(y)
    order = np.argsort(np.asarray(x)[good])
    x, y = np.asarray(x)[good][order], np.asarray(y)[good][order]
    for i in range(len(x) - 1):
        if y[i] < level <= y[i + 1]:
            return x[i] + (level - y[i]) / (y[i + 1] - y[i]) * (x[i + 1] - x[i])
    return np.nan


def counted_median(curve):
    """Where the counted shares of a fragility function's bins reach one half; infinite where all of them lie below that, 0 where they lie
    above; nan where they fall."""
    good = curve["counted"][np.isfinite(curve["counted"])]
    if not good.size:
        return np.nan
    return np.inf if good.max() < 0.5 else 0.0 if good.min() >= 0.5 else crossing(curve["im"], curve["counted"], 0.5)


def chosen_capacities(edp, limit=5):
    """Positions of a few capacities, spread over the list."""
    n = edp.capacity.size
    return sorted({round(i * (n - 1) / (min(n, limit) - 1)) for i in range(min(n, limit))}) if n > 1 else list(range(n))
