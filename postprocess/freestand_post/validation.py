"""A validation: comparisons in the order of the ladder, what a diagnosis said between them, and sweeps before and after."""
import math
from dataclasses import dataclass, field

import numpy as np

from . import style, words


@dataclass
class Validation:
    comparisons: list = field(default_factory=list)
    diagnoses: list = field(default_factory=list)
    sweeps: list = field(default_factory=list)

    @property
    def first(self):
        return self.comparisons[0] if self.comparisons else None

    @property
    def last(self):
        return self.comparisons[-1] if self.comparisons else None

    @property
    def diagnosis(self):
        return self.diagnoses[0] if self.diagnoses else None

    @property
    def name(self):
        return (self.first or self.diagnosis).name

    @property
    def unit(self):
        return (self.first or self.diagnosis).unit

    @property
    def labels(self):
        """What the comparisons are called, by their effects; by folder where two have the same."""
        names = [model_name(comparison.effects) for comparison in self.comparisons]
        return [name if names.count(name) == 1 else comparison.folder.resolve().name
                for name, comparison in zip(names, self.comparisons)]

    @property
    def colours(self):
        """The last model blue, the first vermilion, those between in other hues."""
        n = len(self.comparisons)
        between = [style.ORANGE, style.PURPLE, style.SKY]
        return [style.BLUE if i == n - 1 else style.VERMILION if i == 0 else between[(i - 1) % 3] for i in range(n)]

    @property
    def own_friction(self):
        """Does friction scatter from test to test, so that errors are told with a friction of its own in each?"""
        return bool(self.last) and any(math.isfinite(test["own_friction"]) for test in self.last.tests)

    def ladder(self):
        """[{step, model, error_calibration, error_holdout, noise_floor, noise_floor_holdout}] of the folders, or of the study where it holds more;
        where friction scatters with the floor's noise and the friction of each test allowed for."""
        if not self.last:
            return []
        shown, before = [], None
        error = "error_floor_noise_allowed" if self.own_friction else "error"
        for comparison in self.comparisons:
            fresh = [name for name in comparison.effects if before and name not in before.effects]
            grown = before is not None and set(before.effects) < set(comparison.effects)
            shown.append({"step": f"+ {effects(fresh)}" if grown else model_name(comparison.effects),
                          "model": model_name(comparison.effects), "error_calibration": comparison.calibration.get(error, np.nan),
                          "error_holdout": comparison.holdout.get(error, np.nan),
                          "noise_floor": comparison.calibration.get("error_expected", np.nan),
                          "noise_floor_holdout": comparison.holdout.get("error_expected", np.nan)})
            before = comparison
        if len({frozenset(comparison.effects) for comparison in self.comparisons}) < len(shown):
            shown = []  # not steps of one ladder, but for example two sets of numbers for one model
        kept, held = [], []
        for row in self.last.ladder:
            held = held + [row["step"]] * (row["step"] != "base")
            if self.own_friction:
                row = row | {"error_calibration": row["explained_calibration"], "error_holdout": row["explained_holdout"]}
            kept.append(row | {"step": f"+ {effect(row['step'])}" if row["step"] != "base" else "base", "model": model_name(held)})
        return kept if len(kept) > len(shown) else shown

    def noise_floors(self):
        """Least and greatest of the noise floors on the page: (nan, nan) where none is known."""
        known = [diagnosis.noise_floor for diagnosis in self.diagnoses]
        known += [of.get("error_expected", math.nan) for comparison in self.comparisons for of in (comparison.calibration, comparison.holdout)]
        known = [floor for floor in known if math.isfinite(floor)]
        return (min(known), max(known)) if known else (math.nan, math.nan)

    def after_found(self):
        """Whether the last comparison has an effect that the first lacks."""
        return len(self.comparisons) > 1 and bool(set(self.last.effects) - set(self.first.effects))


# What the laboratory may state wrongly: candidates beside the effects.
FAULTS = {"width_as_stated": "the stated width", "centre_height_as_stated": "the stated height of the centre of mass",
          "floor_gain_as_stated": "the gain of the floor's accelerometer",
          "clock_as_stated": "the clock of the responses"}


def effect(name):
    return FAULTS.get(name) or name.replace("_", " ").replace("+", " + ")


def effects(names, last=" and "):
    shown = [effect(name) for name in names]
    return shown[0] if len(shown) == 1 else ", ".join(shown[:-1]) + last + shown[-1] if shown else ""


def model_name(names):
    return f"with {effects(names)}" if names else "base"


def by(label):
    """A model in a sentence: "with the base model", "with static friction", "in FOLDER"."""
    return "with the base model" if label == "base" else label if label.startswith("with ") else f"in {label}"


def error(value, unit=""):
    """"17.4", "1.03", "0.081", with its unit if wanted."""
    if not math.isfinite(value):
        return "–"
    return words.number(value, 2 if value >= 100 else 3) + (f" {unit}" if unit else "")


def parameter(name):
    """"effects.static_friction.ratio" -> "static friction: ratio", "friction.mu" -> "friction: μ"."""
    if name.startswith("laboratory."):
        return f"{FAULTS.get(name.removeprefix('laboratory.'), name)}: factor"
    parts = name.removeprefix("effects.").split(".")
    last = words.split_unit(parts[-1])[0]
    last = {"mu": "μ", "mu_k": "μk", "mu_s": "μs"}.get(last, last.replace("_", " "))
    return ": ".join([" ".join(parts[:-1]).replace("_", " "), last]) if len(parts) > 1 else last


VARIABLES = {"phase": "phase of motion", "speed_mps": "sliding speed", "path_m": "path slid", "position_m": "position",
             "direction": "direction of sliding", "normal_g": "normal force over mass", "time_s": "time",
             "floor_g": "floor acceleration"}


def scaled(table):
    """Factor and axis label of the variable of a table; short lengths in millimetres."""
    name, largest = short_variable(table), np.nanmax(np.abs(table.centre), initial=0.0)
    return (1000.0, f"{name} (mm)") if table.unit == "m" and 0 < largest < 0.02 else (1.0, words.with_unit(name, table.unit))


def short_variable(table):
    return VARIABLES.get(table.variable, words.split_unit(table.variable)[0].replace("_", " "))
