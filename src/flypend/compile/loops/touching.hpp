// Whether the rod touches anything, looked at in each step's dense output at least every `LONGEST` seconds.
#pragma once

#include "contact.hpp"
#include "dense.hpp"

struct Touching : Contact {
    const Stages &stages;
    Dense &dense;
    V *before, *after;  // (N + 1) the state, followed by the thrust

    INLINE Touching(const Stages &stages, Dense &dense, V *before, V *after)
        : Contact{all(INFINITE), all(INFINITE)}, stages(stages), dense(dense), before(before), after(after) {}

    // Thrust at a `share` of the step, on the line between its ends.
    INLINE V thrust(V share) const {
        V first = stages.wrench(0)[0], last = stages.wrench(STAGES)[0];
        return first + share * (last - first);
    }

    static INLINE void put(V *memory, const V *state, V thrust) {
        copy(state, memory, N);
        memory[N] = thrust;
    }

    // Begin in the lanes `fresh`, in state S with stage 0; returns which touch there.
    INLINE M start(M fresh) {
        put(before, stages.S, stages.wrench(0)[0]);
        return Contact::start(fresh, before);
    }

    // Look at the accepted steps; returns which touch in them, and when.
    INLINE M take(const Step &step, M accepted, V &when) {
        V count = most(__builtin_elementwise_floor(step.h / T(LONGEST)) + 1, all(1)), place = all(1);
        put(before, stages.S, stages.wrench(0)[0]);
        when = step.t_new;
        M open = accepted;
        for (M going; any(going = open & (place <= count)); place += 1) {
            V share = least(place / count, all(1)), interval = step.h / count, found;
            dense.evaluate(step, step.t + share * step.h);
            put(after, dense.state, thrust(share));
            M touched = look(going, before, after, interval, found);
            when = touched ? step.t + (place - 1 + found) * interval : when;
            open &= ~touched;
            copy(after, before, N + 1);
        }
        return accepted & ~open;
    }
};
