// What sampled flights leave open: sizes, times and programs; `flypend.compile.problem` describes them.
#pragma once

#include "lanes.hpp"
#include "state.hpp"

extern "C" {
// Lengths.
extern const int64_t STATE, ROTORS;  // of the state, and of the rotor forces that follow it
extern const int64_t MEMORY;         // of the board's memory, and
extern const int64_t SLIDE;          // by how much its queues move in a tick
extern const int64_t MEASURED;       // of what the board is told, without the time
extern const int64_t COMMAND;
extern const int64_t GAINS, NOISE, WIND, PARAMS;  // of inputs of the programs
extern const int64_t GUST;           // of the memory of gusts and knocks; 0 without
extern const int64_t VALUES;         // that are reduced over the samples

// A tick of `PERIOD`, s, consists of stretches, each under the command of so many ticks ago and in so many steps. In a
// flight in pieces, ages and steps are inputs.
extern const double PERIOD;
extern const int64_t STRETCHES, TIMING;  // their number, and the inputs of each
extern const double AGES[], STEPS[];
extern const int64_t DEPTH;              // commands to keep: those in transit and the present one
extern const int64_t PIECES;             // whether the flight is one in pieces

// Random numbers of a tick: room for `DRAWS`, drawn from `FIRST_DRAW` to before `END_DRAW`, since nothing uses the others;
// `GUST_DRAWS` from `GUSTS` on are for the gusts, of `GUST_TICK` for those before the first tick.
extern const int64_t RANDOM, DRAWS, FIRST_DRAW, END_DRAW, GUSTS, GUST_DRAWS, GUST_TICK;

// Which programs there are.
extern const int64_t RATES, MEASURES, TOUCHES;

// Sensors, which remember.
extern const int64_t SENSES, SENSED;           // whether there are any, and the length of their memory
extern const int64_t START_TICK, START_DRAWS;  // the tick that stands for the start, and its random numbers

extern const double MOST_STATE;  // |s| beyond it is lost
extern const double KINDS[];     // of reduction, one per value

// Programs, for all lanes. Inputs are read before an output is written, so an output may be an input.
void start(const V *rotors, const V *estimate, V *memory, V *command);
void board(const V *memory, const V *measured, const V *reference, const V *gains, const V *params, V *next, V *command);
void rate_loop(const V *command, const V *omega, const V *none, V *forces);
void world(
    const V *state, const V *rotors, const V *command, const V *wind, const V *timing, V *next, V *next_rotors);
void measure(const V *state, const V *draws, const V *noise, V *measured);
void gusts(const V *memory, const V *draws, const V *wind, V *next, V *forces);
void strike(const V *state, const V *impulses, V *next);
void judge(const V *t, const V *state, const V *gains, V *values);
void sense_begin(const V *state, const V *draws, V *memory);
void sense_estimate(const V *state, const V *draws, V *estimate);
void sense(
    const V *memory, const V *t, const V *state, const V *draws, const V *sizes, V *next, V *readings);
}
