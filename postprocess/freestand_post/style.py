"""The look of every picture: colours, type, and the few helpers that keep labels apart."""
import io
import logging
import math
import re
import warnings

# What matplotlib says of its list of fonts on a machine's first day is nothing to a user of these programs.
logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)

import matplotlib
import numpy as np
from matplotlib import font_manager, patheffects, ticker, transforms
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

INK, MUTED, FAINT, PAPER = "#1d2430", "#626b78", "#dfe3e8", "#ffffff"
BLUE, VERMILION, ORANGE, GREEN, PURPLE, SKY = "#0072b2", "#d55e00", "#e69f00", "#009e73", "#a65298", "#56b4e9"
GREY = "#8d95a1"
OUTCOME = {"at_rest": GREY, "moved": BLUE, "overturned": VERMILION, "painleve": PURPLE, "step_limit": INK, "not_finite": INK}
MODE = {"rest": "#c3c8cf", "slide": BLUE, "rock": ORANGE, "slide_rock": GREEN, "flight": PURPLE, "overturned": VERMILION}
FAIL = VERMILION
PROBABILITY = LinearSegmentedColormap.from_list(
    "probability", ["#f7f9fb", "#d5e3ef", "#9fc3dd", "#5a9bc6", "#22709f", "#0d4671", "#07233f"])
EMPTY = "#eceef1"
DPI = 200         # of the png files
RASTER_DPI = 150  # of the parts of a svg that are pixels
_SERIES = ["#6fb1d8", "#2f86bd", "#125a8c", "#07304f"]


def fonts():
    """Inter where it is installed, DejaVu Sans (it comes with matplotlib) for the rest."""
    here = {entry.name for entry in font_manager.fontManager.ttflist}
    return [name for name in ("Inter", "DejaVu Sans") if name in here]


def apply():
    matplotlib.rcParams.update({
        "font.family": fonts(), "font.size": 9, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": MUTED,
        "axes.linewidth": 0.7, "axes.spines.top": False, "axes.spines.right": False, "axes.labelsize": 9.5,
        "axes.titlesize": 9, "axes.titlelocation": "left", "xtick.color": MUTED, "ytick.color": MUTED,
        "xtick.labelcolor": INK, "ytick.labelcolor": INK, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5,
        "xtick.major.width": 0.7, "ytick.major.width": 0.7, "xtick.major.size": 3, "ytick.major.size": 3,
        "xtick.minor.size": 1.5, "ytick.minor.size": 1.5, "lines.linewidth": 1.8, "lines.solid_capstyle": "round",
        "figure.facecolor": PAPER, "savefig.facecolor": PAPER, "svg.fonttype": "path", "svg.hashsalt": "freestand",
        "axes.unicode_minus": True, "axes.axisbelow": True, "hatch.linewidth": 0.6})


def series(count):
    """Shades of one hue, light to dark, for an ordered family of curves."""
    if count <= 1:
        return [_SERIES[2]]
    positions = [i * (len(_SERIES) - 1) / (count - 1) for i in range(count)]
    ramp = LinearSegmentedColormap.from_list("series", _SERIES)
    return [ramp(position / (len(_SERIES) - 1)) for position in positions]


def figure(width=7.4, height=4.4):
    made = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(made)
    return made


def _wrapped(fig, text, size, weight, limit):
    """Lines of text no wider than `limit` inches."""
    renderer = fig.canvas.get_renderer()
    probe = fig.text(0, 0, "", size=size, weight=weight)
    lines, line = [], ""
    for word in text.split(" "):
        trial = f"{line} {word}".strip()
        probe.set_text(trial)
        if line and probe.get_window_extent(renderer).width / fig.dpi > limit:
            lines.append(line)
            trial = word
        line = trial
    probe.remove()
    return lines + [line]


def headline(fig, title, subtitle=""):
    """The finding in bold over the picture, how to read it underneath; makes room for both."""
    width, height = fig.get_size_inches()
    margin, y = 0.12, height - 0.1
    shown = []
    for text, size, weight, colour, step in ((title, 12, "bold", INK, 0.215), (subtitle, 8.6, "normal", MUTED, 0.165)):
        if not text:
            continue
        for line in _wrapped(fig, text, size, weight, width - 2 * margin):
            shown.append(fig.text(margin / width, y / height, line, size=size, weight=weight, color=colour, va="top"))
            y -= step
        y -= 0.03
    fig.get_layout_engine().set(rect=(0.005, 0, 0.99, (y - 0.05) / height), w_pad=0.08, h_pad=0.06)
    fig.headline = (title, subtitle, shown, y - 0.05)


def take_headline(fig):
    """(title, subtitle) out of a figure, which shrinks by as much: a page sets them as its own text."""
    title, subtitle, shown, height = getattr(fig, "headline", ("", "", [], fig.get_size_inches()[1]))
    for text in shown:
        text.remove()
    whole = height + 0.1
    fig.set_size_inches(fig.get_size_inches()[0], whole)
    fig.get_layout_engine().set(rect=(0.005, 0, 0.99, height / whole))
    fig.headline = ("", "", [], height)
    return title, subtitle


