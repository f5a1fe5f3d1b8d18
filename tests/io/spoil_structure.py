"""spoil_structure.py FILE FOLDER EVERY: copies of an HDF5 file, each with one dataset or attribute of another kind or shape, or gone; of all
that can be made every EVERYth. Exit code 77: a library is missing."""
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "postprocess"))

try:
    import h5py
    import numpy as np
except ImportError as why:
    print(why)
    sys.exit(77)

from freestand_post import closing  # noqa: E402


def remade(group, name, values=None, **how):
    """The dataset anew, with its attributes but for those that bind scales."""
    attributes = {key: value for key, value in group[name].attrs.items() if key not in ("DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME")}
    del group[name]
    dataset = group.create_dataset(name, data=values, **how)
    for key, value in attributes.items():
        dataset.attrs[key] = value


def dataset_faults(values):
    flat = values.reshape(-1)
    is_text = values.dtype == object
    yield "gone", lambda group, name: group.__delitem__(name)
    yield "none", lambda group, name: remade(group, name, flat[:0], dtype=flat.dtype)
    yield "less", lambda group, name: remade(group, name, flat[:-1], dtype=flat.dtype)
    yield "more", lambda group, name: remade(group, name, np.concatenate([flat, flat[:1]]), dtype=flat.dtype)
    yield "scalar", lambda group, name: remade(group, name, flat[0] if flat.size else 0)
    yield "cube", lambda group, name: remade(group, name, flat.reshape(-1, 1, 1), dtype=flat.dtype)
    yield "null", lambda group, name: remade(group, name, h5py.Empty("f8"))
    yield "huge", lambda group, name: remade(group, name, None, shape=(1 << 40,), chunks=(1 << 10,), dtype="f8")
    yield "endless", lambda group, name: remade(group, name, None, shape=(1 << 62, 1 << 62), chunks=(1 << 5, 1 << 5), dtype="i8")
    yield "another", lambda group, name: remade(group, name, np.arange(flat.size) if is_text else np.array(["x"] * flat.size, dtype=object))
    yield "group", lambda group, name: (group.__delitem__(name), group.create_group(name))
    yield "itself", lambda group, name: (group.__delitem__(name), group.__setitem__(name, h5py.SoftLink(name)))
    yield "elsewhere", lambda group, name: (group.__delitem__(name), group.__setitem__(name, h5py.ExternalLink("/dev/zero", "/")))
    if not is_text and flat.size:
        yield "outside", lambda group, name: remade(group, name, flat, external=[("/dev/zero", 0, flat.nbytes)])
        yield "large piece", lambda group, name: remade(group, name, flat, maxshape=(None,), chunks=(1 << 14,), compression=1)
        for word, number in (("nan", float("nan")), ("large", 1e300), ("negative", -7.0)):
            yield word, lambda group, name, number=number: remade(group, name, np.full(values.shape, number))


ATTRIBUTE_FAULTS = {
    "gone": lambda attributes, key: attributes.__delitem__(key),
    "text": lambda attributes, key: attributes.create(key, "x"),
    "number": lambda attributes, key: attributes.create(key, 1e300),
    "nan": lambda attributes, key: attributes.create(key, float("nan")),
    "list": lambda attributes, key: attributes.create(key, np.arange(3)),
    "none": lambda attributes, key: attributes.create(key, h5py.Empty("f8")),
    "fixed": lambda attributes, key: attributes.create(key, np.bytes_("fixed")),
}


def spoil(source, folder, every):
    made = wanted = 0

    def copy(where, word, change):
        nonlocal made, wanted
        wanted += 1
        if wanted % every:
            return
        path = folder / f"{made:05}.h5"
        shutil.copy(source, path)
        try:
            with h5py.File(path, "r+") as file:
                change(file)
            closing.close(path)
        except (TypeError, ValueError, OSError, RuntimeError, KeyError):  # h5py itself will not have it
            path.unlink()
            return
        path.with_suffix(".txt").write_text(f"{where}: {word}", encoding="utf-8")
        made += 1

    places = []
    with h5py.File(source, "r") as file:
        file.visititems(lambda name, item: places.append((name, isinstance(item, h5py.Dataset))))
        values = {name: file[name][()] for name, is_dataset in places if is_dataset}
        attributes = [(name, key) for name in ["/"] + [name for name, _ in places] for key in file[name].attrs
                      if key not in ("DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME", "units", "description")]
    for name, is_dataset in places:
        parent, _, leaf = ("/" + name).rpartition("/")
        if not is_dataset:
            copy(name, "gone", lambda file: file.__delitem__(name))
            continue
        for word, change in dataset_faults(np.asarray(values[name])):
            copy(name, word, lambda file: change(file[parent or "/"], leaf))
    for name, key in attributes:
        for word, change in ATTRIBUTE_FAULTS.items():
            copy(f"{name} @{key}", word, lambda file: change(file[name].attrs, key))
    return made


if __name__ == "__main__":
    print(spoil(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])))
