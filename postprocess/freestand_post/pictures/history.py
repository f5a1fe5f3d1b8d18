"""One response history: floor acceleration, slip and rotation in time, each coloured by the mode of motion."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Patch

from .. import style, words
from ..reading import History
from . import Picture

order = 60
GRAVITY = 9.80665
NAMES = {"rest": "rest", "slide": "slide", "rock": "rock", "slide_rock": "slide-rock", "flight": "flight", "overturned": "overturned"}
ACROSS = " Dashed: the second of the two horizontal directions; the title is of both together."
CAPTION = ("One specimen under one floor motion. The strip and the colour of the lines give the mode of motion: which corners carry, "
           "and whether they stick or slip.")


def pictures(results):
    if isinstance(results, History):
        yield _picture(results)


def _picture(history):
    time, columns = history.columns["time_s"], history.columns
    fig = style.figure(7.4, 5.2)
    strip, floor, slip, turn = fig.subplots(4, 1, sharex=True, gridspec_kw={"height_ratios": [0.22, 1, 1.35, 1.35]})
    end = _end(history)
    runs = _runs(history.mode)
    for start, stop, mode in runs:
        strip.axvspan(time[start], time[min(stop, len(time) - 1)], color=style.MODE.get(mode, style.INK), lw=0)
    strip.set(yticks=[], ylim=(0, 1))
    strip.tick_params(bottom=False)
    for spine in strip.spines.values():
        spine.set_visible(False)
    _line(floor, time, columns["floor_acceleration_mps2"] / GRAVITY, runs, 1.0)
    _line(slip, time, 100 * columns["slip_m"], runs, 2.0)
    both_ways = "cross_slip_m" in columns
    if both_ways:
        _across(floor, time, columns["floor_cross_acceleration_mps2"] / GRAVITY)
        _across(slip, time, 100 * columns["cross_slip_m"])
    _line(turn, time, np.degrees(columns["rotation_rad"]), runs, 2.0)
    for ax, label in ((floor, "floor acc. (g)"), (slip, "slip (cm)"), (turn, "rotation (°)")):
        ax.set_ylabel(label)
        ax.axhline(0, color=style.FAINT, lw=0.8, zorder=0)
    turn.set(xlim=(time[0], end), xlabel="time (s)")
    if "overturned" in history.mode:
        turn.set_ylim(*_clipped(np.degrees(columns["rotation_rad"])))
    _peak(slip, time, 100 * columns["slip_m"], "cm")
    _peak(turn, time, np.degrees(columns["rotation_rad"]), "°")
    fig.align_ylabels([floor, slip, turn])
    present = [mode for mode in NAMES if mode in set(history.mode)]
    strip.legend(handles=[Patch(color=style.MODE[mode], label=NAMES[mode]) for mode in present], ncol=len(present), frameon=False,
                 loc="lower left", bbox_to_anchor=(-0.005, 1.0), borderaxespad=0, handlelength=1.0, handleheight=1.0, fontsize=8.8,
                 columnspacing=1.4, handletextpad=0.5)
    finding = _finding(history)
    style.headline(fig, finding, "Floor acceleration, displacement of the base relative to the floor, and rotation (clockwise positive).")
    return Picture("history", fig, finding, CAPTION + (ACROSS if both_ways else ""), "history")


def _runs(mode):
    """(first, one past last, mode) of every stretch of one mode."""
    change = [0] + [i for i in range(1, len(mode)) if mode[i] != mode[i - 1]] + [len(mode)]
    return [(a, b, mode[a]) for a, b in zip(change, change[1:])]


def _end(history):
    """Where nothing happens any more, and a little."""
    time = history.columns["time_s"]
    alive = np.array([mode not in ("rest", "overturned") for mode in history.mode])
    alive |= np.abs(history.columns["floor_acceleration_mps2"]) > 1e-6 * max(1e-9, np.abs(history.columns["floor_acceleration_mps2"]).max())
    last = np.flatnonzero(alive)
    return min(time[-1], time[last[-1]] + 0.04 * (time[last[-1]] - time[0])) if last.size and last[-1] > 0 else time[-1]


def _line(ax, time, value, runs, width):
    pieces = [np.column_stack([time[a:b + 1], value[a:b + 1]]) for a, b, _ in runs]
    colours = [style.MODE.get(mode, style.INK) for _, _, mode in runs]
    kept = [(piece, colour) for piece, colour in zip(pieces, colours) if len(piece) > 1]
    ax.add_collection(LineCollection([piece for piece, _ in kept], colors=[colour for _, colour in kept], linewidths=width,
                                     capstyle="butt", joinstyle="round"))
    finite = value[np.isfinite(value)]
    low, high = (finite.min(), finite.max()) if finite.size else (-1, 1)
    room = 0.26 * (high - low) or 1.0
    ax.set_ylim(low - room, high + room)


def _across(ax, time, value):
    """The second horizontal direction, beside the first."""
    low, high = ax.get_ylim()
    finite = value[np.isfinite(value)]
    if not finite.size:
        return
    ax.plot(time, value, color=style.INK, lw=0.9, ls=(0, (4, 2)), zorder=1)
    room = 0.15 * (finite.max() - finite.min())
    ax.set_ylim(min(low, finite.min() - room), max(high, finite.max() + room))


def _clipped(degrees):
    """Keeps the swing before the fall readable: nothing beyond 45 degrees on the falling side."""
    low, high = np.nanmin(degrees), np.nanmax(degrees)
    return max(low, -45.0) - 3, min(high, 45.0) + 3


def _peak(ax, time, value, unit):
    if not np.isfinite(value).any() or np.nanmax(np.abs(value)) < 1e-9:
        return
    at = int(np.nanargmax(np.abs(value)))
    low, high = ax.get_ylim()
    if not low <= value[at] <= high:
        return
    ax.plot(time[at], value[at], "o", ms=4, color=style.INK, mec="white", mew=0.6, zorder=5)
    ax.annotate(f"{words.number(value[at], 3)} {unit}".replace(" °", "°"), (time[at], value[at]), xytext=(0, 6 if value[at] > 0 else -6),
                textcoords="offset points", ha="center", va="bottom" if value[at] > 0 else "top", size=8.5, color=style.INK)


def _finding(history):
    summary, slip = history.summary, history.columns["slip_m"]
    peak = 100 * float(summary.get("peak_slip_m", np.nanmax(np.abs(slip))))
    turned = np.degrees(float(summary.get("peak_rotation_rad", np.nanmax(np.abs(history.columns["rotation_rad"])))))
    if summary.get("overturned") or "overturned" in history.mode:
        first = history.mode.index("overturned") if "overturned" in history.mode else -1
        return f"Overturns at {words.number(history.columns['time_s'][first], 3)} s, after slipping {words.number(peak)} cm"
    left = 100 * abs(float(summary.get("residual_slip_m", slip[-1])))
    if abs(slip[0]) > 1e-9:  # it starts off its place: how far from there
        peak, left = (100 * float(value) for value in (np.nanmax(np.abs(slip - slip[0])), abs(slip[-1] - slip[0])))
    if peak < 1e-9 and turned < 1e-9:
        off = f" from where it starts, {words.number(100 * abs(slip[0]))} cm off its place" if abs(slip[0]) > 1e-9 else ""
        return f"The specimen does not move{off}"
    if not {"slide", "slide_rock", "flight"} & set(history.mode):
        return f"Rocks up to {words.number(turned)}° without slipping"
    turn = f", rocks up to {words.number(turned)}°" if turned > 1e-9 else ", does not rock"
    return f"Moves {words.number(peak)} cm{turn} and comes to rest {words.number(left)} cm from where it stood"
