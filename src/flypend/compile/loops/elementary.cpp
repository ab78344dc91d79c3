// The elementary functions that programs call, by names that end with the kind of their vectors.
#include "elementary.hpp"

#define NAMED(name) __asm__(name "." TEXT(WIDTH) "x" TEXT(BITS))
extern "C" {
V logarithm(V) NAMED("logarithm");
V sine(V) NAMED("sine");
V cosine(V) NAMED("cosine");
V inverse_root(V) NAMED("inverse_root");

#if BITS == 64
WITHIN V logarithm(V x) {
    const M usual = (x >= 0x1p-1022) & (x < INFINITE);
    V result = log_of_normal(x);
    if (any(~usual)) result = usual ? result : by_library(x, log);
    return result;
}

WITHIN V sine(V x) {
    V result, other;
    const M usual = turned_by(x, result, other);
    if (any(~usual)) result = usual ? result : by_library(x, sin);
    return result;
}

WITHIN V cosine(V x) {
    V result, other;
    const M usual = turned_by(x, other, result);
    if (any(~usual)) result = usual ? result : by_library(x, cos);
    return result;
}
#else
WITHIN V logarithm(V x) { return by_library(x, logf); }
WITHIN V sine(V x) { return by_library(x, sinf); }
WITHIN V cosine(V x) { return by_library(x, cosf); }
#endif

#if BITS == 64 && WIDTH % 8 == 0
WITHIN V inverse_root(V x) { return by_estimate(x); }
#endif
}
