"""Who includes whom, how long files are, what words stay out: the rules of the tree, checked on its text.

    architecture.py ROOT        one line for every violation; exit 1 if there is any

The module graph is read from CMakeLists.txt (freestand_module, freestand_program), so that it is written once.
"""
import pathlib
import re
import sys
from dataclasses import dataclass

LINES = 400
# The header of a package -> its name in cmake/freestand_packages.cmake. First match counts.
PACKAGES = (
    (r"mpi\.h", "mpi"), (r"(hdf5|hdf5_hl|H5\w*)\.h", "hdf5"), (r"zlib\.h", "zlib"), (r"yaml-cpp/.*", "yaml"), (r"CLI/.*", "cli11"), (r"fmt/.*", "fmt"),
    (r"gsl/.*", "gsl"), (r"fftw3.*\.h", "fftw"), (r"(Eigen|unsupported/Eigen)/.*", "eigen"), (r"nlohmann/.*", "json"),
    (r"Random123/.*", "Random123"), (r"(sundials|cvode|arkode|ida|kinsol|nvector|sunmatrix|sunlinsol|sunnonlinsol)/.*", "sundials"),
    (r"xsimd/.*", "xsimd"), (r"muParser\W.*", "muparser"),
    (r"pugixml\.hpp", "pugixml"), (r"csv\.h", "csv"))
# Packages that one folder keeps to itself, whatever others link.
ONLY_IN = {"mpi": {"parallel"}, "hdf5": {"io"}, "yaml": {"study"}, "cli11": {"app"}, "sundials": {"dynamics"}}
KERNEL = ("dynamics", "effects")  # what is judged
# Who may never see effects: the physics.
PHYSICS = ("base", "motion", "sampling", "dynamics", "edp", "intensity", "fragility")
POSIX = ("unistd.h", "pthread.h", "fcntl.h", "signal.h", "dirent.h", "errno.h", "glob.h", "malloc.h")
# Split, so that this file does not hold the words itself.
WORDS = tuple(re.compile(pattern) for pattern in (r"\bTO" r"DO\b", r"\bFIX" r"ME\b", r"\bXX" r"X\b", r"\bHA" r"CK\b", r"(?i)\bplace" r"holder\b",
                                                  r"(?i)\bnot " r"(yet )?implemented\b"))
SOURCE_FOLDERS = ("src", "include", "tests", "postprocess", "jobs", "cmake", "configs")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
CODE = (".cpp", ".hpp")


@dataclass(frozen=True)
class Module:
    name: str
    links: frozenset   # names of modules and packages, as declared
    registry: bool = False
    rooms: tuple = ()  # folders within it, in the order of use: each sees those before it and what lies beside them, which sees none


def modules(root):
    """Name -> Module, from CMakeLists.txt. The folder of a program (src/app) counts as a module."""
    text = re.sub(r"#.*", "", (root / "CMakeLists.txt").read_text(encoding="utf-8"))
    found = {}
    for body in re.findall(r"freestand_module\(([^)]*)\)", text):
        links, _, rooms = body.partition(" ROOMS ")
        words = links.split()
        found[words[0]] = Module(words[0], frozenset(words[1:]) - {"LINKS", "REGISTRY", "ALONE"}, "REGISTRY" in words, tuple(rooms.split()))
    for body in re.findall(r"freestand_program\(([^)]*)\)", text):
        words = body.split()
        folder = pathlib.PurePosixPath(words[1]).name
        found[folder] = Module(folder, frozenset(words[2:]) - {"LINKS"})
    return found


def visible(name, graph):
    """What a module sees: itself and whatever it links, directly or through others."""
    seen, open_ = set(), [name]
    while open_:
        at = open_.pop()
        if at in seen:
            continue
        seen.add(at)
        open_.extend(graph[at].links if at in graph else ())
    return seen


def graph_problems(root):
    graph = modules(root)
    found = []
    for module in graph.values():
        for link in module.links & graph.keys():
            if module.name in visible(link, graph):
                found.append(f"CMakeLists.txt: {module.name} and {link} link each other (a cycle)")
    for folder in sorted((root / "src").iterdir()):
        if folder.is_dir() and folder.name not in graph and any(file.suffix in CODE for file in folder.rglob("*")):
            found.append(f"src/{folder.name}: holds sources but is no module of CMakeLists.txt")
    return found


def package_of(header):
    return next((package for pattern, package in PACKAGES if re.fullmatch(pattern, header)), None)


def include_problems(root):
    graph = modules(root)
    found = []
    for file in sorted((root / "src").rglob("*")) + sorted((root / "include").rglob("*")):
        if file.suffix not in CODE:
            continue
        public = file.is_relative_to(root / "include")
        module = "" if public else file.relative_to(root / "src").parts[0]
        text = file.read_text(encoding="utf-8")
        for match in INCLUDE.finditer(text):
            line = text.count("\n", 0, match.start(2)) + 1
            problem = (_include_problem(root, graph, module, match.group(1), match.group(2))
                       or _room_problem(graph.get(module), file.relative_to(root).parts[2:-1], match.group(2).split("/")))
            if problem:
                found.append(f"{file.relative_to(root)}:{line}: {problem}")
    return found


