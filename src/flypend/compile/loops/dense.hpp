// Dense output: the state at any time within a step, from the stages of the step.
#pragma once

#include "stages.hpp"

// Σ_p c_p x^p with four coefficients.
static INLINE V polynomial(const double *c, V x) { return ((T(c[3]) * x + T(c[2])) * x + T(c[1])) * x + T(c[0]); }

// The additional stages overwrite Y, which is restored; `moved` is Y − S.
OUTLINE void more_stages(const Stages stages, V t, V h, V *end, V *moved) {
    const int64_t count = STAGES + 1 + EXTRA;
    for (int64_t i = 0; i < N; i++) end[i] = stages.Y[i];
    for (int64_t i = 0; i < N; i++) moved[i] = stages.Y[i] - stages.S[i];
    UNROLLED for (int64_t extra = 0; extra < EXTRA; extra++) {
        stages.combine(A_EXTRA + extra * count, count, h);
        stages.evaluate(t + T(C_EXTRA[extra]) * h, STAGES + 1 + extra);
    }
    for (int64_t i = 0; i < N; i++) stages.Y[i] = end[i];
}

// The sum of S and the stages, weighted by polynomials in θ = (time − t)/h, then projected.
struct Dense {
    const Stages &stages;
    V *state, *moved, *end, *weight;
    bool ready;  // whether the additional stages of this step are there

    INLINE void begin() { ready = false; }

    // state = that at `time` within `step`
    INLINE void evaluate(const Step &step, V time) {
        if (EXTRA && !ready) more_stages(stages, step.t, step.h, end, moved);
        ready = true;
        V theta = (time - step.t) / step.h;
        if (EXTRA) dop853(step, theta);
        else dp5(step, theta);
        onto(state, state);
    }

    // s(θ) = S + h Σ_j (Σ_p P_jp θ^(p+1)) k_j
    INLINE void dp5(const Step &step, V theta) {
        UNROLLED for (int64_t j = 0; j <= STAGES; j++) weight[j] = step.h * theta * polynomial(DENSE + 4 * j, theta);
        for (int64_t i = 0; i < N; i++) {
            V value = stages.S[i];
            UNROLLED for (int64_t j = 0; j <= STAGES; j++) {
                const double *row = DENSE + 4 * j;
                if (row[0] != 0 || row[1] != 0 || row[2] != 0 || row[3] != 0) value += weight[j] * stages.K[j * N + i];
            }
            state[i] = value;
        }
    }

    // s(θ) = S + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + …)))), F₀ = Y − S, F₁ = h k₀ − F₀, F₂ = 2 F₀ − h (k₀ + k_s);
    // F₃ to F₆ are weighted sums of the stages.
    INLINE void dop853(const Step &step, V theta) {
        const int64_t count = STAGES + 1 + EXTRA;
        V factor[7] = {theta};  // of F₀, F₁, …
        UNROLLED for (int64_t row = 1; row < 7; row++) factor[row] = factor[row - 1] * (row % 2 ? 1 - theta : theta);
        UNROLLED for (int64_t j = 0; j < count; j++) {
            V sum{};
            if (j == 0) sum = factor[1] - factor[2];
            if (j == STAGES) sum = -factor[2];
            UNROLLED for (int64_t row = 0; row < 4; row++) sum += T(DENSE[row * count + j]) * factor[3 + row];
            weight[j] = step.h * sum;
        }
        V whole = factor[0] - factor[1] + 2 * factor[2];
        for (int64_t i = 0; i < N; i++) {
            V value = stages.S[i] + whole * moved[i];
            UNROLLED for (int64_t j = 0; j < count; j++) {
                const double *d = DENSE + j;
                bool used = d[0] != 0 || d[count] != 0 || d[2 * count] != 0 || d[3 * count] != 0;
                if (used || j == 0 || j == STAGES) value += weight[j] * stages.K[j * N + i];
            }
            state[i] = value;
        }
    }
};
