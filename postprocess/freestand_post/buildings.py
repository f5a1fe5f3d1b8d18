"""Records that shake equipment on the floors of buildings: which building, which floor, and how hard it shakes."""
import itertools
import math

import numpy as np


def stand_in_one(ground):
    """[motion] Is it a floor of a building, or a record of the ground on which floors hang? ground: index of the motion each hangs on."""
    ground = np.asarray(ground, dtype=int)
    return np.isin(ground, ground[ground != np.arange(ground.size)])


def amplification(names, ground, storey, peak):
    """(building, storey) -> {record: peak acceleration of that floor over the ground's}. Floors are named "RECORD BUILDING storey NUMBER".

    A record that several entries of the study name counts once in a building. Where two buildings have one name, the second one of a
    record shakes otherwise: it is called "NAME 2".
    """
    found = {}
    for i, (name, below) in enumerate(zip(names, np.asarray(ground, dtype=int))):
        if below == i:
            continue
        record, floor, ratio = names[below], int(storey[i]), float(peak[i] / peak[below])
        building = name.removeprefix(record).removesuffix(f" storey {floor}").strip()
        for number in itertools.count(1):
            known = found.setdefault((building if number == 1 else f"{building} {number}", floor), {})
            if math.isclose(known.setdefault(record, ratio), ratio, rel_tol=1e-9):
                break
    return found
