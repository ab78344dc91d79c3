// Samples of sampled flights: kept, reduced by a criterion, or both.
#pragma once

#include "sampled.hpp"

// Of a value over the samples: its maximum, where NaN counts as infinity; its mean over time, by the trapezoidal rule; the
// time of the last sample above 0 or NaN, -1 if none; the time from which all samples are at most 0 (a settling time),
// infinite if the last one is not.
enum { MAX, MEAN, LAST, SINCE };

#define EACH_VALUE UNROLLED for (int64_t i = 0; i < VALUES; i++)

struct Reductions {
    V *sums, *before;  // (VALUES) so far; at the last sample
    V *clock;          // (3) the times of the last and of the first sample; 1 once there is one

    static INLINE int64_t length() { return 2 * VALUES + 3; }
    INLINE explicit Reductions(V *memory) : sums(memory), before(memory + VALUES), clock(memory + 2 * VALUES) {}

    INLINE void begin() const {
        EACH_VALUE sums[i] = all(KINDS[i] == MAX ? -INFINITE : KINDS[i] == LAST ? -1 : KINDS[i] == SINCE ? INFINITE : 0);
        EACH_VALUE before[i] = V{};
        for (int64_t i = 0; i < 3; i++) clock[i] = V{};
    }

    // Add the samples at `time`, in the lanes `here`.
    INLINE void add(M here, V time, const V *state, const V *gains, V *values) const {
        judge(&time, state, gains, values);
        M begun = clock[2] > 0;
        V half = T(0.5) * (time - clock[0]);
        EACH_VALUE {
            V value = values[i], sum = sums[i], after;
            M out = ~(value <= 0);
            if (KINDS[i] == MAX) after = value <= sum ? sum : value >= sum ? value : all(INFINITE);
            else if (KINDS[i] == MEAN) after = begun ? sum + half * (before[i] + value) : V{};
            else if (KINDS[i] == LAST) after = out ? time : sum;
            else after = out ? all(INFINITE) : least(time, sum);
            if (KINDS[i] == MEAN) before[i] = here ? value : before[i];
            sums[i] = here ? after : sum;
        }
        clock[1] = here & ~begun ? time : clock[1];
        clock[0] = here ? time : clock[0];
        clock[2] = here ? all(1) : clock[2];
    }

    INLINE void store(int64_t lane, double *row) const {
        T elapsed = clock[0][lane] - clock[1][lane];
        EACH_VALUE {
            T sum = sums[i][lane];
            row[i] = KINDS[i] != MEAN ? sum : elapsed > 0 ? sum / elapsed : before[i][lane];
        }
    }
};

// The caller's increasing sample ticks: whether each is judged, and how many rows are kept before it.
struct Ticks {
    const int64_t *ticks;
    int64_t count;
    const int64_t *judged, *rows;
    int64_t row_count;
    double *samples;  // (runs, row_count, length)
    int64_t cursor;

    INLINE bool due(int64_t tick) const { return cursor < count && ticks[cursor] == tick; }
    INLINE bool judge_now() const { return judged[cursor] != 0; }

    // Go to the next tick; keep the `state` of the runs from `first` on if this one is kept.
    INLINE void pass(V *state, int64_t length, int64_t first, int64_t runs) {
        int64_t row = rows[cursor++];
        if (rows[cursor] <= row) return;  // always, if the caller keeps none
        for (int64_t lane = 0; lane < W && first + lane < runs; lane++)
            into_row(state, lane, samples + ((first + lane) * row_count + row) * length, length);
    }
};
