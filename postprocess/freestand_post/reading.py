"""Result folders of freestand as plain values. Whatever cannot be used is one Problem with the file in it."""
import csv
import json
import pathlib
import re
from dataclasses import dataclass, field

import h5py
import numpy as np

from . import buildings, closing, words
from .problem import Problem

OUTCOMES = ("at_rest", "moved", "overturned", "painleve", "step_limit", "not_finite")
# COUNTED: enough samples, too few that moved and stood. UNPROVEN: the lognormal passes its test, and may be off by more than is adequate.
FITTED, TOO_FEW, REJECTED, COUNTED, UNPROVEN = 0, 1, 2, 3, 4
TESTED = (FITTED, REJECTED, UNPROVEN)
PER_BIN = ("n n_still n_over n_moved p_still p_still_lower p_still_upper p_over p_over_lower p_over_upper lambda lambda_se "
           "omega omega_se mean standard_deviation ks_statistic ks_p_textbook ks_critical_textbook ks_p_estimated "
           "ks_critical_estimated ad_statistic ad_p_estimated off_by fdr_rejected status").split()


@dataclass
class Axis:
    name: str
    edge: np.ndarray         # [axis + 1]
    probability: np.ndarray  # [im, axis, capacity]
    lower: np.ndarray
    upper: np.ndarray
    n: np.ndarray            # [im, axis]


@dataclass
class Edp:
    name: str
    unit: str
    symbol: str
    kind: str                # continuous | binary
    bins: dict               # column of PER_BIN -> [im], nan where missing
    capacity: np.ndarray
    surface: dict            # probability, lower, upper, empirical -> [im, capacity]
    ln_edge: np.ndarray      # [cell + 1]
    cells: np.ndarray        # [im, cell]
    axes: list = field(default_factory=list)
    functions: list = field(default_factory=list)  # [capacity] curves over all intensities, as Sweep.overturning

    @property
    def label(self):
        return words.demand(self.name, self.symbol)


@dataclass
class Sweep:
    folder: pathlib.Path
    attributes: dict
    summary: dict
    outcomes: dict           # name -> count
    im: str
    im_unit: str
    edge: np.ndarray
    centre: np.ndarray       # where a bin stands: the mean intensity of its samples, or its middle where it has none
    edps: list
    overturning: dict        # empty where it is not there
    draws: dict              # column -> values; empty without samples.h5
    outcome: np.ndarray      # [sample] int
    motions: list            # names
    is_record: np.ndarray    # [motion] 1: a record, 0: a family of pulses, 2: what a floor of a building does under a record
    is_pair: np.ndarray      # [motion] does it shake the floor in both horizontal directions?
    ground: np.ndarray       # [motion] the record of the ground on which a floor hangs; of any other motion itself
    amplification: dict      # (building, storey) -> {record: peak acceleration of that floor over the ground's}; empty without a building

    @property
    def level(self):
        """"95 %": of every interval and band."""
        return words.level(float(self.attributes.get("confidence", 0.95)))

    @property
    def im_name(self):
        """With its period, as the command line takes it: "sa_g:0.5"."""
        period = self.summary.get("im_period_s")
        return self.im if period is None else f"{self.im}:{period:g}"

    @property
    def im_symbol(self):
        return words.intensity(self.im_name, str(self.attributes.get("im_symbol", "")))

    @property
    def view(self):
        """Range of the intensity axis: all bins, but of a long last or first bin only the part that holds most samples."""
        low, high = self.edge[0], self.edge[-1]
        last, first = self.centre[-1] - self.edge[-2], self.edge[1] - self.centre[0]
        if last < 0.35 * (high - self.edge[-2]):
            high = self.edge[-2] + 1.6 * last
        if first < 0.35 * (self.edge[1] - low):
            low = self.edge[1] - 1.6 * first
        return low, high

    @property
    def samples(self):
        return int(sum(self.outcomes.values()))

    @property
    def kept(self):
        """Samples whose draws are known."""
        return self.outcome.size

    @property
    def model(self):
        found = re.search(r"(?m)^model: *(\w+)", str(self.attributes.get("study", "")))
        return found[1] if found else "slide_rock"

    @property
    def part(self):
        """Which samples those are, where they are not all."""
        if self.kept >= self.samples:
            return ""
        return " before any was passed over" if "samples_alike" in self.attributes else " kept"

    def continuous(self):
        return [edp for edp in self.edps if edp.kind != "binary" and edp.capacity.size]

    def happenings(self):
        """Demands that happen or not, but for overturning, which has a picture of its own."""
        return [edp for edp in self.edps if edp.kind == "binary" and edp.name != "overturned" and edp.surface]


