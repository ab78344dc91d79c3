"""The same algorithm as plain C, one run after the other."""

from benchmarks.peers import Peer
from benchmarks.peers.c_generated_c import scalar

PEER = Peer("generated C, scalar, dp5", "g++ -O3, one run at a time, same algorithm", scalar, 2048, threaded=True)
