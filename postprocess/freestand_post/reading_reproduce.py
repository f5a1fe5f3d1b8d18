"""reproduce.json and the tables beside it as plain values: the report computed again, or a user's own peaks treated alike."""
import csv
import math
import pathlib
from dataclasses import dataclass

from .problem import Problem
from .reading import _json

REPRODUCE, FORMAT = "reproduce.json", "freestand-reproduce/1"
AGREES, DISAGREES, WITH_ITSELF, ALONE = "agrees", "disagrees", "print disagrees with itself", "not printed"


@dataclass
class Place:
    """One table or figure of the report."""
    id: str
    chapter: int
    place: str
    what: str
    items: list      # as in the file
    files: list
    left_out: list

    def numbers(self):
        return [item for item in self.items if item["kind"] == "number"]

    def printed(self):
        return [item for item in self.numbers() if item["verdict"] != ALONE]

    def value(self, name):
        """Our number of that id, without what stands before its last dot."""
        return self._number(name, "ours")

    def print(self, name):
        """The printed number beside it."""
        return self._number(name, "print")

    def _number(self, name, whose):
        return next((number(item[whose]) for item in self.numbers() if item["id"] == f"{self.id}.{name}"), math.nan)


@dataclass
class Reproduction:
    folder: pathlib.Path
    own_peaks: str   # file name of a user's table; "" where it is the report
    printed: int
    agree: int
    with_itself: int
    disagree: int
    records: bool
    places: list
    provenance: dict

    def place(self, name):
        return next((place for place in self.places if place.id == name), None)

    def table(self, name):
        """Rows of NAME.csv, each a dict with numbers as floats; none where the file is not there and nobody named it."""
        path = self.folder / f"{name}.csv"
        if not any(f"{name}.csv" in place.files for place in self.places):
            return []
        try:
            with open(path, newline="", encoding="utf-8") as file:
                return [{key: _cell(text) for key, text in row.items()} for row in csv.DictReader(file)]
        except (OSError, UnicodeDecodeError, csv.Error) as why:
            raise Problem(f"{path} cannot be read ({why}): run `freestand reproduce` again") from None


def number(value):
    return math.nan if value is None else float(value)


def _cell(text):
    if text in ("", None):
        return math.nan
    try:
        return float(text)
    except ValueError:
        return text


def read_reproduction(folder):
    path = folder / REPRODUCE
    found = _json(path)
    if found.get("format") != FORMAT:
        raise Problem(f'{path} says format "{found.get("format", "")}", not "{FORMAT}": it is another file, or of another version of freestand')
    try:
        places = [Place(one["id"], one["chapter"], one["place"], one["what"], one["items"], one["files"], one["left_out"]) for one in found["figures"]]
        return Reproduction(folder, found["own_peaks"] or "", found["numbers_printed"], found["numbers_that_agree"],
                            found["numbers_in_which_the_print_disagrees_with_itself"], found["numbers_that_disagree"], found["records"], places, found["provenance"])
    except (KeyError, TypeError) as why:
        raise Problem(f"{path} lacks what its page needs ({why}): run `freestand reproduce` again") from None
