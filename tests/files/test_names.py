"""Names of files and folders: all that a file can have are taken, others are refused before anything is written."""

import pytest

import flypend as fp
from flypend.files.staging import check_writable, write_texts


@pytest.mark.parametrize("length", [1, 236, 255])
def test_a_folder_may_have_any_name_that_the_system_allows(tmp_path, length):
    out = tmp_path / ("a" * length)
    check_writable(out)
    for text in ("1", "2"):  # beside it, then inside
        write_texts(out, {"b": text})
        assert [(path.name, path.read_text()) for path in out.iterdir()] == [("b", text)]
    assert list(tmp_path.iterdir()) == [out]


@pytest.mark.parametrize("name", ["a\0b", "\ud800"])
def test_a_name_that_no_file_can_have_is_refused_before_anything_is_written(tmp_path, monkeypatch, name):
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.lqr(), fp.State(y=(0, 0, 1)), 0.1, plant="ideal")
    monkeypatch.setattr("flypend.flight.files.write_netcdf", lambda *_: pytest.fail("written"))
    for refused in (lambda: run.save(tmp_path / f"{name}.nc"), lambda: check_writable(tmp_path / name)):
        with pytest.raises(fp.InputError, match="expected a name that a file can have") as told:
            refused()
        assert str(told.value).isprintable()
    assert list(tmp_path.iterdir()) == []
