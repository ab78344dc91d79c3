"""flypend's kernel, order 8."""

from functools import partial

from benchmarks.peers import Peer
from benchmarks.peers.a_flypend_dp5 import make

PEER = Peer("flypend dop853", "LLVM vectors, 8 lanes", partial(make, method="dop853"), 8192, threaded=True)
