// Two carts, x_i'' = u_i, as the programs of compile/loops/sampled.cpp, and their flights: plain, in pieces (PIECES), with
// sensors that give the same as the measurement (SENSES), or through an engine called by address (MUJOCO).
// The state is (x_1, x_2, v_1, v_2), the rotor forces are u; the rod touches at x_2 = 1.5. The board's memory is the
// tick and the two before: what they are not disturbs the command.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <initializer_list>

#include "contact.hpp"
#include "mujoco.hpp"
#include "sampled.hpp"

extern "C" {
void start(const V *rotors, const V *estimate, V *memory, V *command) {
    for (int i = 0; i < 3; i++) memory[i] = all(-i);
    for (int i = 0; i < 2; i++) command[i] = rotors[i] + (SENSES ? 0 * estimate[i] : V{});
}

void board(const V *m, const V *measured, const V *, const V *gains, const V *params, V *next, V *command) {
    const V *x = measured + 1, tick = m[0], wrong = size(m[1] + 1 - tick) + size(m[2] + 2 - tick);
    for (int i = 0; i < 2; i++) command[i] = -gains[0] * x[i] - params[0] * x[2 + i] + 100 * wrong;
    next[1] = tick, next[0] = tick + 1;  // next[2] is m[1] already
}

void measure(const V *state, const V *draws, const V *noise, V *measured) {
    for (int i = 0; i < 4; i++) measured[i] = state[i] + (SENSES ? all(T(0.001)) : noise[0]) * draws[i];
}

void sense_begin(const V *state, const V *, V *memory) { memory[0] = 0 * state[0]; }
void sense_estimate(const V *state, const V *draws, V *estimate) {
    for (int i = 0; i < 4; i++) estimate[i] = state[i] + draws[i];
}
void sense(const V *memory, const V *, const V *state, const V *draws, const V *, V *next, V *readings) {
    measure(state, draws, nullptr, readings);
    next[0] = memory[0] + 1;
}

void gusts(const V *memory, const V *draws, const V *wind, V *next, V *forces) {
    next[0] = memory[0] + wind[0] * draws[0];
    for (int i = 0; i < 6; i++) forces[i] = i == 0 ? next[0] : V{};
}

void world(const V *s, const V *, const V *u, const V *wind, const V *timing, V *next, V *rotors) {
    V h = timing[0];
    for (int i = 0; i < 2; i++) {
        V x = s[i], v = s[2 + i], force = u[i] + (i == 0 ? wind[0] : V{});
        next[i] = x + h * v + h * h * force / 2, next[2 + i] = v + h * force, rotors[i] = u[i];
    }
}

void strike(const V *state, const V *impulses, V *next) {
    for (int i = 0; i < 4; i++) next[i] = state[i] + (i < 2 ? V{} : impulses[i - 2]);
}

void judge(const V *, const V *state, const V *, V *values) {
    for (int i = 0; i < 4; i++) values[i] = state[0] - T(0.2);
}

void room(const V *before, const V *after, const V *seconds, V *bound) {
    *bound = T(1.5) - most(before[1], after[1]) - T(0.01) - 0 * *seconds;
}
void touching(const V *before, const V *after, const V *, V *found) {
    V b = before[1], a = after[1], share = (T(1.5) - b) / (a - b);
    found[0] = T(1.5) - most(a, b);
    found[1] = b >= T(1.5) ? all(0) : a >= T(1.5) ? share : all(2);
    found[2] = all(7);
}

// The engine's coordinates are those of the state.
void seen(const V *qpos, const V *qvel, const V *rotors, V *state, V *state_rotors) {
    copy(qpos, state, 2), copy(qvel, state + 2, 2), copy(rotors, state_rotors, 2);
}
void rate_loop(const V *, const V *, const V *, V *) {}
void motors(const V *wanted, const V *, const V *numbers, V *controls, V *lags) {
    for (int i = 0; i < 2; i++) controls[i] = wanted[i], lags[i] = numbers[0];
}
void surroundings(
    const V *, const V *, const V *, const V *, const V *, const V *wind, const V *, V *on_vehicle, V *on_bob, V *joint) {
    for (int i = 0; i < 3; i++) on_vehicle[i] = wind[i], on_bob[i] = wind[3 + i], joint[i] = V{};
}

void context_size(int64_t *bytes);
void kernel(
    const double *, const double *, const double *, const int64_t *, int64_t, int64_t, const int64_t *, int64_t,
    const int64_t *, const int64_t *, int64_t, double *, double *, double *, double *, int64_t *, double *, int64_t *,
    const int64_t *, V *, int64_t, const double *, const MujocoMemory *);
}

