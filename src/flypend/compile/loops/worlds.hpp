// What stepped worlds leave open: sizes, places and programs; `flypend.compile.problem` describes them.
#pragma once

#include "lanes.hpp"
#include "state.hpp"

extern "C" {
// Lengths.
extern const int64_t STATE, ROTORS;  // of the state, and of the rotor forces that follow it
extern const int64_t ACTIONS, COMMAND, OBSERVED;
extern const int64_t NUMBERS;        // of the vehicle
extern const int64_t UNIFORMS;       // of the random numbers of a beginning
extern const int64_t MEMORY;         // of a world

// Where the parts of the memory begin that are not the state.
extern const int64_t AT_ACTION, AT_QUEUE, AT_WIND, AT_TIMING, AT_NUMBERS, AT_DELAY, AT_ESTIMATE;

// An action consists of `STEPS` steps of `LENGTH`, s. Up to `QUEUED` earlier commands may still act.
extern const int64_t STEPS, QUEUED;
extern const double LENGTH;
extern const int64_t RATES;    // whether a command goes through the rate loop

extern const int64_t TOUCHES;  // whether the rod can touch anything

// Sensors and estimator.
extern const int64_t SENSES;                   // whether there are any
extern const int64_t START_TICK, START_DRAWS;  // the tick that stands for the start, and its random numbers
extern const int64_t DRAWS;                    // random numbers of any other

extern const double BY_TASK, LOST;  // causes of an end other than a touch

extern const double BOUND;  // a state is lost once its length is beyond it; no observation is larger

// Programs, for all lanes. Inputs are read before an output is written, so an output may be an input.
void begin(const V *uniforms, V *memory);
void command(const V *action, V *command);
void rate_loop(const V *command, const V *omega, const V *none, V *forces);
void step(
    const V *state, const V *rotors, const V *forces, const V *wind, const V *timing, const V *numbers, V *next,
    V *next_rotors);
void observe(const V *t, const V *memory, V *observed);
void judge(const V *t, const V *memory, const V *action, V *reward, V *ended);  // ended: above 0
void first_estimate(const V *state, const V *draws, V *estimate);               // before the first readings
void carry(const V *estimate, const V *action, V *next);
void sense(const V *estimate, const V *t, const V *state, const V *draws, V *next);
}