@dataclass
class History:
    folder: pathlib.Path
    columns: dict            # column -> values
    mode: list
    summary: dict


def is_sweep(folder):
    return (folder / "fragility.h5").exists()


def is_history(folder):
    return (folder / "history.csv").exists()


def existing_folder(path):
    folder = pathlib.Path(path)
    if not folder.is_dir():
        raise Problem(f"{folder} is not a folder: give the folder that freestand wrote with -o")
    return folder


def _open(path, form):
    try:
        closing.refuse_damaged(path, "make it again")
        root = h5py.File(path, "r")
    except OSError as why:
        raise Problem(f"{path} cannot be read as HDF5 ({_first_line(why)}): it is truncated, still being written or no "
                      "result of freestand; run the study again") from None
    found = _text(root.attrs.get("format", ""))
    if found != form:
        root.close()
        raise Problem(f'{path} says format "{found}", not "{form}": it is another file, or of another version of freestand')
    return root


def _first_line(why):
    return str(why).strip().splitlines()[0][:160]


def _text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _attribute(value):
    if isinstance(value, np.ndarray):
        return [_attribute(item) for item in value.tolist()] if value.ndim else _attribute(value.item())
    if isinstance(value, (bytes, np.bytes_)):
        return _text(value)
    return value.item() if isinstance(value, np.generic) else value


def _numbers(group, name, shape=None):
    try:
        values = np.asarray(group[name][()], dtype=float)
    except KeyError:
        raise Problem(f"{group.file.filename} has no {group.name.rstrip('/')}/{name}: it was written by another version of "
                      "freestand or is incomplete; run `freestand fit` again") from None
    except OSError as why:
        raise Problem(f"{group.file.filename}: {group.name}/{name} cannot be read ({_first_line(why)}): the file is damaged; "
                      "run `freestand fit` again") from None
    if shape is not None and values.shape != shape:
        raise Problem(f"{group.file.filename}: {group.name}/{name} has shape {values.shape}, expected {shape}: the file is "
                      "damaged; run `freestand fit` again")
    return values


def _edp(group, name, n_im):
    kind = _text(group.attrs.get("kind", "continuous"))
    bins = {column: _numbers(group, column, (n_im,)) if column in group else np.full(n_im, np.nan) for column in PER_BIN}
    capacity = _numbers(group, "capacity") if "capacity" in group else np.zeros(0)
    shape = (n_im, capacity.size)
    surface = {}
    if capacity.size and "surface" in group:
        surface = {key: _numbers(group["surface"], key, shape) for key in ("probability", "lower", "upper", "empirical")}
    elif kind != "binary":
        capacity = np.zeros(0)
    ln_edge, cells = np.zeros(0), np.zeros((n_im, 0))
    if "distribution" in group:
        ln_edge = _numbers(group["distribution"], "ln_edge")
        cells = _numbers(group["distribution"], "count", (n_im, max(ln_edge.size - 1, 0)))
    edp = Edp(name, _text(group.attrs.get("unit", "1")), _text(group.attrs.get("symbol", "")), kind, bins, capacity, surface,
              ln_edge, cells, functions=_functions(group, capacity.size))
    for axis_name, axis in (group["axis"].items() if "axis" in group and capacity.size else ()):
        edge = _numbers(axis, "edge")
        cube = (n_im, edge.size - 1, capacity.size)
        edp.axes.append(Axis(axis_name, edge, _numbers(axis, "probability", cube), _numbers(axis, "lower", cube),
                             _numbers(axis, "upper", cube), _numbers(axis, "n", cube[:2])))
    return edp


