// A block of 8 × 8 doubles, transposed in registers.
#pragma once

#include "lanes.hpp"

typedef double Row8 __attribute__((vector_size(8 * sizeof(double))));

// Swap blocks of S × S beside the diagonal.
template <int S> static INLINE void swap_blocks(Row8 *row) {
#define LOW(k) ((k) & S ? 8 + (k) - S : (k))
#define HIGH(k) ((k) & S ? 8 + (k) : (k) + S)
    UNROLLED for (int64_t i = 0; i < 8; i++) {
        if (i & S) continue;
        const Row8 a = row[i], b = row[i + S];
        row[i] = __builtin_shufflevector(a, b, LOW(0), LOW(1), LOW(2), LOW(3), LOW(4), LOW(5), LOW(6), LOW(7));
        row[i + S] = __builtin_shufflevector(
            a, b, HIGH(0), HIGH(1), HIGH(2), HIGH(3), HIGH(4), HIGH(5), HIGH(6), HIGH(7));
    }
#undef LOW
#undef HIGH
}

static INLINE void transpose(Row8 *row) { swap_blocks<1>(row), swap_blocks<2>(row), swap_blocks<4>(row); }
