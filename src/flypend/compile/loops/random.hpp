// Counter-based random numbers: the draws of a tick depend on seed and tick only, not on their order.
#pragma once

#include "elementary.hpp"

typedef uint64_t U __attribute__((vector_size(W * sizeof(uint64_t))));  // 32 random bits per lane

// Philox4x32-10 (Salmon and others 2011, "Parallel random numbers: as easy as 1, 2, 3").
struct Philox {
    U word[4];  // the counter, then four random words

    INLINE void mix(U key_0, U key_1) {
        constexpr uint64_t LOW = 0xFFFFFFFF;
        UNROLLED for (uint64_t turn = 0; turn < 10; turn++) {
            const U a = word[0] * 0xD2511F53, b = word[2] * 0xCD9E8D57;
            const U k = (key_0 + (turn * 0x9E3779B9 & LOW)) & LOW, l = (key_1 + (turn * 0xBB67AE85 & LOW)) & LOW;
            word[0] = (b >> 32) ^ word[1] ^ k, word[2] = (a >> 32) ^ word[3] ^ l;
            word[1] = b & LOW, word[3] = a & LOW;
        }
    }
};

// Block number `block` of the four numbers of each lane's seed and tick, uniform in (0, 1).
static INLINE void uniform_block(U seed, U tick, int64_t block, V *out) {
    constexpr uint64_t LOW = 0xFFFFFFFF;
    Philox words{{U{} + uint64_t(block), tick & LOW, tick >> 32, U{}}};
    words.mix(seed & LOW, seed >> 32);
    UNROLLED for (int64_t i = 0; i < 4; i++)
        out[i] = (__builtin_convertvector(words.word[i], V) + T(0.5)) * T(0x1p-32);
}

// Two normal numbers from two uniform ones: √(−2 log u) cos 2πv and … sin 2πv (Box and Muller 1958).
static INLINE void box_muller(V u, V v, V *out) {
    V sine, cosine, quarters = nearest(4 * v);
    V angle = T(2 * 3.141592653589793) * (v - T(0.25) * quarters);  // the difference is exact
    turned(angle, quarters, sine, cosine);
    const V radius = root(-2 * log_of_normal(u));
    out[0] = radius * cosine, out[1] = radius * sine;
}

// The numbers from `first` to `end` − 1 of each lane's seed and tick, in whole blocks of four, to their places in `out`.
static INLINE void uniforms(U seed, U tick, int64_t end, V *out) {
    for (int64_t block = 0; 4 * block < end; block++) uniform_block(seed, tick, block, out + 4 * block);
}

// A function of its own, so that the numbers are the same in all loops, to the bit.
OUTLINE void normals(U seed, U tick, int64_t first, int64_t end, V *out) {
    for (int64_t block = first / 4; 4 * block < end; block++) {
        V uniform[4];
        uniform_block(seed, tick, block, uniform);
        UNROLLED for (int64_t i = 0; i < 4; i += 2) box_muller(uniform[i], uniform[i + 1], out + 4 * block + i);
    }
}
