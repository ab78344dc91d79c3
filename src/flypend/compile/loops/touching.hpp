// Whether the rod touches anything, looked at in each step's dense output at least every `LONGEST` seconds.
#pragma once

#include "dense.hpp"

// Least distance in each lane's flight, and the part that is touched. Distances within an interval are evaluated where
// their lower bound falls below the least so far: branch and bound.
struct Touching {
    const Stages &stages;
    Dense &dense;
    V *before, *after;  // (N + 1) the state, followed by the thrust
    V distance, part;   // the least of the flight, m; the part touched, -1 for none

    // Thrust at a `share` of the step, on the line between its ends.
    INLINE V thrust(V share) const {
        V first = stages.wrench(0)[0], last = stages.wrench(STAGES)[0];
        return first + share * (last - first);
    }

    static INLINE void put(V *memory, const V *state, V thrust) {
        for (int64_t i = 0; i < N; i++) memory[i] = state[i];
        memory[N] = thrust;
    }

    // Begin in the lanes `fresh`, in state S with stage 0; returns which touch there.
    INLINE M start(M fresh) {
        put(before, stages.S, stages.wrench(0)[0]);
        distance = fresh ? all(INFINITE) : distance;
        part = fresh ? all(-1) : part;
        V found[3], seconds{};
        touching(before, before, &seconds, found);
        return record(fresh, found);
    }

    // Look at the accepted steps; returns which touch in them, and when.
    INLINE M take(const Step &step, M accepted, V &when) {
        V count = most(__builtin_elementwise_floor(step.h / T(LONGEST)) + 1, all(1)), place = all(1);
        put(before, stages.S, stages.wrench(0)[0]);
        when = step.t_new;
        M open = accepted;
        for (M going; any(going = open & (place <= count)); place += 1) {
            V share = least(place / count, all(1)), interval = step.h / count;
            dense.evaluate(step, step.t + share * step.h);
            put(after, dense.state, thrust(share));
            V bound, found[3] = {all(INFINITE), all(INFINITE), all(INFINITE)};
            room(before, after, &interval, &bound);
            M near = going & (bound < distance);
            if (any(near)) touching(before, after, &interval, found);
            M touched = record(near, found);
            when = touched ? step.t + (place - 1 + found[1]) * interval : when;
            open &= ~touched;
            for (int64_t i = 0; i <= N; i++) before[i] = after[i];
        }
        return accepted & ~open;
    }

    // Record what is `found` in the lanes `here`: distance, share until the rod touches (> 1 if not), part.
    INLINE M record(M here, const V *found) {
        M touched = here & (found[1] <= 1);
        distance = here ? least(found[0], distance) : distance;
        part = touched ? found[2] : part;
        return touched;
    }
};
