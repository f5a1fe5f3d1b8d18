"""comparison.json and diagnosis.json as plain values; null is nan. Whatever cannot be used is one Problem with the file in it."""
import json
import pathlib
from dataclasses import dataclass, field

import numpy as np

from .problem import Problem

COMPARISON, DIAGNOSIS = "comparison.json", "diagnosis.json"
CHANNELS = ("slip_m", "rotation_rad", "block_acceleration_mps2")


@dataclass
class Channel:
    name: str
    noise: float             # standard deviation of the sensor
    measured: np.ndarray
    model: np.ndarray
    residual: np.ndarray
    spread: np.ndarray       # standard deviation that the floor's noise makes
    band: tuple              # lower, upper: where 90 of 100 readings are predicted; empty: not known


@dataclass
class MeasuredHistory:
    id: str
    role: str
    time: np.ndarray
    floor: np.ndarray        # m/s²
    channels: list


@dataclass
class Table:
    """Something against a variable, by bins: of the error, or of the recovered friction."""
    variable: str
    unit: str
    label: list              # names of the bins, where they have names
    edge: np.ndarray
    centre: np.ndarray
    count: np.ndarray
    columns: dict            # name -> values
    share_explained: float = np.nan
    share_of_force_explained: float = np.nan
    share_by_chance: float = 0
    share_of_force_by_chance: float = 0
    law_effects: list = field(default_factory=list)
    law_follows: bool = False  # the law changes with this variable


@dataclass
class Comparison:
    folder: pathlib.Path
    raw: dict
    name: str
    effects: list
    unit: str                # noise units | ln ratio | Brier
    findings: list
    tests: list              # of dict
    calibration: dict        # error, error_expected, tests ...; empty without such tests
    holdout: dict
    parameters: list         # of dict
    peak_ratio: dict
    histories: list
    tables: dict             # calibration, holdout -> [Table]
    ladder: list             # of dict
    draws: dict              # name -> values, row by row; empty: none
    friction_scatter: float  # standard deviation of ln(friction) from test to test


@dataclass
class Diagnosis:
    folder: pathlib.Path
    raw: dict
    name: str
    verdict: str
    reason: str              # of the verdict unknown: data, none_helps, none_suffices, one_law; else empty
    effects: list
    unit: str
    sentences: list
    findings: list
    base: dict
    candidates: list         # of dict: the best, its rivals, the others by their errors
    noise_floor: float
    base_mu: float
    recovered: list          # of Table
    suggestion: dict         # empty where nothing is suggested
    chances: list            # of dict: question, about, p, simulations, told_apart (of leads; nan: not asked)
    proposal: dict           # a law of no catalogue, after the verdict unknown; empty: none

    @property
    def best(self):
        """The candidate that the verdict speaks of; empty where there is none."""
        return next((row for row in self.candidates if row["effect"] == self.raw.get("best")), {})


class _Node:
    """One object of a file; every access that finds something else than it should is a Problem that names the key."""

    def __init__(self, path, value, where=""):
        self.path, self.value, self.where = path, value, where
        if not isinstance(value, dict):
            self.wrong("", "an object")

    def wrong(self, key, wanted):
        place = f"{self.where}{key}".rstrip(".") or "the whole"
        raise Problem(f"{self.path}: {place} is not {wanted}: the file is damaged or of another version of freestand; run "
                      f"`freestand {'diagnose' if self.path.name == DIAGNOSIS else 'compare'}` again")

    def number(self, key, default=np.nan):
        value = self.value.get(key)
        if value is None:
            return default
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            self.wrong(key, "a number")
        return float(value)

    def text(self, key, default=""):
        value = self.value.get(key)
        if value is None:
            return default
        return value if isinstance(value, str) else self.wrong(key, "a text")

    def items(self, key, needed=False):
        value = self.value.get(key)
        if value is None and not needed:
            return []
        return value if isinstance(value, list) else self.wrong(key, "a list")

    def texts(self, key):
        return [item if isinstance(item, str) else self.wrong(key, "a list of texts") for item in self.items(key)]

    def numbers(self, key, size=None):
        try:
            values = np.array([np.nan if item is None else item for item in self.items(key)], dtype=float)
        except (TypeError, ValueError):
            self.wrong(key, "a list of numbers")
        if values.ndim != 1 or (size is not None and values.size not in (0, size)):
            self.wrong(key, f"a list of {size} numbers")
        return values if values.size or not size else np.full(size, np.nan)

    def node(self, key):
        """None where the key is null or missing."""
        value = self.value.get(key)
        return None if value is None else _Node(self.path, value, f"{self.where}{key}.")

    def nodes(self, key, needed=False):
        return [_Node(self.path, item, f"{self.where}{key}[{i}].") for i, item in enumerate(self.items(key, needed))]

    def row(self, numbers="", texts="", flags=""):
        row = {key: self.number(key) for key in numbers.split()}
        row.update({key: self.text(key) for key in texts.split()})
        row.update({key: self.value.get(key) is True for key in flags.split()})
        return row

    def interval(self, key):
        pair = self.numbers(key)
        return (float(pair[0]), float(pair[1])) if pair.size == 2 else (np.nan, np.nan)


