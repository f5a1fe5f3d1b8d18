"""The worst histories of a comparison: floor acceleration, measured against model, and the residual in units of the noise."""
import re

import numpy as np

from .. import style, validation, words
from ..validation import Validation
from . import Picture

order = 130
GRAVITY = 9.80665
SHOWN = 6
MEASURED = "#aab2bd"
SCALE = {"slip_m": (100, "slip (cm)"), "rotation_rad": (180 / np.pi, "rotation (°)"),
         "block_acceleration_mps2": (1 / GRAVITY, "block acc. (g)")}
CAPTION = ("Grey: measured; lines: model, shaded where 90 of 100 readings of another such test are predicted. Under each: model minus measured in units of the sensor's noise; light band: two standard "
           "deviations of what sensor and floor noise alone would make. Each axis shows its own range.")


def pictures(results):
    """Those of the first comparison first, since there the most is missed; the last model's line in the same picture."""
    if not isinstance(results, Validation):
        return
    seen = {}
    for k, comparison in enumerate(results.comparisons):
        for history in comparison.histories:
            if history.time.size > 1 and history.channels:
                seen.setdefault(history.id, []).append((k, history))
    ranked = sorted(seen.values(), key=lambda found: (found[0][0], -_error(results, *found[0])))
    ranked = [found for found in ranked if found[0][0] == 0 or _missed(results, *found[0])]
    for found in ranked[:SHOWN]:
        yield _picture(results, [found[0], found[-1]] if len(found) > 1 else found)


def _error(results, k, history):
    return next((test["error_noise_units"] for test in results.comparisons[k].tests if test["id"] == history.id), 0.0)


def _missed(results, k, history):
    """Whether a later model misses a test, that the first did better, by more than noise."""
    test = next((test for test in results.comparisons[k].tests if test["id"] == history.id), None)
    return test is None or not test["error_floor_noise_allowed"] < 1.5 * test["error_expected"]


def _picture(results, found):
    first = found[0][1]
    n = len(first.channels)
    fig = style.figure(7.4, 1.9 + 2.25 * n)
    axes = fig.subplots(1 + 2 * n, 1, sharex=True, gridspec_kw={"height_ratios": [0.55] + [1.6, 0.95] * n})
    axes[0].plot(first.time, first.floor / GRAVITY, color=style.MUTED, lw=0.7)
    axes[0].set_ylabel("floor (g)")
    lines = [(results.labels[k], results.colours[k], history) for k, history in found]
    for i, channel in enumerate(first.channels):
        _motion(axes[1 + 2 * i], first, channel, lines)
        _residual(axes[2 + 2 * i], channel, lines)
    for ax in axes:
        ax.axhline(0, color=style.FAINT, lw=0.8, zorder=0)
    axes[-1].set(xlim=(first.time[0], first.time[-1]), xlabel="time (s)")
    fig.align_ylabels(axes)
    handles = axes[1].get_legend_handles_labels()
    axes[0].legend(*handles, ncol=3, frameon=False, loc="lower left", bbox_to_anchor=(-0.005, 1.0), borderaxespad=0,
                   fontsize=8.8, handlelength=1.4, columnspacing=1.4, handletextpad=0.5)
    finding = _finding(results, found)
    style.headline(fig, finding, "Top: floor acceleration. Below: measured and computed motion (shaded: where 90 of 100 readings are predicted), and the residual.")
    return Picture(f"worst_{re.sub(r'[^A-Za-z0-9]+', '_', first.id)}", fig, finding, CAPTION, "worst")


def _motion(ax, first, channel, lines):
    factor, axis = SCALE[channel.name]
    ax.plot(first.time, factor * channel.measured, color=MEASURED, lw=4.0, label="measured", solid_capstyle="butt")
    for name, colour, history in lines:
        other = _channel(history, channel.name)
        if other:
            if other.band:
                ax.fill_between(history.time, factor * other.band[0], factor * other.band[1], color=colour, alpha=0.16, lw=0)
            label = "model" if len(lines) == 1 and name == "base" else f"model, {name}"
            ax.plot(history.time, factor * other.model, color=colour, lw=1.3, label=label)
    ax.set_ylabel(axis)
    ax.margins(y=0.12)


def _residual(ax, channel, lines):
    noise = channel.noise if channel.noise > 0 else 1.0
    low, high = -3.0, 3.0
    for k, (_, colour, history) in enumerate(lines):
        other = _channel(history, channel.name)
        if not other:
            continue
        if k == 0:
            allowed = 2 * np.sqrt(1 + np.nan_to_num(other.spread / noise) ** 2)
            ax.fill_between(history.time, -allowed, allowed, color=style.FAINT, lw=0, zorder=0)
        ax.plot(history.time, other.residual / noise, color=colour, lw=0.9)
        finite = other.residual[np.isfinite(other.residual)] / noise
        low, high = min(low, 1.15 * finite.min(initial=low)), max(high, 1.15 * finite.max(initial=high))
    ax.set(ylim=(low, high), ylabel="residual\n(noise units)")


def _channel(history, name):
    return next((channel for channel in history.channels if channel.name == name), None)


def _finding(results, found):
    if len(found) == 1 and found[0][0] == 0 and len(results.comparisons) > 1:
        found = [found[0], (len(results.comparisons) - 1, found[0][1])]  # whose error is known, though not its history
    tests = [next((test for test in results.comparisons[k].tests if test["id"] == history.id), {}) for k, history in found]
    error = [test.get("error_noise_units", np.nan) for test in tests]
    name, role = found[0][1].id, {"holdout": " (held out)"}.get(found[0][1].role, "")
    if len(found) > 1:
        return (f"Test {name}{role}: {validation.error(error[0])} noise units {validation.by(results.labels[found[0][0]])}, "
                f"{validation.error(error[1])} {validation.by(results.labels[found[1][0]])}")
    relative = tests[0].get("error_relative", np.nan)
    share = (f", {words.number(relative)} times the measured peak" if relative > 2 else
             f", {words.percent(relative)} of the measured peak" if np.isfinite(relative) else "")
    by = "" if len(results.comparisons) == 1 else f" {validation.by(results.labels[found[0][0]])}"
    far = _missed(results, *found[0])
    return f"Test {name}{role}{' is missed by' if far else ':'} {validation.error(error[0])} noise units{by}{share}"
