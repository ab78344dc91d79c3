// The stages of one embedded Runge-Kutta step in every lane, and its error estimate.
#pragma once

#include "open.hpp"

struct Step {
    V t, h, t_new;  // `h` from `t`; the end, which `t + h` may miss by rounding
};

// A step from S to Y with parameters P. Stage j has the rates K + j N and the wrench w + j WRENCH.
struct Stages {
    V *S, *Y, *P, *K, *w;

    INLINE V *k(int64_t j) const { return K + j * N; }
    INLINE V *wrench(int64_t j) const { return w + j * WRENCH; }

    // k_j = f(t, Y)
    INLINE void evaluate(V t, int64_t j) const { rates(&t, Y, P, k(j), wrench(j)); }

    // Entry i of Σ_j w_j k_j.
    INLINE V weighted(const double *weights, int64_t count, int64_t i) const {
        V sum{};
        UNROLLED for (int64_t j = 0; j < count; j++)
            if (weights[j] != 0) sum += T(weights[j]) * K[j * N + i];
        return sum;
    }

    // Y = S + h Σ_j w_j k_j
    INLINE void combine(const double *weights, int64_t count, V h) const {
        for (int64_t i = 0; i < N; i++) Y[i] = S[i] + h * weighted(weights, count, i);
    }

    // k_0 = f(t, S) in `lanes`; the others keep every bit.
    INLINE void start(V t, M lanes) const {
        rates(&t, S, P, k(STAGES), wrench(STAGES));
        carry(lanes);
    }

    // The last stage, at the end of a step, is stage 0 of the next.
    INLINE void carry(M lanes) const {
        for (int64_t i = 0; i < N; i++) replace(K[i], lanes, k(STAGES)[i]);
        for (int64_t i = 0; i < WRENCH; i++) replace(w[i], lanes, wrench(STAGES)[i]);
    }

    // Compute the stages and Y. Returns the error in tolerances (accept if <= 1); `largest` is that of |Y|.
    INLINE V attempt(V t, V h, V rtol, V atol, V &largest) const {
        UNROLLED for (int64_t s = 1; s < STAGES; s++) {
            combine(A + s * STAGES, STAGES, h);
            evaluate(t + T(C[s]) * h, s);
        }
        combine(B, STAGES, h);
        if (USES_END) evaluate(t + h, STAGES);
        return error(h, rtol, atol, largest);
    }

    INLINE V error(V h, V rtol, V atol, V &largest) const {
        constexpr int64_t STRANDS = 4;  // independent partial sums hide the latency of the additions
        V first[STRANDS], second[STRANDS], peak[STRANDS];
        UNROLLED for (int64_t k = 0; k < STRANDS; k++) first[k] = second[k] = peak[k] = V{};
        for (int64_t i = 0; i < N; i += STRANDS) {
            UNROLLED for (int64_t k = 0; k < STRANDS; k++) {
                V before = size(S[i + k]), after = size(Y[i + k]);
                V scale = 1 / (atol + rtol * most(before, after));
                peak[k] = most(after, peak[k]);
                V part = weighted(E, STAGES + 1, i + k) * scale;
                first[k] += part * part;
                if (ESTIMATES == 2) {
                    part = weighted(E + STAGES + 1, STAGES + 1, i + k) * scale;
                    second[k] += part * part;
                }
            }
        }
        largest = most(most(peak[0], peak[1]), most(peak[2], peak[3]));
        V sum = (first[0] + first[1]) + (first[2] + first[3]);
        if (ESTIMATES == 1) return h * root(sum / T(N));
        // Hairer, Nørsett, Wanner: Solving Ordinary Differential Equations I, II.10
        V joined = sum + T(0.01) * ((second[0] + second[1]) + (second[2] + second[3]));
        return joined > 0 ? h * sum / root(joined * T(N)) : joined;
    }
};
