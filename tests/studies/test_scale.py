"""Studies on many workers: whoever flies a chunk, its bits are the same."""

from concurrent.futures.process import BrokenProcessPool

import numpy as np
import pytest

import flypend as fp
from flypend.studies.sweep.store import find_store

# Everything random that there is: starts, noise and gusts, judged, in several chunks.
STUDY = {
    "vehicle": "hehn2011", "law": {"name": "lqr"}, "duration": 0.2, "runs": 50, "chunk": 8, "final": True,
    "criterion": {"hold": 0.1},
    "plant": {
        "base": "rotors", "rate": 100.0, "noise": {"x": 0.01, "omega": 0.1, "y": 0.01}, "wind": {"gust_on_bob": 0.02}
    },
    "vary": {"start": {"omega": {"ball": 1.0}, "x_dot": {"ball": 0.5}}},
    "start": {"y": [0.0, 0.0, 1.0]},
}  # fmt: skip


def columns(path):
    """The bytes of every column of a store, chunk by chunk."""
    store = find_store(path)
    return {
        (name, k): np.asarray(values).tobytes()
        for k in range(store.study.chunks)
        for name, values in store.read(k).items()
    }


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The store that one thread of this process writes."""
    path = tmp_path_factory.mktemp("alone") / "a.zarr"
    fp.sweep(STUDY, path, workers=1)
    found = columns(path)
    efforts = np.concatenate([np.frombuffer(found["effort", k], dtype=np.float32) for k in range(7)])
    assert len(np.unique(efforts)) == 50  # no run is another's
    return found


def test_worker_processes_of_this_machine_write_the_same_bytes(alone, tmp_path):
    fp.sweep(STUDY, tmp_path / "a.zarr", workers=2, processes=True)
    assert columns(tmp_path / "a.zarr") == alone


def test_workers_of_a_dask_cluster_in_processes_of_their_own_write_the_same_bytes(alone, tmp_path):
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, protocol="tcp", host="127.0.0.1",
        dashboard_address="127.0.0.1:0", memory_limit=0, silence_logs=50,
    ) as cluster:  # fmt: skip
        fp.sweep(STUDY, tmp_path / "a.zarr", scheduler=cluster.scheduler_address)
    assert columns(tmp_path / "a.zarr") == alone


def test_processes_that_die_again_and_again_are_told_in_one_sentence(tmp_path, monkeypatch):
    def dying(*_):
        raise BrokenProcessPool("A process was terminated. Look elsewhere for the reason.")
        yield

    monkeypatch.setattr("flypend.studies.sweep.run._fly_numbers", dying)
    with pytest.raises(fp.InputError, match=r"^processes: .*, got A process was terminated$"):
        fp.sweep(STUDY, tmp_path / "a.zarr", workers=2, processes=True)
