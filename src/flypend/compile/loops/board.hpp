// The flight computer: its program, its memory, and its commands in transit.
#pragma once

#include "sampled.hpp"

// The memory slides through a longer one, so that queues in it stay where they are: the board writes its next memory
// `SLIDE` vectors before the present one, whose queues need not be copied then.
struct Board {
    V *memory, *ring;  // of `memory_length`; (DEPTH, COMMAND)

    static INLINE int64_t strides() { return (MEMORY + SLIDE - 1) / SLIDE; }
    static INLINE int64_t memory_length() { return strides() * SLIDE + MEMORY; }

    // The memory before `tick`.
    INLINE V *before(int64_t tick) const { return memory + (strides() - tick % strides()) * SLIDE; }

    // The command computed `age` ticks before `tick`.
    INLINE V *held(int64_t tick, int64_t age) const { return ring + (tick - age + DEPTH) % DEPTH * COMMAND; }

    INLINE void begin(const V *rotors, const V *estimate) const {
        start(rotors, estimate, before(0), ring);
        for (int64_t slot = 1; slot < DEPTH; slot++) copy(ring, ring + slot * COMMAND, COMMAND);
    }

    // Compute the command of `tick` from what is `measured`, time first.
    INLINE V *command(int64_t tick, const V *measured, const V *gains, const V *params) const {
        V *command = held(tick, 0), *now = before(tick), *next = now - SLIDE;
        board(now, measured, nullptr, gains, params, next, command);
        if (next == memory) copy(next, before(0), MEMORY);  // back to where it does not overlap itself
        return command;
    }
};
