// Logarithm, sine, cosine and inverse root of all lanes at once, to 1.5 ulp on doubles.
//
// The C library would take one lane at a time; it still does for unusual arguments and for floats. Root and division take
// three times as long as the estimate of an inverse root and a series.
#pragma once

#include "lanes.hpp"

extern "C" {
extern const int64_t FUSES;  // whether the processor computes a b + c with one rounding
double log(double);
double sin(double);
double cos(double);
float logf(float);
float sinf(float);
float cosf(float);
V multiply_add(V, V, V) __asm__("llvm.fma.v" TEXT(WIDTH) "f" TEXT(BITS));
}

// Nothing may be reordered or fused beyond what is written.
#define EXACTLY _Pragma("clang fp reassociate(off) contract(off)")

// a b + c, rounded once where the processor can
static INLINE V fused(V a, V b, V c) {
    EXACTLY
    if (!FUSES) return a * b + c;
    if constexpr (W == 1) return V{T(__builtin_fma(a[0], b[0], c[0]))};
    else return multiply_add(a, b, c);
}

// Σ c_i z^i from i = `first` on, over z^first
template <int64_t N> static INLINE V series(const double (&c)[N], V z, int64_t first = 0) {
    V sum = all(T(c[N - 1]));
    UNROLLED for (int64_t i = N - 2; i >= first; i--) sum = fused(sum, z, all(T(c[i])));
    return sum;
}

static INLINE V by_library(V x, T (*function)(T)) {
    EACH_LANE x[lane] = function(x[lane]);
    return x;
}

#if BITS == 64
// 2 atanh(s) = s Σ c_i s^(2i): with |s| <= 3 − √8 the first term left out is 1e-17 of the first.
constexpr double LOGARITHM[] = {2., 2. / 3, 2. / 5, 2. / 7, 2. / 9, 2. / 11, 2. / 13, 2. / 15, 2. / 17, 2. / 19, 2. / 21};
// sin r = r Σ …, cos r = Σ … in r²: with |r| <= π/4 the first term left out is below 1e-17.
constexpr double SINE[] = {1., -1. / 6, 1. / 120, -1. / 5040, 1. / 362880, -1. / 39916800, 1. / 6227020800,
                           -1. / 1307674368000};
constexpr double COSINE[] = {1., -1. / 2, 1. / 24, -1. / 720, 1. / 40320, -1. / 3628800, 1. / 479001600,
                             -1. / 87178291200, 1. / 20922789888000};
// π/2 in three parts, each rounded to what the ones before leave of it; up to FAR, rad, they are enough.
constexpr double HALF_PI[] = {1.5707963267948966, 6.123233995736766e-17, -1.4973849048591833e-33};
constexpr double FAR = 1e5;
constexpr double LOG_2[] = {0x1.62e42fep-1, 1.8206359985041462e-09};  // the first has 28 bits: k times it is exact

// Of positive, finite, normal x = 2^k m with m in [√½, √2): log m = 2 atanh(s) with s = (m − 1)/(m + 1).
static INLINE V log_of_normal(V x) {
    EXACTLY
    constexpr int64_t ROOT_HALF = 0x3FE6A09E667F3BCD, ONE = int64_t(1) << 52;  // bits of √½; of the exponent's unit
    const L bits = (L)x, k = (bits - ROOT_HALF) >> 52;
    const V f = (V)(bits - k * ONE) - 1, s = f / (f + 2), z = s * s, n = __builtin_convertvector(k, V);
    // 2s = f − s f, and adding the small parts first keeps the last bits of f.
    const V rest = s * fused(z, series(LOGARITHM, z, 1), -f);
    return n * LOG_2[0] + (f + fused(n, all(LOG_2[1]), rest));
}

// Sine and cosine of r + quarters π/2, where |r| <= π/4 and the quarters are whole numbers
static INLINE void turned(V r, V quarters, V &sine, V &cosine) {
    EXACTLY
    const V z = r * r, s = fused(r * z, series(SINE, z, 1), r), c = fused(z, series(COSINE, z, 1), all(1));
    const L k = __builtin_convertvector(quarters, L);
    const M odd = narrow((k & 1) != 0), negative = narrow((k & 2) != 0), next = narrow((k + 1 & 2) != 0);
    const V first = odd ? c : s, second = odd ? s : c;
    sine = negative ? -first : first, cosine = next ? -second : second;
}

// Of any angle, rad
static INLINE M turned_by(V x, V &sine, V &cosine) {
    EXACTLY
    const M usual = size(x) < FAR;
    V r = usual ? x : V{};
    const V quarters = nearest(r * (2 / 3.141592653589793));
    UNROLLED for (double part : HALF_PI) r = fused(quarters, all(-part), r);
    turned(r, quarters, sine, cosine);
    return usual;
}
#endif

#if BITS == 64 && WIDTH % 8 == 0
typedef double Eight __attribute__((vector_size(64)));
extern "C" Eight estimated(Eight, Eight, uint8_t) __asm__("llvm.x86.avx512.rsqrt14.pd.512");

// 1/√x where an instruction estimates it for eight doubles. With the estimate r and e = 1 − x r², below 2⁻¹², it is
// r (1 − e)^(−1/2); the first term left out is (35/128) e⁴.
static INLINE V by_estimate(V x) {
    EXACTLY
    constexpr double ROOT[] = {1. / 2, 3. / 8, 5. / 16};
    V r;
    UNROLLED for (int64_t part = 0; part < W; part += 8) {
        Eight eight;
        UNROLLED for (int64_t i = 0; i < 8; i++) eight[i] = x[part + i];
        eight = estimated(eight, eight, 0xFF);
        UNROLLED for (int64_t i = 0; i < 8; i++) r[part + i] = eight[i];
    }
    const V e = fused(-(x * r), r, all(1)), refined = fused(r * e, series(ROOT, e), r);
    return e == e ? refined : r;  // 1/√0 = ∞ and 1/√∞ = 0
}
#endif
