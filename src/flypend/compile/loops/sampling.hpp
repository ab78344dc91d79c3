// Samples of runs at the caller's times, from dense output.
#pragma once

#include "dense.hpp"
#include "transpose.hpp"

typedef T Lanes8 __attribute__((vector_size(8 * sizeof(T))));
typedef double Stored8 __attribute__((vector_size(8 * sizeof(double)), aligned(sizeof(double))));

// `length` vectors become one row of `length` doubles per lane.
static INLINE void turn(V *vectors, double *rows, int64_t length) {
    const int64_t whole = W % 8 ? 0 : length - length % 8;
    for (int64_t lane = 0; lane + 8 <= W; lane += 8)
        for (int64_t first = 0; first < whole; first += 8) {
            Row8 block[8];
            UNROLLED for (int64_t i = 0; i < 8; i++)
                block[i] = __builtin_convertvector(*(Lanes8 *)&entry(vectors, first + i, lane), Row8);
            transpose(block);
            UNROLLED for (int64_t i = 0; i < 8; i++) *(Stored8 *)(rows + (lane + i) * length + first) = block[i];
        }
    for (int64_t i = whole; i < length; i++)
        for (int64_t lane = 0; lane < W; lane++) rows[lane * length + i] = entry(vectors, i, lane);
}

// The caller's `count` increasing times, followed by infinity, and one row of states per run and time.
struct Sampler {
    Dense &dense;
    const double *times;
    int64_t count;
    double *samples, *rows;  // the caller's; (W, N), one state per lane
    const int64_t *run;      // of each lane
    L cursor;                // the next time of each lane, and
    V wanted;                // which it is, s

    INLINE void start(int64_t lane) {
        cursor[lane] = 0;
        wanted[lane] = T(times[0]);
    }

    INLINE double *place(int64_t lane) const { return samples + (run[lane] * count + cursor[lane]) * N; }

    // Store all samples within the accepted steps.
    INLINE void take(const Step &step, M accepted) {
        for (M due; any(due = accepted & (wanted <= step.t_new));) {
            dense.evaluate(step, wanted);
            turn(dense.state, rows, N);
            for (int64_t lane : Set(due)) copy(rows + lane * N, place(lane));
            cursor -= wide(due);
            wanted = due ? gathered(times, cursor, due) : wanted;
        }
    }

    // Copy a state, and prefetch the row after it.
    INLINE void copy(const double *from, double *to) const {
        const int64_t whole = N - N % 8;
        for (int64_t i = 0; i < whole; i += 8) {
            *(Stored8 *)(to + i) = *(const Stored8 *)(from + i);
            __builtin_prefetch(to + i + N, 1, 3);
        }
        for (int64_t i = whole; i < N; i++) to[i] = from[i];
    }

    // NaN where the run in `lane` did not come.
    INLINE void finish(int64_t lane) const {
        double *end = samples + (run[lane] + 1) * count * N;
        for (double *number = place(lane); number < end; number++) *number = __builtin_nan("");
    }
};