def _include_problem(root, graph, module, bracket, header):
    """What is wrong with one include of a module ("" for the public headers), or None."""
    if header.startswith("freestand/"):
        return None if (root / "include" / header).exists() else f"includes {header}, which include/ does not hold"
    package = package_of(header)
    if package:
        return _package_problem(graph, module, header, package)
    if bracket == "<":
        known = "/" not in header and ("." not in header or header in POSIX) or header.startswith("sys/")
        return None if known else f"includes <{header}>, which belongs to no package in PACKAGES of this test"
    if ".." in header.split("/"):
        return f'includes "{header}": give the path from src/'
    if not module:
        return f'a public header includes "{header}": public headers see only each other'
    if "/" not in header and _generated(root, header):
        return None
    other = header.split("/")[0] if "/" in header else ""
    if not other or not (root / "src" / header).exists():
        return f'includes "{header}", which is no path from src/'
    if other not in visible(module, graph):
        return f'{module} includes "{header}" but CMakeLists.txt does not let it see {other}'
    if other == "effects" and module in PHYSICS:
        return f'{module} includes "{header}": no physics module may see effects'
    return None


def _room_problem(module, within, header):
    """What is wrong with what a room of a module includes of another room, or None."""
    if not module or not module.rooms or header[0] != module.name:
        return None
    rooms = ("", *module.rooms)
    room, other = "/".join(within), "/".join(header[1:-1])
    for name in (room, other):
        if name not in rooms:
            return f"{module.name}/{name} is none of its ROOMS in CMakeLists.txt"
    if rooms.index(other) > rooms.index(room):
        return f'{room or module.name} includes "{"/".join(header)}": {other} comes after it'
    return None


def _generated(root, header):
    """Is it a header that CMake writes at build time?"""
    scripts = [root / "CMakeLists.txt", *(root / "cmake").rglob("*.cmake"), *(root / "src").glob("*/*.cmake")]
    return any(f"/{header}" in script.read_text(encoding="utf-8") for script in scripts)


def _package_problem(graph, module, header, package):
    if not module:
        return f"a public header includes <{header}>: public headers see only the standard library"
    if package in ONLY_IN and module not in ONLY_IN[package]:
        return f"{module} includes <{header}>: only src/{' and src/'.join(sorted(ONLY_IN[package]))} may"
    if package not in (graph[module].links if module in graph else ()):
        return f"{module} includes <{header}> but does not link {package} in CMakeLists.txt"
    return None


def sources(root):
    """Every text file of the tree that people write."""
    for folder in SOURCE_FOLDERS:
        for file in sorted((root / folder).rglob("*")) if (root / folder).exists() else ():
            if file.is_file() and "__pycache__" not in file.parts and file.suffix not in (".svg", ".png", ".h5", ".csv", ".json", ".pyc"):
                yield file


def text_problems(root):
    found = []
    for file in sources(root):
        try:
            lines = file.read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue
        name = file.relative_to(root)
        if len(lines) > LINES:
            found.append(f"{name}: {len(lines)} lines, more than {LINES}: split it")
        for number, line in enumerate(lines, start=1):
            found += [f"{name}:{number}: holds \"{word.search(line).group()}\": finish it or leave it out" for word in WORDS if word.search(line)]
    return found


def registry_problems(root):
    """In a folder of things found by name, every .cpp registers one thing, but for those that a header of the folder declares."""
    found = []
    for module in modules(root).values():
        folder = root / "src" / module.name
        if not module.registry or not folder.exists():
            continue
        declared = {file.stem for file in folder.glob("*.hpp")}
        for file in sorted(folder.glob("*.cpp")):
            registers = re.search(r"\bRegister(?:ed\w*|Check)?(?:<[^;{]*>)?\s+\w+\s*[{(]", file.read_text(encoding="utf-8"))
            if not registers and file.stem not in declared and not _helper(folder, file):
                found.append(f"src/{module.name}/{file.name}: registers nothing: each file of this folder adds one thing by name")
    return found


def _helper(folder, file):
    """A second .cpp of a header: its name starts with that of the header (record_text.cpp of record.hpp)."""
    return any(file.stem.startswith(header.stem + "_") for header in folder.glob("*.hpp"))


def judge_problems(root):
    """The integrators that judge the kernel, and whatever they include, share nothing with it."""
    found, seen = [], set()
    open_ = [root / "tests" / name for name in ("hidden_effect/generator.cpp", "hidden_effect/default_effects.cpp", "support/moreau_stepper.cpp",
                                                "support/moreau_events.cpp", "support/moreau_impulses.cpp", "support/bouc_wen_stepper.cpp")]
    while open_:
        file = open_.pop()
        if file in seen or not file.exists():
            continue
        seen.add(file)
        for match in INCLUDE.finditer(file.read_text(encoding="utf-8")):
            header = match.group(2)
            if header.split("/")[0] in KERNEL:
                found.append(f'{file.relative_to(root)}: includes "{header}": what judges the kernel shares nothing with it')
            open_ += [root / "tests" / header, root / "src" / header]
    return found


def leftovers(root):
    """Result files in the root of the tree, where a test that was started there has left them."""
    return [f"{file.name}: a result file in the root: remove it, and let what writes it use a folder of its own" for file in sorted(root.glob("*.h5"))]


def problems(root):
    root = pathlib.Path(root)
    return leftovers(root) + graph_problems(root) + include_problems(root) + text_problems(root) + registry_problems(root) + judge_problems(root)


if __name__ == "__main__":
    lines = problems(sys.argv[1] if len(sys.argv) > 1 else ".")
    print("\n".join(lines) if lines else "no violation")
    sys.exit(1 if lines else 0)
