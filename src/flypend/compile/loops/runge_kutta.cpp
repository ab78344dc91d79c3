// The kernel of the ideal plant: embedded Runge-Kutta integration, one run per lane.
//
// Every lane has its own time and step size. When its run ends (completed, diverged, singular), it takes the next
// start from a queue: a counter that calls in other threads can share. No lane waits for another, and the result of a
// run does not depend on its neighbours.
#include "judging.hpp"
#include "sampling.hpp"
#include "statuses.hpp"
#include "touching.hpp"

// Half as many rejected steps as with SciPy's 0.9 and 10, and 3 to 7 % fewer evaluations at the same error.
constexpr T SAFETY = 0.8, LEAST_FACTOR = 0.2, MOST_FACTOR = 5;
// s: below it, time no longer advances or a singularity has been located.
constexpr T SHORTEST = 1e-13;
// s: the first step of a run.
constexpr T FIRST_LEAST = 1e-6, FIRST_MOST = 1e-2;

// A conservative first step, from the norms of s and ṡ in tolerances. A run whose rates are not finite ends whatever
// its step.
static INLINE V first_step(const Stages &stages, V rtol, V atol) {
    V state{}, rate{};
    for (int64_t i = 0; i < N; i++) {
        V scale = atol + rtol * size(stages.S[i]);
        V a = stages.S[i] / scale, b = stages.K[i] / scale;
        state += a * a, rate += b * b;
    }
    V step = T(0.01) * root(state / most(rate, all(T(1e-10))));
    return most(least(step, all(FIRST_MOST)), all(FIRST_LEAST));
}

// Ratio of the next step to this one: SAFETY times the ratio that would just meet the tolerance.
static INLINE V growth(V error) {
    V factor = SAFETY * power(most(error, all(T(1e-12))), T(-1 / ORDER));
    return least(most(factor, all(LEAST_FACTOR)), all(MOST_FACTOR));
}

