// A loop over the stages of a horizon. What a stage writes, later ones may read.
#pragma once

#include "lanes.hpp"

typedef V Row __attribute__((aligned(sizeof(T))));  // numbers that follow each other in memory

extern "C" {
extern const int64_t ARRAYS, BACKWARD;
extern const double STRIDES[];  // of each array, from a stage to the next, in numbers; 0 for what all stages share
}

// Where the arrays of the caller are at stage `k`.
static INLINE void find(T *const *arrays, int64_t k, T **here) {
    UNROLLED for (int64_t a = 0; a < ARRAYS; a++) here[a] = arrays[a] + k * int64_t(STRIDES[a]);
}

// Call `stage(here)` at `count` stages from the `first` on, the last of them first if BACKWARD.
template <class Stage> static INLINE void each_stage(int64_t first, int64_t count, T *const *arrays, Stage stage) {
    T *here[ARRAYS];
    for (int64_t i = 0; i < count; i++) {
        find(arrays, first + (BACKWARD ? count - 1 - i : i), here);
        stage(here);
    }
}
