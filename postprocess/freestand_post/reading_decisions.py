"""risk.json and sensitivity.json as plain values."""
import pathlib
from dataclasses import dataclass

import numpy as np

from . import words
from .problem import Problem
from .reading import _json

RISK, SENSITIVITY = "risk.json", "sensitivity.json"
RISK_FORMAT, SENSITIVITY_FORMAT = "freestand-risk/1", "freestand-sensitivity/1"


def value(number):
    """A number of a JSON file, null as nan."""
    return float("nan") if number is None else float(number)


@dataclass
class RiskRow:
    edp: str
    unit: str
    capacity: float            # nan: the demand is yes or no
    rate: tuple                # value, lower, upper; nan where none is told
    in_years: list             # (years, value, lower, upper)
    by: str                    # function | counts
    why: str
    refused: str
    by_function: tuple
    by_counts: tuple
    outside_sweep: float
    outside_hazard: float
    share: np.ndarray          # [interval of intensity]; empty where no rate is told
    median_im: float

    @property
    def title(self):
        if np.isnan(self.capacity):
            return words.happening(self.edp)
        return f"{words.demand_meaning(self.edp)} > {words.chosen(self.capacity, self.unit)}"


@dataclass
class Risk:
    folder: pathlib.Path
    study_name: str
    sweep: str                 # name of the folder that the rates are of
    im: str
    im_unit: str
    period_s: float
    confidence: float
    hazard_im: np.ndarray
    hazard_rate: np.ndarray
    swept: tuple
    years: list
    edge: np.ndarray
    rows: list
    warnings: list

    @property
    def im_symbol(self):
        return words.intensity(self.im) + ("" if np.isnan(self.period_s) else f" at {self.period_s:g} s")

    def told(self):
        """Rows that have a rate."""
        return [row for row in self.rows if row.rate[0] > 0]


@dataclass
class Share:
    parameter: str
    share: tuple               # value, se, lower, upper
    total: tuple               # the same; nan where it was not asked for


@dataclass
class Answer:
    edp: str
    unit: str
    kind: str                  # ln_demand | exceeds | happens
    capacity: float
    samples: int
    why_empty: str
    shares: list
    together: tuple

    @property
    def title(self):
        if self.kind == "happens":
            return words.happening(self.edp)
        if self.kind == "exceeds":
            return f"P({words.demand_meaning(self.edp)} > {words.chosen(self.capacity, self.unit)})"
        return f"ln of the {words.demand_meaning(self.edp)}"


@dataclass
class Sensitivity:
    folder: pathlib.Path
    confidence: float
    pairs: int
    answers: list


def _document(path, form):
    document = _json(path)
    if document.get("format") != form:
        raise Problem(f'{path} says format "{document.get("format", "")}", not "{form}": it is another file, or of another version of '
                      "freestand")
    return document


def _triple(entry):
    return tuple(value(entry[key]) for key in ("annual_rate", "lower", "upper"))


def _estimate(entry):
    return tuple(value(entry[key]) for key in ("value", "se", "lower", "upper")) if entry else (float("nan"),) * 4


def read_risk(folder):
    path = folder / RISK
    found = _document(path, RISK_FORMAT)
    try:
        rows = [RiskRow(row["edp"], row["unit"], value(row["capacity"]), _triple(row),
                        [(value(one["years"]), value(one["probability"]), value(one["lower"]), value(one["upper"])) for one in row["in_years"]],
                        row["recommended"], row["why"], row["refused"], _triple(row["by_function"]), _triple(row["by_counts"]),
                        value(row["outside_sweep"]), value(row["outside_hazard"]), np.array(row["share_by_im"], float), float("inf") if row.get("median_beyond_hazard") else value(row["median_im"]))
                for row in found["demands"]]
        return Risk(folder, found["study_name"], found["sweep"], found["im"], found["im_unit"], value(found["period_s"]),
                    found["confidence"], np.array(found["hazard"]["im"]), np.array(found["hazard"]["annual_rate"]),
                    tuple(found["swept"]), found["years"], np.array(found["im_edge"]), rows, found["warnings"])
    except (KeyError, TypeError, ValueError) as why:
        raise Problem(f"{path} lacks what a risk needs ({why}): run `freestand risk` again") from None


def read_sensitivity(folder):
    path = folder / SENSITIVITY
    found = _document(path, SENSITIVITY_FORMAT)
    try:
        answers = [Answer(one["edp"], one["unit"], one["kind"], value(one["capacity"]), one["samples"], one["why_empty"],
                          [Share(name, _estimate(entry["share"]), _estimate(entry.get("total"))) for name, entry in one["shares"].items()],
                          _estimate(one.get("together"))) for one in found["answers"]]
        return Sensitivity(folder, found["confidence"], found["pairs"], answers)
    except (KeyError, TypeError, ValueError) as why:
        raise Problem(f"{path} lacks what a sensitivity needs ({why}): run `freestand sensitivity` again") from None