// Fly `runs` runs from `begin_at` until `until_at`, s, all times lying between. The arrays are those of
// `flypend.flight.kernels.ideal.call`; `reductions` and `knots` may be null. `knots` is for a single run: the number of
// accepted steps, then time and drift of each. Returns soon after `stop` is no longer zero.
extern "C" void kernel(
    const double *starts, const double *parameters, int64_t *queue, int64_t runs, double begin_at, double until_at,
    double rtol_, double atol_, int64_t max_steps, const double *times, int64_t time_count, const double *judge_times,
    const double *bins, double bin_count, double bin_rate, double *samples, double *reductions, double *final,
    double *end, int64_t *status, int64_t *steps, double *knots, double *clearance, int64_t *part,
    const int64_t *stop) {
    const T begin = T(begin_at), until = T(until_at);
    const V rtol = all(T(rtol_)), atol = all(T(atol_));

    V S[N], Y[N], P[some(PARAMETERS)], K[N * (STAGES + 1 + EXTRA)], w[some(WRENCH * (STAGES + 1 + EXTRA))];
    V state[N], moved[N], dense_end[N], weight[STAGES + 1 + EXTRA];
    V before[some(3 * GAUGES)], after[some(3 * GAUGES)], tolerance[some(GAUGES)], margins[some(GAUGES)];
    V curve[some(6 * GAUGES)], exact[some(GAUGES)], found[some(GAUGES)];
    M open[some(GAUGES)];
    L last_out[some(GAUGES)];
    V rod_before[N + 1], rod_after[N + 1], drift[3];
    double rows[W * N];
    int64_t run[W];

    Stages stages{S, Y, P, K, w};
    Dense dense{stages, state, moved, dense_end, weight, false};
    Sampler sampler{dense, times, time_count, samples, rows, run, L{}, all(INFINITE)};
    Grid grid{judge_times, bins, T(bin_rate), T(bin_count) - 1, L{}, L{}};
    Judge judge{
        stages, dense, grid, before, after, tolerance, margins, curve, exact, found, open, last_out,
        V{}, V{}, V{}, V{}};
    Touching touch{stages, dense, rod_before, rod_after};
    const bool judged = GAUGES > 0 && reductions;

    V t{}, h{}, count{};
    V goal{};             // s, where a run ends: at `until`, or where its rod touches
    M active = none();    // lanes that have a run
    M rejected = none();  // whose last step was: the next must not grow
    M low = none();       // whose start is where the law is not defined
    M touched = none();   // whose rod touches at the goal
    int64_t left = W;     // lanes that have a run
    for (int64_t i = 0; i < N; i++) S[i] = K[i] = V{};
    for (int64_t i = 0; i < PARAMETERS; i++) P[i] = V{};
    for (int64_t i = 0; i < WRENCH; i++) w[i] = V{};

    // The next start into `lane`, or nothing if the queue is empty.
    auto load = [&](int64_t lane) WITHIN {
        int64_t next = __atomic_fetch_add(queue, 1, __ATOMIC_RELAXED);
        active[lane] = next < runs ? -1 : 0;
        if (next >= runs) {
            left--;
            return;
        }
        run[lane] = next;
        from_row(starts + next * N, stages.S, lane, N);
        from_row(parameters + next * PARAMETERS, stages.P, lane, PARAMETERS);
        t[lane] = begin;
        h[lane] = count[lane] = 0;
        rejected[lane] = 0;
        sampler.start(lane);
    };

    // Evaluate the rates of new runs and judge their starts. All other lanes stay bit-identical.
    auto start = [&]() WITHIN {
        M fresh = h <= 0;
        stages.start(t, fresh);
        if (judged) judge.start(fresh, t, begin);
        goal = fresh ? all(until) : goal;
        if (TOUCHES) {
            M there = touch.start(fresh);
            touched = fresh ? there : touched;
            goal = fresh & there ? t : goal;
        }
        low = none();
        if (GUARDED) {
            V value;
            margin(&t, stages.S, stages.P, &value);
            low = fresh & (value <= 0);
        }
        h = fresh ? first_step(stages, rtol, atol) : h;
    };

    // Write what the run in `lane` has come to.
    auto store = [&](int64_t lane, V how) WITHIN {
        int64_t row = run[lane];
        into_row(stages.S, lane, final + row * N, N);
        end[row] = t[lane];
        status[row] = int64_t(how[lane]);
        steps[row] = int64_t(count[lane]);
        sampler.finish(lane);
        if (judged) judge.store(lane, t[lane] - begin, reductions + row * (GAUGES + 4));
        if (TOUCHES) touch.store(lane, clearance[row], part[row]);
    };

    for (int64_t lane = 0; lane < W; lane++) {
        run[lane] = -1;
        load(lane);
    }
    start();
    while (left > 0 && !__atomic_load_n(stop, __ATOMIC_RELAXED)) {
        // One attempted step in every lane.
        M last = t + T(1.0001) * h >= goal;
        V step_h = last ? goal - t : h, largest;
        V error = stages.attempt(t, step_h, rtol, atol, largest);
        Step step{t, step_h, last ? goal : t + step_h};
        M accepted = (error <= 1) & active & (t < goal), guarded = none(), cut = none();
        project(Y, Y, drift);
        if (GUARDED) {
            V value;
            margin(&step.t_new, Y, P, &value);
            guarded = accepted & ~(value > 0);
        }
        accepted &= ~(guarded | low);
        M lost = accepted & ~(largest < T(MOST_STATE));
        accepted &= ~lost;

        // Look at what lies within the accepted steps.
        if (!USES_END) stages.evaluate(step.t_new, STAGES);  // otherwise f at the end is known, up to projection
        dense.begin();
        if (TOUCHES) {  // a step in which the rod touches is taken once more, until there
            V when;
            cut = touch.take(step, accepted & ~touched, when);
            goal = cut ? when : goal;
            touched |= cut, accepted &= ~cut;
        }
        sampler.take(step, accepted);
        if (judged) judge.take(step, accepted, rtol + atol);

        // Take them.
        for (int64_t i = 0; i < N; i++) replace(S[i], accepted, Y[i]);
        stages.carry(accepted);
        if (knots && accepted[0]) {
            double *knot = knots + 1 + 4 * int64_t(knots[0]);
            knot[0] = step.t_new[0];
            for (int64_t i = 0; i < 3; i++) knot[1 + i] = drift[i][0];
            knots[0] += 1;
        }
        count += 1;
        t = accepted ? step.t_new : t;
        V factor = growth(error);  // a NaN error shrinks the step by LEAST_FACTOR
        V grown = rejected ? least(factor, all(1)) : factor, shrunk = factor < 1 ? factor : all(LEAST_FACTOR);
        factor = guarded ? all(T(0.5)) : cut ? all(1) : accepted ? grown : shrunk;
        rejected = ~accepted;
        h = active ? step.h * factor : step.h;

        // End runs; the last reason that holds counts.
        M stuck = ~accepted & ~(h > most(all(SHORTEST), T(1e-15) * t));
        V how = all(-1);
        how = count >= T(max_steps) ? all(TOO_MANY) : how;
        how = stuck ? (guarded ? all(SINGULAR) : all(TOO_SMALL)) : how;
        how = lost ? all(DIVERGED) : how;
        how = (t >= goal) ? (touched ? all(COLLIDED) : all(COMPLETED)) : how;
        M at_start = t <= begin;
        if (any(at_start)) how = (at_start & undefined(stages.k(0), N)) ? all(UNDEFINED) : how;
        how = low ? all(SINGULAR) : how;  // the guard says why, also where a rate is not finite
        M over = active & (how >= 0);
        if (any(over)) {
            if (judged) judge.end(over & (how != all(COMPLETED)));
            for (int64_t lane : Set(over)) {
                store(lane, how);
                load(lane);
            }
            start();
        }
    }
}