struct Engine {
    double qpos[2], qvel[2], qacc[2], act[2], ctrl[2], xfrc[18], qfrc[9], filters[2][20];
};
static void mj_forward(const void *, void *) {}
static void mj_reset(const void *, void *data) { memset(data, 0, sizeof(double[10])); }
static void mj_step(const void *model, void *data) {
    Engine &e = *(Engine *)data;
    double h = *(const double *)model;
    for (int i = 0; i < 2; i++) {
        double force = e.ctrl[i] + (i == 0 ? e.xfrc[6] : 0);
        e.qpos[i] += h * e.qvel[i] + h * h * force / 2, e.qvel[i] += h * force, e.act[i] = e.ctrl[i];
    }
}

constexpr int64_t RUNS = 5, TICKS = 200;
static const double starts[RUNS][6] = {
    {1, 0.5, 0, 0}, {0, 1, 0.3, 0.5, 1, -1}, {0, 1, 0, 9}, {NAN, 0, 0, 0}, {0.5, 0, 0, 1e6}};
static const double gains[RUNS] = {1, 2, 3, 1, 2};
static const int64_t seeds[RUNS] = {3, 4, 5, 6, 7};

int main() {
    // Two stretches of a tick: age and steps in pieces, then the length of a step, s; its timing, and the noise and wind.
    double numbers[16];
    int64_t count = 0;
    for (int stretch = 0; stretch < 2 && PIECES; stretch++)
        for (double number : {AGES[stretch], STEPS[stretch]}) numbers[count++] = number;
    const double h[2] = {0.004, 0.003};
    for (double step : h)
        if (MUJOCO) for (double number : {1.0, step}) numbers[count++] = number;
        else numbers[count++] = step;
    if (!SENSES) numbers[count++] = 0.001;
    for (double number : {0.01, 1.5}) numbers[count++] = number;

    int64_t ticks[TICKS + 1], judged[TICKS + 1], rows[TICKS + 2], bytes, stop = 0, status[RUNS], part[RUNS];
    for (int64_t i = 0; i < TICKS + 2; i++) rows[i] = i;
    for (int64_t i = 0; i < TICKS + 1; i++) ticks[i] = i, judged[i] = 1;
    static double samples[RUNS][TICKS + 1][6], reductions[RUNS][4], final[RUNS][4], end[RUNS], clearance[RUNS];
    for (auto &run : samples) for (auto &row : run) for (double &number : row) number = NAN;

    double begins[RUNS][4];
    Engine e{};
    const void *models[2] = {&h[0], &h[1]};
    V *filters[2] = {(V *)e.filters[0], (V *)e.filters[1]};
    const MujocoMemory memory{
        &e, (V *)e.qpos, (V *)e.qvel, (V *)e.qacc, (V *)e.act, (V *)e.ctrl, (V *)e.xfrc, (V *)e.qfrc,
        mj_step, mj_forward, mj_reset, begins[0], models, filters};
    for (int run = 0; run < RUNS; run++) memcpy(begins[run], starts[run], sizeof(begins[run]));

    context_size(&bytes);
    const double none[RUNS][6] = {};
    const int64_t together = PIECES ? W : RUNS, lengths[] = {1, 70, 129};
    for (int64_t run = 0; run < RUNS; run += together) {
        const int64_t some_runs = RUNS - run < together ? RUNS - run : together;
        V *context = (V *)aligned_alloc(64, (bytes + 63) / 64 * 64);
        for (int64_t piece = 0, begun = 0; piece < (PIECES ? 3 : 1); piece++) {
            const int64_t last = PIECES ? begun + lengths[piece] : TICKS, first = begun ? begun + 1 : 0;
            static double kept[RUNS * (TICKS + 1) * 6];
            const int64_t row_count = last - first + 1;
            for (double &number : kept) number = NAN;
            kernel(
                starts[run], gains + run, numbers, seeds + run, some_runs, last, ticks + first, row_count, judged,
                rows, row_count, kept, reductions[run], final[run], end + run, status + run, clearance + run,
                part + run, &stop, PIECES ? context : nullptr, begun, PIECES ? none[0] : nullptr,
                MUJOCO ? &memory : nullptr);
            for (int64_t i = 0; i < some_runs; i++)
                for (int64_t tick = first; tick <= last; tick++)
                    memcpy(samples[run + i][tick], kept + (i * row_count + tick - first) * 6, sizeof(double[6]));
            begun = last;
        }
        free(context);
    }
    for (int64_t run = 0; run < RUNS; run++) {
        printf("%ld %ld %.17g %.17g", long(status[run]), long(part[run]), end[run], clearance[run]);
        for (double number : reductions[run]) printf(" %.17g", number);
        for (double number : final[run]) printf(" %.17g", number);
        for (auto &row : samples[run]) for (double number : row) printf(" %.17g", number);
        printf("\n");
    }
    return 0;
}
