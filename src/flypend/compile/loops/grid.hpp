// The times at which runs are judged, and how far each lane has come.
#pragma once

#include "open.hpp"

// Increasing times, ending with infinity, and a table that finds the place of a time among them: entry b of `bins` is
// at most the number of times up to b / rate.
struct Grid {
    const double *times, *bins;
    T rate, last_bin;
    L cursor, before;  // times passed: now, and before this step

    INLINE V time(L place, M lanes) const { return gathered(times, place, lanes); }
    INLINE L latest() const { return cursor - 1; }
    INLINE M reached(L place) const { return narrow(place >= before); }

    // Move `fresh` lanes to the start at `begin`; returns those whose first time it is.
    INLINE M start(M fresh, T begin) {
        M first = fresh & (time(L{}, fresh) <= begin);
        cursor = wide(fresh) ? (wide(first) ? L{} + 1 : L{}) : cursor;
        return first;
    }

    // Pass all times up to `t`; returns the lanes that have passed any.
    INLINE M advance(V t, M lanes) {
        before = cursor;
        V bin = lanes ? least(t * rate, all(last_bin)) : V{};
        L place = __builtin_convertvector(gathered(bins, __builtin_convertvector(bin, L), lanes), L);
        cursor = wide(lanes) ? place : cursor;
        cursor -= wide(lanes & (time(cursor, lanes) <= t));  // of a uniform grid, the table is at most one place behind
        for (M behind; any(behind = lanes & (time(cursor, lanes) <= t));) cursor -= wide(behind);
        return lanes & narrow(cursor > before);
    }
};
