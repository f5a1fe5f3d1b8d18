"""The two commands, and the one place where a Problem becomes a line on the terminal and an exit code."""
import argparse
import json
import pathlib
import sys

from .problem import DATA, USAGE, Problem


def _arguments(what, argv):
    parser = argparse.ArgumentParser(prog=f"postprocess/{what}", description={
        "figures": "Draws every picture of a result folder into DIR/figures, as SVG and PNG.",
        "report": "Writes DIR/report.html, one self-contained page, from a result folder."}[what] + " Several folders: a "
        "validation, as compared, diagnosed and compared again, in the order of the ladder, and the sweeps before and after; or several "
        "sweeps, which stand side by side, or one sweep or several fitted over several intensities; and what `freestand risk` found of them."
        " Or the one folder of `freestand reproduce`." + (" Or one database of `freestand catalogue`, alone." if what == "report" else ""))
    parser.add_argument("folders", metavar="DIR", type=pathlib.Path, nargs="+",
                        help="folder written by freestand run, fit, risk, simulate, compare, diagnose or reproduce" + (", or a database of catalogue" if what == "report" else ""))
    parser.add_argument("--history", metavar="DIR", type=pathlib.Path, help="folder of one freestand simulate, shown beside the sweep")
    parser.add_argument("-o", "--output", metavar="PATH", type=pathlib.Path,
                        help="where to write (default: figures or report.html in the last DIR)")
    return parser.parse_args(argv)


def read(folders, history=None):
    """What there is to draw: one Validation where a folder holds a comparison or a diagnosis, else the Designs (over each intensity) or Intensities of several
    sweeps, or a Sweep with its Sensitivity, and History and Risk values."""
    from . import over_intensities, reading
    from .database import is_database, read_database
    from .reading_decisions import RISK, SENSITIVITY, read_risk, read_sensitivity
    from .reading_reproduce import REPRODUCE, read_reproduction
    from .reading_validation import COMPARISON, DIAGNOSIS, read_comparison, read_diagnosis
    from .validation import Validation
    folders = [reading.existing_folder(folder) for folder in folders]
    if any(is_database(folder) for folder in folders):
        if len(folders) > 1 or history is not None:
            raise Problem("a database stands on a page of its own (it holds many sweeps already): give its folder alone", USAGE)
        return [read_database(folders[0])]
    if any((folder / REPRODUCE).exists() for folder in folders):
        if len(folders) > 1 or history is not None:
            raise Problem("the report computed again stands on a page of its own: give the folder of `freestand reproduce` alone", USAGE)
        return [read_reproduction(folders[0])]
    held, found = Validation(), []
    for folder in folders:
        compared, diagnosed = (folder / COMPARISON).exists(), (folder / DIAGNOSIS).exists()
        if compared:
            held.comparisons.append(read_comparison(folder))
        if diagnosed:
            held.diagnoses.append(read_diagnosis(folder))
        has_risk, has_shares = (folder / RISK).exists(), (folder / SENSITIVITY).exists()
        if reading.is_sweep(folder) or not (reading.is_history(folder) or compared or diagnosed or has_risk or has_shares):
            held.sweeps.append(reading.read_sweep(folder))
        if reading.is_history(folder):
            found.append(reading.read_history(folder))
        if has_risk:
            found.append(read_risk(folder))
        if has_shares:
            found.append(read_sensitivity(folder))
    if history is not None:
        found.append(reading.read_history(history))
    if held.comparisons or held.diagnoses:
        _one_data_set(held)
        held.comparisons.sort(key=lambda comparison: len(comparison.effects))
        return [held] + found
    if len(held.sweeps) > 1:
        return over_intensities.compare(held.sweeps) + found
    return held.sweeps + found


def _one_data_set(held):
    names = list(dict.fromkeys(document.name for document in held.comparisons + held.diagnoses))
    if len(names) > 1:
        raise Problem(f"the folders are of different measurements ({', '.join(names)}): give those of one data set", USAGE)


def _figures(arguments):
    import io

    from . import pictures, style
    from .database import is_database
    from .writing import unwritten, write, write_list
    if any(is_database(folder) for folder in arguments.folders):
        raise Problem("a database has no pictures as files (its page draws what is chosen): use postprocess/report", USAGE)
    results = read(arguments.folders, arguments.history)
    target = arguments.output or arguments.folders[-1] / "figures"
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as why:
        raise unwritten(target, why) from why
    style.apply()
    captions = {}
    for result in results:
        for picture in pictures.draw(result):
            write(target / f"{picture.name}.svg", style.svg(picture.figure))
            made = io.BytesIO()
            picture.figure.savefig(made, format="png", dpi=style.DPI)
            write(target / f"{picture.name}.png", made.getvalue())
            captions[picture.name] = {"finding": picture.finding, "caption": picture.caption}
    write(target / "captions.json", json.dumps(captions, indent=1, ensure_ascii=False) + "\n")
    write_list(target, [f"{name}.{kind}" for name in captions for kind in ("svg", "png")] + ["captions.json"])
    print(f"{len(captions)} pictures in {target}")


def _report(arguments):
    from . import database, report
    from .writing import write
    results = read(arguments.folders, arguments.history)
    target = arguments.output or arguments.folders[-1] / "report.html"
    made = database.page(results[0]) if isinstance(results[0], database.Database) else report.page(results)
    write(target, made)
    print(target.resolve())


def main(what, argv=None):
    arguments = _arguments(what, argv)
    try:
        {"figures": _figures, "report": _report}[what](arguments)
    except Problem as problem:
        print(f"postprocess/{what}: {problem}", file=sys.stderr)
        return problem.exit_code
    except OSError as why:
        reason = "no permission" if isinstance(why, PermissionError) else (why.strerror or str(why)).lower()
        print(f"postprocess/{what}: {why.filename or 'a file'} cannot be used ({reason})", file=sys.stderr)
        return DATA
    except ModuleNotFoundError as why:
        print(f"postprocess/{what}: the Python package {why.name} is not there: run jobs/install", file=sys.stderr)
        return USAGE
    return 0
