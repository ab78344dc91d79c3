// MuJoCo, called by address: a world with one lane, whose memory is laid out as MuJoCo's arrays are.
#pragma once

#include "sampled.hpp"

extern "C" {
extern const int64_t MUJOCO;           // whether it is the world
extern const int64_t QPOS, QVEL;       // lengths of its coordinates
extern const int64_t FILTERED;         // whether the rotors are filters, with their forces as activations
extern const int64_t DRIVEN, BLOWN;    // whether there are the programs "motors" and "surroundings"
extern const int64_t FILTER_STRIDE;    // numbers per rotor among the filters' parameters; the first is the time constant
extern const double MOST_FORCE;        // N: beyond, the flight is lost; MuJoCo would replace the force by zero

void seen(const V *qpos, const V *qvel, const V *rotors, V *state, V *state_rotors);
void motors(const V *wanted, const V *rotors, const V *numbers, V *controls, V *lags);
void surroundings(
    const V *qpos, const V *qvel, const V *qacc, const V *rotors, const V *controls, const V *wind, const V *numbers,
    V *on_vehicle, V *on_bob, V *in_joint);
}

// The caller's addresses: data and its arrays, functions, the coordinates of the starts, a model per stretch with the
// timestep of that, and the parameters of the models' filters.
struct MujocoMemory {
    void *data;
    V *qpos, *qvel, *qacc, *act, *ctrl, *xfrc, *qfrc;
    void (*step)(const void *model, void *data), (*forward)(const void *model, void *data);
    void (*reset)(const void *model, void *data);
    const double *begins;
    const void *const *models;
    V *const *filters;
};

struct Mujoco {
    const MujocoMemory *at;
    V *forces, *controls, *lags;  // (ROTORS) each
    bool lost;                    // whether a force has been NaN or too large

    // Forces and torques applied from outside, force first.
    INLINE V *on_vehicle() const { return at->xfrc + 6; }
    INLINE V *on_bob() const { return at->xfrc + 12; }
    INLINE V *in_joint() const { return at->qfrc + 6; }
    INLINE V *rotors() const { return FILTERED ? at->act : at->ctrl; }

    INLINE void begin(int64_t run, const V *state) {
        at->reset(at->models[0], at->data);
        const double *row = at->begins + run * (QPOS + QVEL);
        from_row(row, at->qpos, 0, QPOS);
        from_row(row + QPOS, at->qvel, 0, QVEL);
        copy(state + STATE, rotors(), ROTORS);
        lost = false;
    }

    // `timing` begins with MuJoCo's steps per step of the stretch, followed by `numbers` for the programs.
    INLINE void advance(int64_t stretch, int64_t steps, const V *command, const V *wind, const V *timing) {
        if (!BLOWN) copy(wind, on_vehicle(), 3), copy(wind + 3, on_bob(), 3);
        int64_t inner = int64_t(timing[0][0]);
        for (int64_t i = 0; i < steps; i++) {
            const V *wanted = command;
            if (RATES) rate_loop(command, at->qvel + 3, nullptr, forces), wanted = forces;
            copy(wanted, at->ctrl, ROTORS);
            V square{};
            for (int64_t j = 0; j < ROTORS; j++) square += at->ctrl[j] * at->ctrl[j];
            lost |= !(square[0] < MOST_FORCE * MOST_FORCE);
            for (int64_t j = 0; j < inner && !lost; j++) {
                apply(stretch, wanted, wind, timing + 1);
                at->step(at->models[stretch], at->data);
            }
        }
    }

    // What changes within a stretch: controls and time constants, forces and torques from outside.
    INLINE void apply(int64_t stretch, const V *wanted, const V *wind, const V *numbers) const {
        if (DRIVEN) {
            motors(wanted, rotors(), numbers, controls, lags);
            copy(controls, at->ctrl, ROTORS);
            for (int64_t i = 0; i < ROTORS && FILTERED; i++) at->filters[stretch][FILTER_STRIDE * i] = lags[i];
        }
        if (BLOWN) {
            at->forward(at->models[stretch], at->data);
            surroundings(
                at->qpos, at->qvel, at->qacc, rotors(), at->ctrl, wind, numbers, on_vehicle(), on_bob(), in_joint());
        }
    }

    // NaN once a force has been invalid.
    INLINE void show(V *state) const {
        seen(at->qpos, at->qvel, rotors(), state, state + STATE);
        if (lost) state[0] = all(__builtin_nan(""));
    }
};
