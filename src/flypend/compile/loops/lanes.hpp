// Vectors with one number per lane, and what the loops do with them beyond + − × ÷ and comparisons.
// The build chooses WIDTH, the number of lanes, and BITS, 64 or 32, of a number.
#pragma once

#include <stdint.h>

constexpr int64_t W = WIDTH;
#if BITS == 64
typedef double T;
#else
typedef float T;
#endif
typedef T V __attribute__((vector_size(W * sizeof(T))));              // one number per lane
typedef int64_t L __attribute__((vector_size(W * sizeof(int64_t))));  // one index per lane
typedef decltype(V() < V()) M;                                        // a mask: all bits of a lane, or none

constexpr T INFINITE = __builtin_huge_val();

// Programs are linked at run time and stay functions; all else becomes part of the one loop.
#define INLINE inline __attribute__((always_inline))
#define OUTLINE static __attribute__((noinline))  // what several places call, but rarely
#define WITHIN __attribute__((always_inline))  // a lambda
#define EACH_LANE _Pragma("clang loop unroll(full)") for (int64_t lane = 0; lane < W; lane++)
#define UNROLLED _Pragma("clang loop unroll(full)")

static INLINE V all(T number) { return V{} + number; }

static INLINE V least(V a, V b) { return a < b ? a : b; }  // b if either is NaN
static INLINE V most(V a, V b) { return a > b ? a : b; }

static INLINE V size(V x) { return __builtin_elementwise_abs(x); }

#define TEXT_OF(token) #token
#define TEXT(macro) TEXT_OF(macro)
// clang 14 has no other names for them. Of one lane, since x86 would pass that as an integer, it has.
extern "C" V square_root(V) __asm__("llvm.sqrt.v" TEXT(WIDTH) "f" TEXT(BITS));
extern "C" V nearby(V) __asm__("llvm.nearbyint.v" TEXT(WIDTH) "f" TEXT(BITS));
static INLINE V root(V x) {
    if constexpr (W == 1) return V{T(__builtin_sqrt(x[0]))};
    else return square_root(x);
}
static INLINE V nearest(V x) {  // whole number; ties to even
    if constexpr (W == 1) return V{T(__builtin_nearbyint(x[0]))};
    else return nearby(x);
}

// x > 0 to a power, to a few per cent: the bit pattern of a number approximates its logarithm.
static INLINE V power(V x, T exponent) {
    const T one = T(sizeof(T) == 8 ? int64_t(0x3FF) << 52 : int64_t(0x7F) << 23);
    V logarithm = __builtin_convertvector((M)x, V) - one;
    return (V) __builtin_convertvector(logarithm * exponent + one, M);
}

static INLINE bool any(M mask) { return __builtin_reduce_or(mask != 0) != 0; }
static INLINE L wide(M mask) { return __builtin_convertvector(mask, L); }
static INLINE M narrow(L mask) { return __builtin_convertvector(mask, M); }
static INLINE M none() { return M{}; }
static INLINE M every() { return ~M{}; }

// Replace a vector in memory in some lanes. Volatile, or else LLVM makes a masked store of it, which on AMD's
// processors with AVX2 costs the kernel 5 % of its time.
static INLINE void replace(V &vector, M lanes, V by) { *(volatile V *)&vector = lanes ? by : vector; }

// Numbers of a table at one place per lane; 0 outside of `lanes`, where a place may be anything.
static INLINE V gathered(const double *table, L place, M lanes) {
    place = wide(lanes) ? place : L{};
    V result{};
    EACH_LANE result[lane] = T(table[place[lane]]);
    return lanes ? result : V{};
}

// Whether an entry is infinite or NaN.
static INLINE M undefined(const V *vector, int64_t length) {
    V sum{};
    for (int64_t i = 0; i < length; i++) sum += 0 * vector[i];
    return ~(sum == 0);
}

// Whether the length of a vector exceeds a limit or is NaN.
static INLINE M far(const V *vector, int64_t length, T limit) {
    V sums[4] = {};  // independent partial sums hide the latency of the additions
    UNROLLED for (int64_t i = 0; i < length; i++) sums[i % 4] += vector[i] * vector[i];
    return ~((sums[0] + sums[1]) + (sums[2] + sums[3]) < limit * limit);
}

// The lanes of a mask, in turn: for (int64_t lane : Set(mask)) …
struct Set {
    uint64_t left;
    INLINE explicit Set(M mask) {
        L bit{};
        EACH_LANE bit[lane] = int64_t(1) << lane;
        left = uint64_t(__builtin_reduce_or(wide(mask) & bit));
    }
    INLINE Set begin() const { return *this; }
    INLINE int64_t end() const { return 0; }
    INLINE bool operator!=(int64_t) const { return left != 0; }
    INLINE void operator++() { left &= left - 1; }
    INLINE int64_t operator*() const { return __builtin_ctzll(left); }
};

static INLINE int64_t some(int64_t length) { return length + (length == 0); }  // no array may be empty

static INLINE void copy(const V *from, V *to, int64_t length) {
    for (int64_t i = 0; i < length; i++) to[i] = from[i];
}

// One lane of vectors in memory, and rows of the caller's arrays.
static INLINE T &entry(V *vectors, int64_t i, int64_t lane) { return ((T *)vectors)[i * W + lane]; }

template <class Number> static INLINE void from_row(const Number *row, V *vectors, int64_t lane, int64_t length) {
    for (int64_t i = 0; i < length; i++) entry(vectors, i, lane) = T(row[i]);
}

template <class Number> static INLINE void into_row(V *vectors, int64_t lane, Number *row, int64_t length) {
    for (int64_t i = 0; i < length; i++) row[i] = Number(entry(vectors, i, lane));
}
