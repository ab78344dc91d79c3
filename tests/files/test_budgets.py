"""What files may ask for: nothing beyond their own size is allocated, and headers that make no sense are refused."""

import io
import json
import time
import tracemalloc
import zipfile

import numpy as np
import pytest

import flypend as fp
from flypend.errors import InputError
from flypend.files.arrays import read_arrays
from flypend.files.netcdf import MOST_ENTRIES, Variable, _header, read_netcdf, write_netcdf
from flypend.files.reading import MOST_TEXT, parse_json, read_bytes
from flypend.files.schema import Field, check_arrays
from flypend.files.toml import MOST_NAMES, parse_toml, read_toml

MEGABYTE = 2**20
LETTERS = {"a": Field(("n",), "<f8")}


def peak(function, *arguments):
    """Bytes that a call takes at most, and the error that it raises."""
    tracemalloc.start()
    try:
        with pytest.raises(ValueError) as caught:  # noqa: PT011 (what InputError is, too)
            function(*arguments)
        return tracemalloc.get_traced_memory()[1], caught.value
    finally:
        tracemalloc.stop()


# NetCDF ---------------------------------------------------------------------------------------------------------------


def netcdf(names, values, begins):
    """A file whose header says that the variables `names` begin at `begins`, counted from the end of the header."""
    stored = {name: Variable(("t",), values) for name in names}
    size = len(_header(stored, {"t": len(values)}, {}, [0] * len(names)))
    return _header(stored, {"t": len(values)}, {}, [size + begin for begin in begins]) + values.tobytes()


