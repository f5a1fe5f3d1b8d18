"""How well a single draw tells the outcomes apart, and whether chance would do so as well."""
from dataclasses import dataclass

import numpy as np
from scipy import stats

LEVEL = 0.05    # of all draws tried together
LEAST = 0.1     # below it a draw decides nothing that is worth a title
SHUFFLES = 4000


@dataclass
class Separation:
    size: float   # |2 AUC - 1|: 0 where the draw says nothing, 1 where it tells the outcomes apart
    error: float  # standard error of 2 AUC - 1 where the draw has no effect
    p: float      # of such a size, or more, by chance


def event(sweep):
    """[sample] What is told apart: overturned from the rest, or moved from the rest where nothing overturned."""
    return sweep.outcome == (2 if (sweep.outcome == 2).any() else 1)


def separation(sweep, name):
    """Of one draw. Where it has no effect, the events have a random part of the ranks 1 to n1 + n0 of all samples. Their sum, and with it
    AUC = (sum - n1 (n1 + 1)/2)/(n1 n0), is that of Mann and Whitney: the variance of AUC is (n1 + n0 + 1)/(12 n1 n0). Equal values
    make it smaller, never larger.

    A draw that a motion has once for all its samples (the period of a building, say) was drawn as often as there are motions, and what
    happens under one motion is alike. With S_j = sum over the samples of motion j of (event - mean)(rank - mean), n1 n0 (AUC - 1/2) is
    the sum of all S_j, whose signs are random where the draw has no effect: the variance of that sum is the sum of S_j^2.
    """
    good = np.isfinite(sweep.draws[name])
    values, happened = sweep.draws[name][good], event(sweep)[good]
    n1, n0 = int(happened.sum()), int((~happened).sum())
    if n1 == 0 or n0 == 0:
        return Separation(0.0, np.inf, 1.0)
    error = np.sqrt((n1 + n0 + 1) / (3 * n1 * n0))
    if name == "motion":
        return _of_classes(values, happened, error)
    rank = stats.rankdata(values)
    parts = (happened - happened.mean()) * (rank - rank.mean())
    motion = _motion(sweep)
    if motion is not None and _one_value_each(values, motion[good]):
        error = 2 * np.sqrt((np.bincount(motion[good], weights=parts) ** 2).sum()) / (n1 * n0)
    size = 2 * abs(parts.sum()) / (n1 * n0)
    return Separation(size, error, float(2 * stats.norm.sf(size / error)) if error > 0 else 1.0)


def _motion(sweep):
    """[sample] Number of the motion; floors under one record count as that record, and so do its other entries in the study."""
    if "motion" not in sweep.draws or not len(sweep.motions):
        return None
    names = np.unique(np.array(sweep.motions)[sweep.ground], return_inverse=True)[1]
    return names[sweep.draws["motion"].astype(int)]


def _one_value_each(values, motion):
    order = np.lexsort((values, motion))
    values, motion = values[order], motion[order]
    same = motion[1:] == motion[:-1]
    return bool(same.any() and np.all(values[1:][same] == values[:-1][same]))


def _of_classes(values, happened, error):
    """Motions have no order: they are ranked by how often the event happens under each. That parts some events by chance alone; the mean of
    its square over events dealt out anew to all samples is taken off, and the share of those as large is p."""
    which = np.unique(values, return_inverse=True)[1]
    all_of, events = np.bincount(which), np.bincount(which, weights=happened).astype(int)
    dealt = np.random.default_rng(1).multivariate_hypergeometric(all_of, events.sum(), size=SHUFFLES)
    found, chance = _by_share(events[None, :], all_of)[0], _by_share(dealt, all_of)
    return Separation(float(np.sqrt(max(0.0, found**2 - (chance**2).mean()))), error, (1 + int((chance >= found - 1e-12).sum())) / (1 + SHUFFLES))


def _by_share(events, all_of):
    """[set] |2 AUC - 1| of classes that are ranked by their share of events."""
    rest = all_of - events
    order = np.argsort(events / all_of, axis=1)
    up, low = np.take_along_axis(events, order, 1), np.take_along_axis(rest, order, 1)
    below = np.cumsum(low, axis=1) - 0.5 * low
    return np.abs(2 * (up * below).sum(axis=1) / (events.sum(axis=1) * rest.sum(axis=1)) - 1)


def beyond_chance(found, tried):
    """Of the largest of several draws chance makes more than of one: with p below LEVEL/tried for each, chance names any of them in at most
    LEVEL of all sweeps (Bonferroni: the sum of the probabilities is never less than that of their union)."""
    return found.size > LEAST and found.p < LEVEL / tried


def seen(error, tried):
    """Would a draw that separates by LEAST be beyond chance?"""
    return LEAST > stats.norm.isf(LEVEL / tried / 2) * error


def parted(larger, smaller):
    """Is one separation larger than another one, beyond the errors of both (two-sided 5 %)? Those are the errors without an effect. An effect
    that moves rare events to one end of a draw makes them smaller, or larger by a sixth at most: the variance of an event's place among
    the others is then 1/9 at most, for 1/12 without effect.
    """
    return larger.size - smaller.size > stats.norm.isf(0.025) * np.hypot(larger.error, smaller.error)