CURVE = ("probability", "lower", "upper")
CURVE_NUMBERS = ("median", "dispersion", "median_se", "dispersion_se", "misfit", "misfit_im", "misfit_p")
CURVE_FLAGS = ("penalised", "extrapolated", "adequate")
RESAMPLED = ("resampled_median", "resampled_dispersion")


def _functions(group, capacities):
    """A curve over all intensities for each capacity."""
    if "functions" not in group or not capacities:
        return []
    group = group["functions"]
    table = {key: _numbers(group, key) for key in ("grid",) + CURVE + CURVE_NUMBERS + CURVE_FLAGS + RESAMPLED}
    return [{key: values if key == "grid" else bool(values[i]) if key in CURVE_FLAGS else values[i] for key, values in table.items()}
            for i in range(capacities)]


def _overturning(root):
    if "overturning" not in root:
        return {}
    group = root["overturning"]
    result = {key: _numbers(group, key) for key in ("grid",) + CURVE}
    result.update({key: _numbers(group, key) if key in group else np.zeros(0) for key in RESAMPLED})
    result.update({key: float(group.attrs.get(key, np.nan)) for key in CURVE_NUMBERS})
    result.update({key: bool(group.attrs.get(key, 0)) for key in CURVE_FLAGS})
    return result


def _add_counted(centre, edps, overturning):
    """To each curve the share counted in each bin, which holds where the curve is not adequate."""
    for edp in edps:
        for curve, counted in zip(edp.functions, edp.surface["empirical"].T if edp.surface else []):
            curve.update(im=centre, counted=counted)
    if overturning and edps:
        overturning.update(im=centre, counted=next((edp for edp in edps if edp.name == "overturned"), edps[0]).bins["p_over"])


def _json(path):
    if not path.exists():
        return {}
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, UnicodeDecodeError) as why:
        raise Problem(f"{path} is not readable as JSON ({_first_line(why)}): run the study again") from None
    if not isinstance(value, dict):
        raise Problem(f"{path} holds no object: it is no summary of freestand")
    return value


def _samples(path):
    """Draws, outcomes, and of motions the names, which are records, which are pairs, on which they hang, and what floors do; empty without
    samples.h5."""
    if not path.exists():
        return {}, np.zeros(0, int), [], np.zeros(0, int), np.zeros(0, bool), np.zeros(0, int), {}
    with _open(path, "freestand-samples/2") as root:
        if "samples" not in root or "outcome" not in root["samples"]:
            raise Problem(f"{path} has no /samples/outcome: it is incomplete; finish it with `freestand sweep --resume`")
        group = root["samples"]
        draws = {}
        for name in group:
            skip = name in ("sample", "outcome", "impacts", "events") or name.startswith(("im_", "edp_"))
            if not skip and np.issubdtype(group[name].dtype, np.number):
                draws[name] = _numbers(group, name)
        outcome = _numbers(group, "outcome").astype(int)
        alike = int(root.attrs.get("samples_alike", outcome.size))  # of later ones only those of some intensities were integrated
        motions = [_text(item) for item in root["motions/name"][()]] if "motions/name" in root else []
        group = _numbers(root["motions"], "group") if "motions/group" in root else np.zeros(0)  # -1: pulses
        is_record = (group >= 0).astype(int)
        is_pair = _numbers(root["motions"], "cross") > 0 if "motions/cross" in root else np.zeros(len(motions), bool)
        ground, amplification = np.arange(len(motions)), {}
        if "ground" in root.get("motions", {}):
            ground, storey, peak = (_numbers(root["motions"], name) for name in ("ground", "storey", "pga_mps2"))
            ground = ground.astype(int)
            is_record[ground != np.arange(len(motions))] = 2
            amplification = buildings.amplification(motions, ground, storey, peak)
        if "storey" in draws and "motion" in draws:  # the file says 0 of what stands in no building
            draws["storey"][~buildings.stand_in_one(ground)[draws["motion"].astype(int)]] = np.nan
    return ({name: values[:alike] for name, values in draws.items() if values.shape == outcome.shape}, outcome[:alike], motions, is_record,
            is_pair, ground, amplification)


