"""check_files.py WHAT PATH: opens a file that the io tests wrote and checks what is in it. Exit code 77: library missing."""
import pathlib
import sys

sys.dont_write_bytecode = True

try:
    import numpy as np
except ImportError as why:
    print(why)
    sys.exit(77)


def need(module):
    try:
        return __import__(module)
    except ImportError as why:
        print(why)
        sys.exit(77)


def is_close(found, expected):
    assert np.array_equal(np.asarray(found), np.asarray(expected), equal_nan=True), f"{found} is not {expected}"


def carries_coordinates(root):
    """By the rules of netCDF-4, which xarray goes by: each dimension of a dataset has one scale, a dataset in the same group
    of one dimension and the same length, whose own name is that of the dimension."""
    h5py = need("h5py")
    seen = []

    def visit(name, item):
        if not isinstance(item, h5py.Dataset) or h5py.h5ds.is_scale(item.id):
            return
        for i, dimension in enumerate(item.dims):
            assert len(dimension) == 1, f"{name}: dimension {i} has {len(dimension)} scales"
            scale = dimension[0]
            assert scale.parent.name == item.parent.name, f"{name}: dimension {i} goes by {scale.name}"
            assert scale.shape == (item.shape[i],), f"{name}: {scale.name} is of another length"
            name = h5py.h5ds.get_scale_name(scale.id).decode()
            without_values = f"This is a netCDF dimension but not a netCDF variable.{scale.shape[0]:10}"
            assert name in (scale.name.rsplit("/", 1)[1], without_values), scale.name
            seen.append(scale.name)

    root.visititems(visit)
    assert seen


def samples_h5py(path):
    h5py = need("h5py")
    with h5py.File(path, "r") as root:
        assert root.attrs["format"] == "freestand-samples/2"
        carries_coordinates(root)
        assert root.attrs["study"] == "seed: 7\n# études\n"
        assert root.attrs["seed"] == 7 and root.attrs["samples"] == 10 and root.attrs["ranks"] == 1
        group = root["samples"]
        assert sorted(group) == ["block_width_m", "edp_delta", "impacts", "motion", "outcome", "overturned", "sample"]
        assert group["sample"].id.get_storage_size() == 0  # a dimension, and no column of numbers
        is_close(group["block_width_m"][:], 0.1 * np.arange(10) + 0.3)
        is_close(group["edp_delta"][:3], [np.nan, 1.0, 4.0])
        is_close(group["impacts"][:], -np.arange(10))
        types = {name: group[name].dtype for name in group}
        assert types["block_width_m"] == np.float64 and types["outcome"] == np.int32 and types["overturned"] == np.uint8
        for name in group:
            if name != "sample":
                assert group[name].dims[0].label == "" and group[name].dims[0][0].name == "/samples/sample"
        assert group["block_width_m"].attrs["unit"] == "m" and group["block_width_m"].attrs["description"] == "width"
        assert group["outcome"].attrs["flag_meanings"] == "at_rest moved overturned painleve step_limit not_finite passed_over"
        is_close(group["outcome"].attrs["flag_values"], np.arange(7))
        assert [text.decode() for text in root["motions/name"][:]] == ["A", "records/x y.AT2", "é"]
        is_close(root["motions/pga_mps2"][:], [1, 3.7, 1 / 3])
        assert root["motions/pga_mps2"].attrs["unit"] == "m/s2" and root["motions/pulse_type"].dtype == np.int32
        is_close(root["motions/sa_mps2"][:], [[1, 2], [0.1, 0.7], [5, 6]])


def samples_xarray(path, engine):
    xarray = need("xarray")
    need({"netcdf4": "netCDF4"}.get(engine, engine))
    with xarray.open_dataset(path, group="samples", engine=engine) as data:
        assert dict(data.sizes) == {"sample": 10} and not data.coords, data
        is_close(data["block_width_m"].values, 0.1 * np.arange(10) + 0.3)
        assert data["block_width_m"].dims == ("sample",) and data["block_width_m"].attrs["units"] == "m"
        assert float(data["edp_delta"].sel(sample=2)) == 4.0
    with xarray.open_dataset(path, group="motions", engine=engine) as data:
        assert [str(text) for text in data["name"].values] == ["A", "records/x y.AT2", "é"]
        assert float(data["sa_mps2"].sel(motion=1, period_s=0.5)) == 0.7
    with xarray.open_dataset(path, engine=engine) as data:
        assert data.attrs["study"] == "seed: 7\n# études\n"