def _root(folder, name, form):
    path = pathlib.Path(folder) / name
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as why:
        raise Problem(f"{path} is not readable as JSON ({str(why).splitlines()[0][:120]}): it is truncated or still being written; "
                      f"run `freestand {'compare' if name == COMPARISON else 'diagnose'}` again") from None
    root = _Node(path, value)
    if root.value.get("format") != form:
        raise Problem(f'{path} says format "{root.value.get("format", "")}", not "{form}": it is another file, or of another '
                      "version of freestand")
    return root


def _table(node, columns):
    label = node.texts("label")
    size = len(label) or len(node.items("centre"))
    table = Table(node.text("variable"), node.text("unit", "1"), label, node.numbers("edge"), node.numbers("centre", size),
                  node.numbers("count", size), {key: node.numbers(key, size) for key in columns.split()},
                  node.number("share_explained"), node.number("share_of_force_explained"),
                  np.nan_to_num(node.number("share_by_chance")), np.nan_to_num(node.number("share_of_force_by_chance")))
    law = node.node("law")
    if law:
        table.columns["law"] = law.numbers("mu", size)
        table.columns["law_force_mps2"] = law.numbers("force_mps2", size)
        table.law_effects = law.texts("effects")
        table.law_follows = law.value.get("follows") is True
    return table


def _history(node):
    time = node.numbers("time_s")
    channels = []
    for name in CHANNELS:
        found = node.node(name)
        if found:
            band = found.node("band")
            channels.append(Channel(name, found.number("noise"), *(found.numbers(key, time.size) for key in
                                                                   ("measured", "model", "residual", "spread")),
                                    tuple(band.numbers(end, time.size) for end in ("lower", "upper")) if band else ()))
    return MeasuredHistory(node.text("id"), node.text("role"), time, node.numbers("floor_acceleration_mps2", time.size), channels)


def _test(node):
    row = node.row("error_noise_units error_relative error_floor_noise_allowed error_expected error_of_mean score overturned_probability floor_peak_g "
                   "own_friction",
                   "id role kind outcome source")
    row["overturned_measured"] = node.value.get("overturned_measured")
    row["peaks"] = {peak.text("name"): (peak.number("measured"), peak.number("model")) for peak in node.nodes("peaks")
                    if peak.value.get("compared", True)}
    return row


def _role(node):
    return node.row("error_noise_units error_relative error error_expected error_floor_noise_allowed tests") if node else {}


def _ladder(root):
    return [node.row("error_calibration error_holdout noise_floor noise_floor_holdout explained_calibration explained_holdout", "step") for node in root.nodes("ladder")]


def read_comparison(folder):
    root = _root(folder, COMPARISON, "freestand-comparison/2")
    tests = [_test(node) for node in root.nodes("tests", needed=True)]
    parameters = []
    for node in root.nodes("parameters"):
        parameters.append(node.row("value lower upper", "name unit open", "calibrated") | {
            "interval": node.interval("interval"), "interval_90": node.interval("interval_90")})
    ratio, tables = root.node("peak_ratio"), root.node("error_tables")
    columns = "error_noise_units growth_noise_units growth_slip_m growth_rotation_rad bias_noise_units"
    return Comparison(
        pathlib.Path(folder), root.value, _name(root, folder), root.texts("effects"), root.text("error_unit", "noise units"),
        root.texts("findings"), tests, _role(root.node("calibration")), _role(root.node("holdout")), parameters,
        ratio.row("count ratio bias_ln scatter_ln within_ln", "", "biased") if ratio else {}, [_history(node) for node in root.nodes("histories")],
        {role: [_table(node, columns) for node in tables.nodes(role)] if tables else [] for role in ("calibration", "holdout")},
        _ladder(root), _draws(root, folder), _scatter(root.node("posterior")))


