// How close the rod comes to what its mount lets it touch: branch and bound.
#pragma once

#include "lanes.hpp"

extern "C" {
// Programs: a lower bound of the distances between two states, m; the least of them, the share of the interval until the
// rod touches (> 1 if it does not), and the part it touches.
void room(const V *before, const V *after, const V *seconds, V *bound);
void touching(const V *before, const V *after, const V *seconds, V *distance_share_part);
}

struct Contact {
    V distance, part;  // the least of the flight, m; the part touched, -1 for none

    // Begin at `state` in the lanes `fresh`; returns which touch there.
    INLINE M start(M fresh, const V *state) {
        distance = fresh ? all(INFINITE) : distance;
        part = fresh ? all(-1) : part;
        V found[3], seconds{};
        touching(state, state, &seconds, found);
        return record(fresh, found);
    }

    // Look between two states in the lanes `here`, where the lower bound falls below the least distance so far. Returns
    // which touch, and at which `share` of the interval; the share is valid for them alone.
    INLINE M look(M here, const V *before, const V *after, V seconds, V &share) {
        V bound, found[3] = {all(INFINITE), all(INFINITE), all(INFINITE)};
        room(before, after, &seconds, &bound);
        M near = here & (bound < distance);
        if (any(near)) touching(before, after, &seconds, found);
        share = found[1];
        return record(near, found);
    }

    INLINE M record(M here, const V *found) {
        M touched = here & (found[1] <= 1);
        distance = here ? least(found[0], distance) : distance;
        part = touched ? found[2] : part;
        return touched;
    }

    INLINE void store(int64_t lane, double &least_distance, int64_t &touched) const {
        least_distance = distance[lane];
        touched = int64_t(part[lane]);
    }
};
