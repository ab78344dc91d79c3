"""The same algorithm as C with vectors of eight lanes, order 8."""

from benchmarks.peers import Peer
from benchmarks.peers.c_generated_c import order_8

PEER = Peer("generated C, vectors, dop853", "g++ -O3, 8 lanes by GCC's vectors, same algorithm", order_8, 8192, True)