def read_sweep(folder):
    try:
        return _read_sweep(folder)
    except (OSError, RuntimeError, KeyError) as why:  # what h5py raises when a file breaks off in the middle
        raise Problem(f"{folder}: a result file is damaged ({_first_line(why)}): run the study again") from None


def _read_sweep(folder):
    folder = existing_folder(folder)
    path = folder / "fragility.h5"
    if not path.exists():
        hint = ("run `freestand fit` on it first" if (folder / "samples.h5").exists() else
                "the run there was stopped, or is at work: let it end first" if (folder / "freestand.begun").exists() else
                "give the folder of `freestand run`, `compare` or `diagnose`")
        raise Problem(f"{folder} has no fragility.h5: {hint}")
    summary = _json(folder / "summary.json")
    with _open(path, "freestand-fragility/1") as root:
        attributes = {key: _attribute(value) for key, value in root.attrs.items()}
        for group in ("im", "edp"):
            if group not in root:
                raise Problem(f"{path} has no /{group}: it is incomplete; run `freestand fit` again")
        edge = _numbers(root["im"], "edge")
        if edge.size < 2 or not np.all(np.diff(edge) > 0):
            raise Problem(f"{path}: /im/edge does not increase: the file is damaged; run `freestand fit` again")
        centre = _numbers(root["im"], "centre", (edge.size - 1,))
        edps = [_edp(root["edp"][name], name, edge.size - 1) for name in root["edp"]]
        overturning = _overturning(root)
    _add_counted(centre, edps, overturning)
    names = attributes.get("outcome_names", OUTCOMES)
    names = names.split() if isinstance(names, str) else names
    outcomes = dict(zip(names, np.atleast_1d(attributes.get("outcome_counts", [])).astype(int).tolist()))
    draws, outcome, motions, is_record, is_pair, ground, amplification = _samples(folder / summary.get("samples_in", "") / "samples.h5")
    return Sweep(folder, attributes, summary, outcomes or summary.get("outcomes", {}), str(attributes.get("im", "im")),
                 str(attributes.get("im_unit", "1")), edge, centre, _in_order(edps, summary), overturning, draws, outcome, motions,
                 is_record, is_pair, ground, amplification)


def _in_order(edps, summary):
    """As the study names them (HDF5 sorts by letter)."""
    wanted = list(summary.get("edps", {}))
    return sorted(edps, key=lambda edp: (wanted.index(edp.name) if edp.name in wanted else len(wanted), edp.name))


HISTORY_COLUMNS = ("time_s", "floor_acceleration_mps2", "slip_m", "slip_velocity_mps", "rotation_rad", "rotation_rate_radps")
ACROSS_COLUMNS = ("cross_slip_m", "floor_cross_acceleration_mps2")  # where the floor moves in both horizontal directions


def read_history(folder):
    folder = existing_folder(folder)
    path = folder / "history.csv"
    if not path.exists():
        raise Problem(f"{folder} has no history.csv: give the folder of `freestand simulate`")
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except UnicodeDecodeError:
        raise Problem(f"{path} is not a text file: give the folder of `freestand simulate`") from None
    if not rows or not set(HISTORY_COLUMNS + ("mode",)) <= set(rows[0]):
        raise Problem(f"{path}:1 lacks the columns {', '.join(HISTORY_COLUMNS)}, mode: it is no history of freestand")
    header, body = rows[0], [row for row in rows[1:] if row]
    for line, row in enumerate(body, start=2):
        if len(row) != len(header):
            raise Problem(f"{path}:{line} has {len(row)} fields, not {len(header)}: the file is truncated; simulate again")
    columns = {}
    for name in HISTORY_COLUMNS + tuple(name for name in ACROSS_COLUMNS if name in header):
        at = header.index(name)
        try:
            columns[name] = np.array([float(row[at]) for row in body])
        except ValueError as why:
            raise Problem(f"{path}: column {name} holds something that is no number ({_first_line(why)}): simulate again") from None
    if len(body) < 2:
        raise Problem(f"{path} holds fewer than two points: simulate again")
    return History(folder, columns, [row[header.index("mode")] for row in body], _json(folder / "summary.json"))