def spread(positions, gap, high=float("inf"), low=-float("inf")):
    """Positions moved apart so that neighbours are at least `gap` away, within low and high, order kept (of equal ones the
    first is highest), as near as can be."""
    order = sorted(range(len(positions)), key=lambda i: (positions[i], -i))
    place = {i: k for k, i in enumerate(order)}
    positions = [max(low + gap * place[i], min(high - gap * (len(order) - 1 - place[i]), y)) for i, y in enumerate(positions)]
    blocks = []  # [sum of wanted starts, members]
    for i in order:
        blocks.append([positions[i], [i]])
        while len(blocks) > 1:
            (low_sum, low), (high_sum, high) = blocks[-2], blocks[-1]
            if low_sum / len(low) + gap * len(low) <= high_sum / len(high) + 1e-12:
                break
            blocks[-2:] = [[low_sum + high_sum - gap * len(low) * len(high), low + high]]
    result = [0.0] * len(positions)
    for total, members in blocks:
        for k, i in enumerate(members):
            result[i] = total / len(members) + k * gap
    return result


def end_labels(ax, entries, x, gap, reach, high=1.0):
    """Direct labels at the right end of curves. entries: (y, text, colour); x, gap, reach and high in data units."""
    for (y, text, colour), at in zip(entries, spread([entry[0] for entry in entries], gap, high, 0.3 * gap)):
        ax.plot([x, x + 0.8 * reach], [y, at], color=colour, lw=0.7, clip_on=False, alpha=0.7)
        ax.text(x + reach, at, text, color=colour, weight="bold", size=9, va="center", clip_on=False)


def halo():
    """Keeps text readable over lines."""
    return [patheffects.withStroke(linewidth=2.5, foreground=PAPER)]


def grid(ax, axis="y"):
    ax.grid(axis=axis, color=FAINT, lw=0.6)


def svg(fig):
    """The picture as svg text, without prologue, all ids its own."""
    buffer = io.StringIO()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        fig.savefig(buffer, format="svg", dpi=RASTER_DPI, metadata={"Date": None, "Creator": None})
    return _clips_by_number(buffer.getvalue())


def _clips_by_number(text):
    """Matplotlib names some clip paths after addresses in memory: the same picture would be another file each time."""
    for number, name in enumerate(re.findall(r'<clipPath id="([^"]+)"', text)):
        text = text.replace(f'"{name}"', f'"clip{number}"').replace(f"#{name})", f"#clip{number})")
    return text


def inline_svg(text, prefix, label):
    """Svg text ready to stand inside a page: ids prefixed, sized by the page, named for screen readers."""
    body = text[text.index("<svg"):]
    body = re.sub(r"<metadata>.*?</metadata>", "", body, flags=re.S)
    body = re.sub(r'\bid="([^"]+)"', rf'id="{prefix}-\1"', body)
    body = re.sub(r'href="#([^"]+)"', rf'href="#{prefix}-\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{prefix}-\1)", body)
    body = re.sub(r'<svg([^>]*?) width="[^"]*"', r"<svg\1", body, count=1)
    body = re.sub(r'<svg([^>]*?) height="[^"]*"', r"<svg\1", body, count=1)
    safe = label.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
    return body.replace("<svg", f'<svg role="img" aria-label="{safe}"', 1)


def plain_log(axis, crowd=1):
    """A logarithmic axis with ordinary numbers, as many as have room; crowd: how many times smaller than usual it is."""
    low, high = axis.get_view_interval()
    fullness = crowd * abs(math.log10(high / low))
    subs = (1, 2, 5) if fullness < 2.6 else (1, 3) if fullness < 5.5 else (1,)
    axis.set_major_locator(ticker.LogLocator(base=10, subs=subs, numticks=20 if len(subs) > 1 else max(3, round(8 / crowd))))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(ticker.NullLocator())


def legend_above(axes, **options):
    """A legend over the first of a row of axes, above its title, that may be wider than it; blank lines over the title of the
    last one, as many as the legend has rows, keep its room."""
    first, last = axes[0], axes[-1]
    titled = bool(first.get_title(loc="left"))
    rows = math.ceil(len(first.get_legend_handles_labels()[1]) / options.get("ncol", 1))
    above = transforms.ScaledTranslation(0, (18 if titled else 4) / 72, first.figure.dpi_scale_trans)
    made = first.legend(frameon=False, loc="lower left", borderaxespad=0, fontsize=8.8, handlelength=1.4, columnspacing=1.4,
                        handletextpad=0.5, labelspacing=0.2, bbox_to_anchor=(-0.005, 1.0), bbox_transform=first.transAxes + above, **options)
    if last is not first:
        last.set_title("\u00a0\n" * (rows if titled else rows - 1) + (last.get_title(loc="left") or "\u00a0"), weight="bold", pad=5)
        made.set_in_layout(False)


def error_scale(ax, which, values):
    """An axis of errors: logarithmic where they span more than a factor of three, else so wide that small differences look small."""
    values = np.asarray(values, float)
    values = values[np.isfinite(values)]
    axis, limits = getattr(ax, f"{which}axis"), getattr(ax, f"set_{which}lim")
    if not values.size:
        return
    low, high = values.min(), values.max()
    if low > 0 and high / low > 3:
        getattr(ax, f"set_{which}scale")("log")
        limits(low / 1.35, high * 1.35)
        plain_log(axis)
    else:
        room = max(0.12 * (high - low), 0.2 * abs(high) - 0.5 * (high - low)) or 1.0
        limits(max(low - room, 0.0) if low >= 0 else low - room, high + room)


def spread_on(ax, values, share):
    """Heights in data units at which labels of these values keep apart by a share of the axis, linear or logarithmic."""
    low, high = (math.log(limit) if ax.get_yscale() == "log" else limit for limit in ax.get_ylim())
    height = [((math.log(value) if ax.get_yscale() == "log" else value) - low) / (high - low) for value in values]
    placed = [low + at * (high - low) for at in spread(height, share, 1.0, 0.05)]
    return [math.exp(at) for at in placed] if ax.get_yscale() == "log" else placed
