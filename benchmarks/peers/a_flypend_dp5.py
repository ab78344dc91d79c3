"""flypend's kernel, order 5."""

from benchmarks.peers import Fly, Peer


def make(problem, threads: int, method: str = "dp5") -> Fly:
    """The compiled kernel, nothing judged and nothing kept but the final state."""
    from flypend.flight.kernels import ideal_kernel
    from flypend.flight.request import Tolerances

    kernel = ideal_kernel(problem.loop, method=method)
    return lambda starts, rtol: kernel.fly(starts, problem.duration, Tolerances(rtol=rtol), workers=threads).final


PEER = Peer("flypend dp5", "LLVM vectors, 8 lanes", make, 8192, threaded=True)
