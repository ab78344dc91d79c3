// Two oscillators with one frequency, x_i'' = −ω² x_i, as the programs of compile/loops/runge_kutta.cpp, and their runs.
// The state is (x_1, x_2, v_1, v_2), the wrench x_1. The law is defined where |x_1| < 2; the rod touches at x_2 = 1.5.
#include <math.h>
#include <stdio.h>

#include "lanes.hpp"

extern "C" {
void rates(const V *, const V *s, const V *p, V *s_dot, V *wrench) {
    V x1 = s[0], x2 = s[1], v1 = s[2], v2 = s[3], square = p[0] * p[0];
    s_dot[0] = v1, s_dot[1] = v2, s_dot[2] = -square * x1, s_dot[3] = -square * x2, wrench[0] = x1;
}

void onto(const V *s, V *projected) {
    for (int i = 0; i < 4; i++) projected[i] = s[i];
}

void project(const V *s, V *projected, V *drift) {
    onto(s, projected);
    for (int i = 0; i < 3; i++) drift[i] = all(i);
}

void margin(const V *, const V *s, const V *, V *margin) { *margin = 4 - s[0] * s[0]; }

void values(const V *, const V *s, const V *, V *gauges) { gauges[0] = s[0] * s[0] - T(0.25), gauges[1] = s[1] * s[1]; }

void gauges(const V *t, const V *s, const V *s_dot, V *gauges, V *first, V *second, V *tolerances) {
    values(t, s, s_dot, gauges);
    for (int i = 0; i < 2; i++) {
        first[i] = 2 * s[i] * s_dot[i];
        second[i] = 2 * s_dot[i] * s_dot[i] + 2 * s[i] * s_dot[2 + i];
        tolerances[i] = all(1);
    }
}

void forces(const V *wrench, V *both) { both[0] = wrench[0] * wrench[0], both[1] = size(wrench[0]); }

void room(const V *before, const V *after, const V *seconds, V *bound) {
    *bound = T(1.5) - most(before[1], after[1]) - T(0.01) - 0 * *seconds;
}

void touching(const V *before, const V *after, const V *, V *found) {
    V b = before[1], a = after[1], share = (T(1.5) - b) / (a - b);
    found[0] = T(1.5) - most(a, b);
    found[1] = b >= T(1.5) ? all(0) : a >= T(1.5) ? share : all(2);
    found[2] = all(7);
}

void kernel(
    const double *, const double *, int64_t *, int64_t, double, double, double, double, int64_t, const double *,
    int64_t, const double *, const double *, double, double, double *, double *, double *, double *, int64_t *,
    int64_t *, double *, double *, int64_t *, const int64_t *);
}

constexpr int64_t RUNS = 7, TIMES = 5, JUDGED = 500;
constexpr double DURATION = 5;
static const double starts[RUNS][4] = {
    {1, 0.5, 0, 0}, {0, 1, 1, 0}, {3, 0, 0, 0}, {NAN, 0, 0, 0}, {0.5, 0, 0, 5}, {0.4, -1, 0, 0.1}, {1.9, 0, 1, 0}};
static const double omegas[RUNS] = {1, 2, 1, 1, 2, 3, 1};

static void print(const double *numbers, int64_t count) {
    for (int64_t i = 0; i < count; i++) printf(" %.17g", numbers[i]);
}

int main() {
    static double times[TIMES + 1] = {0, 0.7, 0.7001, 2, 5, INFINITY}, judged[JUDGED + 1], bins[2 * JUDGED] = {};
    for (int64_t i = 0; i < JUDGED; i++) judged[i] = DURATION * double(i + 1) / JUDGED;
    judged[JUDGED] = INFINITY;
    double samples[RUNS][TIMES][4], reductions[RUNS][6], final[RUNS][4], end[RUNS], clearance[RUNS];
    double knots[1 + 4 * 2000] = {0};
    int64_t queue = 0, stop = 0, status[RUNS], steps[RUNS], part[RUNS];
    kernel(
        starts[0], omegas, &queue, RUNS, 0, DURATION, 1e-9, 1e-9, 100000, times, TIMES, judged, bins, 2 * JUDGED, 200,
        samples[0][0], reductions[0], final[0], end, status, steps, knots, clearance, part, &stop);
    for (int64_t run = 0; run < RUNS; run++) {
        printf("%ld %ld", long(status[run]), long(part[run]));
        print(&end[run], 1), print(final[run], 4), print(reductions[run], 6), print(&clearance[run], 1);
        print(samples[run][0], 4 * TIMES), printf("\n");
    }
    return 0;
}
