// Normal random numbers by themselves, as many ticks at a time as there are lanes.
#include "random.hpp"

extern "C" {
extern const int64_t COUNT;  // of a tick, in whole blocks of four

// Row i of `out` (rows, COUNT, W) has the numbers of the ticks `first` + i W …, one per lane.
void kernel(uint64_t seed, int64_t first, int64_t rows, double *out) {
    U tick{};
    EACH_LANE tick[lane] = uint64_t(first + lane);
    V drawn[COUNT];
    for (int64_t row = 0; row < rows; row++, tick += W) {
        normals(U{} + seed, tick, 0, COUNT, drawn);
        for (int64_t i = 0; i < COUNT * W; i++) out[row * COUNT * W + i] = ((T *)drawn)[i];
    }
}
}