def test_variables_that_share_bytes_are_refused_before_they_are_read(tmp_path):
    """3,000 names of one block of 2 MB would take 6 GB."""
    path = tmp_path / "shared.nc"
    path.write_bytes(netcdf([f"v{k}" for k in range(3000)], np.zeros(MEGABYTE // 4, ">f8"), [0] * 3000))
    most, error = peak(read_netcdf, path)
    assert "shares bytes" in str(error)
    assert most < 20 * MEGABYTE
    with pytest.raises(InputError, match="shares bytes"):
        fp.load(path)


@pytest.mark.parametrize(
    ("begins", "said"),
    [([0, 8], "shares bytes"), ([-8, 32], "shares bytes"), ([32, 32], "shares bytes"), ([0, 40], "cut off")],
)
def test_variables_lie_behind_the_header_inside_the_file_and_apart(begins, said, tmp_path):
    values, path = np.arange(4, dtype=">f8"), tmp_path / "file.nc"
    path.write_bytes(netcdf(["a", "b"], values, [0, 32]) + values.tobytes())
    np.testing.assert_array_equal(read_netcdf(path)[0]["b"].values, values)
    path.write_bytes(netcdf(["a", "b"], values, begins) + values.tobytes())
    with pytest.raises(ValueError, match=said):
        read_netcdf(path)


def test_a_name_twice_is_refused(tmp_path):
    write_netcdf(
        tmp_path / "a.nc",
        {"ab": Variable(("t",), np.ones(2)), "cd": Variable(("t",), np.ones(2))},
        {"gh": "1", "ij": "2"},
    )
    content = (tmp_path / "a.nc").read_bytes()
    for one, other in ((b"cd\0\0", b"ab\0\0"), (b"ij\0\0", b"gh\0\0")):
        assert content.count(one) == 1
        (tmp_path / "b.nc").write_bytes(content.replace(one, other))
        with pytest.raises(ValueError, match="there twice"):
            read_netcdf(tmp_path / "b.nc")


@pytest.mark.parametrize("count", [MOST_ENTRIES + 1, 2**32 - 1])
def test_a_header_of_many_entries_is_refused_before_they_are_read(count, tmp_path):
    path = tmp_path / "many.nc"
    path.write_bytes(b"CDF\x02" + bytes(4) + (10).to_bytes(4) + count.to_bytes(4) + bytes(8 * MOST_ENTRIES))
    most, error = peak(read_netcdf, path)
    assert "entries" in str(error)
    assert most < 10 * MEGABYTE


def test_a_dimension_that_is_not_there_and_too_many_are_refused(tmp_path):
    content = netcdf(["a"], np.arange(4, dtype=">f8"), [0])
    place = content.index(b"a\0\0\0") + 4
    for number, count in ((7, 1), (0, 9), (0, 2**32 - 1)):
        path = tmp_path / "file.nc"
        path.write_bytes(
            content[:place] + count.to_bytes(4) + number.to_bytes(4) * min(count, 20) + content[place + 8 :]
        )
        with pytest.raises(ValueError, match="dimensions of a"):
            read_netcdf(path)


def test_a_file_that_is_larger_than_the_memory_is_not_read(tmp_path):
    path = tmp_path / "hole.nc"
    with path.open("wb") as stream:
        stream.truncate(2**33)
    begin = time.process_time()
    with pytest.raises(InputError, match=r"hole\.nc: expected "):
        fp.load(path)
    assert time.process_time() - begin < 5


# Bytes and texts ------------------------------------------------------------------------------------------------------


def test_of_what_has_no_end_no_more_is_read_than_may_be():
    most, error = peak(read_bytes, "/dev/zero", 2 * MEGABYTE)
    assert "at most 2097152 bytes" in str(error)
    assert most < 8 * MEGABYTE
    with pytest.raises(InputError, match="dev/zero: expected a file of at most"):
        read_toml("/dev/zero")


@pytest.mark.parametrize(
    "text",
    [
        "NaN",
        "[Infinity]",
        "1e999",
        "-1e999",
        "1" * 30,
        '{"a": 1, "a": 2}',
        '"\\ud800"',
        "[" * 50_000,
        "{",
        "1" * (MOST_TEXT + 1),
    ],
)
def test_json_that_a_reader_has_no_use_for_is_refused(text):
    with pytest.raises(ValueError, match=r"."):
        parse_json(text)


def test_other_json_is_what_json_says():
    content = {"a": [1.5, -2, True, None, {"b": "ü\U0001f681"}], "c": 2**62}
    assert parse_json(json.dumps(content)) == content


def test_toml_ends_in_one_line_and_in_time(tmp_path):
    path = tmp_path / "v.toml"
    for text in (
        ".".join("a" * 16_000) + " = 1",
        "[" + ".".join(["'a'"] * 16_000) + "]",
        "a = " + "[" * 5000,
        "x = '" + "a" * MOST_TEXT + "'",
    ):
        path.write_text(text, encoding="utf-8")
        begin = time.process_time()
        with pytest.raises(InputError) as caught:
            fp.vehicle(path)
        assert "\n" not in str(caught.value)
        assert time.process_time() - begin < 2
    deep = ".".join(f"a{k}" for k in range(MOST_NAMES))
    assert parse_toml("x", deep + ' = "1.2.3. And so on."')
    with pytest.raises(InputError, match="keys of at most"):
        parse_toml("x", f"b.{deep} = 1")


# Arrays of NumPy ------------------------------------------------------------------------------------------------------


def npz(header, data, size=None, kind=zipfile.ZIP_DEFLATED):
    """A file .npz with the array a; `size` is what its directory says of its size."""
    text = header.encode() + b" " * (117 - len(header)) + b"\n"
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", kind) as archive:
        archive.writestr("a.npy", b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text + data)
    content = stream.getvalue()
    if size is not None:
        content = content.replace((128 + len(data)).to_bytes(4, "little"), size.to_bytes(4, "little"))
    return content


HEADER = "{'descr': '%s', 'fortran_order': False, 'shape': %s, }"


@pytest.mark.parametrize(
    ("header", "count", "size", "kind"),
    [
        (HEADER % ("<f8", "(9000000000,)"), 64, None, zipfile.ZIP_DEFLATED),  # a shape of 72 GB
        (HEADER % ("<f8", "(33554432,)"), 2**28, None, zipfile.ZIP_DEFLATED),  # 256 MB, of 260 kB
        (HEADER % ("<f8", "(8,)"), 2**28, 192, zipfile.ZIP_DEFLATED),  # the same, that says 192 bytes
        (HEADER % ("<f8", "(8,)"), 64, None, zipfile.ZIP_LZMA),  # a dictionary of any size
        (HEADER % ("|O", "(8,)"), 64, None, zipfile.ZIP_STORED),
        (HEADER % ("<U0", "(9000000000,)"), 0, None, zipfile.ZIP_STORED),
        ("{'descr': [1].pop(), 'fortran_order': False, 'shape': (8,), }", 64, None, zipfile.ZIP_STORED),
    ],
)
def test_arrays_that_ask_for_more_than_they_hold_are_refused(header, count, size, kind, tmp_path):
    (tmp_path / "a.npz").write_bytes(npz(header, bytes(count), size, kind))
    most, error = peak(read_arrays, "policy", tmp_path / "a.npz", "a file", LETTERS)
    assert isinstance(error, InputError)
    assert most < 40 * MEGABYTE


def test_arrays_of_numpy_are_read(tmp_path):
    values = np.arange(6.0).reshape(2, 3)
    for save in (np.savez, np.savez_compressed):
        for given in (values, values.T, np.asfortranarray(values), values.astype("<f4"), np.float64(3)):
            save(tmp_path / "a.npz", a=given)
            fields = {"a": Field(given.shape, "<f8")}
            np.testing.assert_array_equal(read_arrays("policy", tmp_path / "a.npz", "a file", fields)["a"], given)


# Fields ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("field", "values", "said"),
    [
        (Field(("n", 3)), np.ones((4, 2)), "shape"),
        (Field(("n",)), np.ones((4, 3)), "shape"),
        (Field(("n",)), np.array([1.0, np.nan]), "finite numbers"),
        (Field(("n",), low=0), np.array([1.0, -1.0]), "numbers from 0"),
        (Field(("n",), high=1), np.array([1.0, 2.0]), "numbers from"),
        (Field(("n",), "<f4"), np.ones(3), "array of float32"),
        (Field(("n",), "<i8"), np.ones(3), "array of int64"),
        (Field(("n",)), np.array(["1"]), "array of float64"),
        (Field(("n",)), np.array([1j]), "array of float64"),
        (Field(("n",)), np.array([None]), "array of float64"),
    ],
)
def test_an_array_is_as_its_field_says(field, values, said):
    with pytest.raises(InputError, match=f"^a: expected .*{said}"):
        check_arrays({"a": field}, {"a": values})


def test_lengths_of_one_name_are_one_and_nan_is_bounded_where_it_may_be():
    fields = {"a": Field(("n",), finite=False, low=0), "b": Field(("n", "m")), "c": Field(("m",))}
    good = {"a": [np.nan, np.inf], "b": np.ones((2, 5)), "c": np.ones(5), "other": object()}
    assert check_arrays(fields, good).keys() == {"a", "b", "c"}
    for name, values in {"a": [np.nan, -1.0], "b": np.ones((3, 5)), "c": np.ones(4)}.items():
        with pytest.raises(InputError, match=f"^{name}: "):
            check_arrays(fields, good | {name: values})
    with pytest.raises(InputError, match=r"^c: expected an array, got nothing"):
        check_arrays(fields, {"a": good["a"], "b": good["b"]})
    with pytest.raises(InputError, match=r"^b: "):
        check_arrays(fields, good, {"m": 6})