def fragility_h5py(path):
    h5py = need("h5py")
    with h5py.File(path, "r") as root:
        assert root.attrs["format"] == "freestand-fragility/1" and root.attrs["im"] == "pga" and root.attrs["im_unit"] == "g"
        assert list(root.attrs["outcome_names"])[:2] == ["at_rest", "moved"]
        carries_coordinates(root)
        is_close(root.attrs["outcome_counts"], [1, 2, 3, 4, 5, 6])
        assert list(root.attrs["warnings"]) == ["one thing.", "another thing."]
        is_close(root["im/edge"][:], [0, 1, 2, 4])
        is_close(root["im/centre"][:], [0.5, 1.25, 3])
        is_close(root["edp/delta/im"][:], [0.5, 1.25, 3])
        assert h5py.h5ds.is_scale(root["im/centre"].id)
        edp = root["edp/delta"]
        assert edp.attrs["unit"] == "m" and edp.attrs["symbol"] == "Δ" and edp.attrs["kind"] == "continuous"
        is_close(edp["n"][:], [100, 101, 102])
        is_close(edp["lambda"][:], [0.25, 1.25, np.nan])
        is_close(edp["status"][:], [0, 2, 1])
        is_close(edp["capacity"][:], [0.5, 2])
        is_close(edp["surface/probability"][:], [[0, 0.125], [1, 1.125], [2, 2.125]])
        assert edp["surface/probability"].dims[0][0].name == "/edp/delta/surface/im"
        assert edp["surface/probability"].dims[1][0].name == "/edp/delta/surface/capacity"
        is_close(edp["distribution/count"][:], [[1, 2], [3, 4], [5, 6]])
        axis = edp["axis/friction_mu_k"]
        assert axis["probability"].shape == (3, 2, 2) and axis["probability"][2, 1, 0] == 10
        assert axis["probability"].dims[1][0].name == "/edp/delta/axis/friction_mu_k/centre"
        is_close(axis["n"][:], [[0, 1], [2, 3], [4, 5]])
        assert root["edp/overturned"].attrs["kind"] == "binary" and "distribution" not in root["edp/overturned"]
        over = root["overturning"]
        assert over.attrs["median"] == 1.5 and np.isnan(over.attrs["median_se"]) and over.attrs["penalised"] == 1
        assert over.attrs["extrapolated"] == 1 and over.attrs["im_least"] == 0.25 and over.attrs["im_most"] == 1.25
        assert over.attrs["misfit"] == 0.125 and over.attrs["misfit_im"] == 0.75 and np.isnan(over.attrs["misfit_p"])
        is_close(over["probability"][:], [0.25, 0.75])


def fragility_xarray(path, engine):
    xarray = need("xarray")
    need({"netcdf4": "netCDF4"}.get(engine, engine))
    with xarray.open_dataset(path, group="edp/delta", engine=engine) as data:
        assert data["lambda"].dims == ("im",) and float(data["lambda"].sel(im=1.25)) == 1.25
    with xarray.open_dataset(path, group="edp/delta/surface", engine=engine) as data:
        assert data["probability"].dims == ("im", "capacity"), data["probability"].dims
        assert float(data["probability"].sel(im=1.25, capacity=2)) == 1.125
    with xarray.open_dataset(path, group="edp/delta/axis/friction_mu_k", engine=engine) as data:
        assert data["probability"].dims == ("im", "centre", "capacity")
        assert float(data["probability"].sel(im=3, centre=1.5, capacity=0.5)) == 10
    for group in ("im", "edp/delta/distribution", "edp/overturned", "overturning"):
        xarray.open_dataset(path, group=group, engine=engine).close()


def database_h5py(path):
    h5py = need("h5py")
    with h5py.File(path, "r") as root:
        carries_coordinates(root)
        assert root["entries/width_m"].dims[0][0].name == "/entries/id"
        assert root["curves/median"].dims[0][0].name == "/curves/curve"
        assert root["points/curve"].dims[0][0].name == "/points/point"
        is_close(root["curves/curve"][:], np.arange(14))


def database_xarray(path, engine):
    xarray = need("xarray")
    need({"netcdf4": "netCDF4"}.get(engine, engine))
    with xarray.open_dataset(path, group="entries", engine=engine) as data:
        assert float(data["mu_k"].sel(id="rack_30_2")) == 0.3 and float(data["mass_kg"].sel(id="rack_30_2")) == 200
    with xarray.open_dataset(path, group="curves", engine=engine) as data:
        assert data["median"].dims == ("curve",) and int(data["entry"].sel(curve=3)) == 1
    with xarray.open_dataset(path, group="points", engine=engine) as data:
        assert data["probability"].dims == ("point",) and int(data["curve"].sel(point=5)) == 1
    with xarray.open_dataset(path, group="demands", engine=engine) as data:
        assert str(data["unit"].sel(name="peak_slip_m").values) == "m"
    with xarray.open_dataset(path, engine=engine) as data:
        assert data.attrs["name"] == "made" and [str(text) for text in data["classes"].values] == ["rack", "bookcase"]


def postprocess(path):
    need("h5py")
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "postprocess"))
    reading = __import__("freestand_post.reading", fromlist=["read_sweep"])
    sweep = reading.read_sweep(pathlib.Path(path))
    assert [edp.name for edp in sweep.edps] == ["delta", "overturned"], sweep.edps
    assert sweep.outcomes["not_finite"] == 6
    is_close(sweep.edps[0].surface["upper"], np.full((3, 2), 9))
    is_close(sweep.overturning["grid"], [1, 2])


what, file = sys.argv[1:]
if what.startswith("xarray"):
    kind, engine = what.split("-")[1:]
    {"samples": samples_xarray, "fragility": fragility_xarray, "database": database_xarray}[kind](file, engine)
else:
    {"samples": samples_h5py, "fragility": fragility_h5py, "database": database_h5py, "postprocess": postprocess}[what](file)