def _scatter(posterior):
    return posterior.number("friction_scatter") if posterior else 0.0


def _draws(root, folder):
    """The table of joint draws beside the comparison, where it is there."""
    posterior = root.node("posterior")
    file = pathlib.Path(folder) / posterior.text("table") if posterior and posterior.text("table") else None
    if not file or not file.is_file():
        return {}
    lines = [line.split(",") for line in file.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    try:
        return {name: np.array([float(line[k]) for line in lines[1:]]) for k, name in enumerate(lines[0])}
    except (ValueError, IndexError):
        raise Problem(f"{file} is no table of numbers (it is damaged): compare again") from None


def _candidate(node):
    row = node.row("error_calibration error_left_out error_left_out_se error_left_out_floor_noise_allowed delta_bic", "effect", "as_good_as_best visible")
    row["remark"] = node.text("remark")
    row["numbers_as_met_in_practice"] = node.value.get("numbers_as_met_in_practice") is not False
    row["left_out_refitted"] = node.value.get("left_out_refitted") is not False
    if not row["left_out_refitted"]:  # there is none, whatever an older file says
        row["error_left_out"] = row["error_left_out_se"] = np.nan
    row["effects"] = node.texts("effects") or [part for part in row["effect"].split("+") if part]
    parameters = node.node("parameters")
    row["parameters"] = []
    for name in parameters.value if parameters else ():
        found = parameters.node(name)
        if found:
            row["parameters"].append(found.row("value", "unit open") | {"name": name, "interval": found.interval("interval"),
                                                                     "no_interval": found.text("no_interval")})
    return row


def _proposal(node):
    if not node:
        return {}
    laws = [f"{what}: {node.text(key)}" for key, what in (("friction", "friction"), ("force", "force per mass")) if node.text(key)]
    return _candidate(node) | {"law": ", ".join(laws), "variable": node.text("variable")}


def read_diagnosis(folder):
    root = _root(folder, DIAGNOSIS, "freestand-diagnosis/2")
    verdict = root.text("verdict")
    if verdict not in ("none", "missing", "ambiguous", "unknown", "bad_data"):
        root.wrong("verdict", "one of none, missing, ambiguous, unknown, bad_data")
    base, recovered, suggestion = root.node("base"), root.node("recovered_force"), root.node("suggested_motion")
    columns = "mu mu_deviation mu_lower mu_upper force_mps2 force_lower_mps2 force_upper_mps2"
    suggested = {}
    if suggestion:
        motion, specimen = suggestion.node("motion"), suggestion.value.get("specimen")
        suggested = suggestion.row("separation_noise_units", "sentence") | {
            "between": suggestion.texts("between"), "specimen": specimen if isinstance(specimen, str) else "",
            "motion": motion.row("period_s peak_acceleration_g vertical_peak_acceleration_g", "pulse") if motion else {}}
    return Diagnosis(
        pathlib.Path(folder), root.value, _name(root, folder), verdict, root.text("reason"), root.texts("effects"),
        root.text("error_unit", "noise units"), root.texts("sentences"), root.texts("findings"), _candidate(base) if base else {},
        [_candidate(node) for node in root.nodes("candidates", needed=True)], root.number("noise_floor"),
        recovered.number("base_mu") if recovered else np.nan,
        [_table(node, columns) for node in recovered.nodes("tables")] if recovered else [], suggested,
        [node.row("p level simulations tries told_apart", "question about") for node in root.nodes("tests_of_chance")], _proposal(root.node("proposed_law")))


def _name(root, folder):
    given = root.text("name")
    if given:
        return given
    path = pathlib.Path(root.text("measurements"))
    return path.parent.name or path.stem or pathlib.Path(folder).resolve().name
