// Judging runs at the cost of a few states per step.
//
// What counts at the judged times is when each gauge was last out of bounds, and the largest value of the last gauge.
// Within a step a gauge is the quintic that matches its value and its first two derivatives at both ends. The
// coefficients of that quintic in Bernstein's basis enclose it, so most steps are decided without a look at any judged
// time. The others are searched backwards from the end of the step. Where the quintic is closer to its bound than its
// error may be, the state comes from dense output, so verdicts are those of judging dense output at every judged time.
//
// Mean square and maximum of the forces come from the wrenches of the stages, the mean by the method's own quadrature.
#pragma once

#include "dense.hpp"
#include "grid.hpp"

// Error of a quintic, as a share of what its second derivatives add to the cubic that matches value and slope. A kink
// anywhere in a step makes an error of at most 3/64 of it; smooth motion much less.
constexpr T SHARE = 0.05;
// Error of a state from dense output, in tolerances.
constexpr T NOISE = 50;

#define EACH_GAUGE UNROLLED for (int64_t i = 0; i < GAUGES; i++)

struct Judge {
    const Stages &stages;
    Dense &dense;
    Grid grid;
    V *before, *after;          // (3 GAUGES) values, first and second derivatives at the beginning and end of a step
    V *tolerance, *margin;      // (GAUGES); the quintic's error may be `margin`
    V *curve;                   // (6 GAUGES) Bernstein's coefficients
    V *exact, *found;           // (GAUGES) at a judged time: by the quintic or dense output, by dense output
    M *open;                    // (GAUGES) not yet decided in this step
    L *last;                    // (GAUGES) the last judged time out of bounds; -1 for none
    V largest, sum, first_square, peak;  // of the last gauge; of the forces

    INLINE bool smooth() const { return SMOOTH != 0; }

    // Mean square and maximum of the forces of a stage.
    INLINE void force(int64_t stage, V &square, V &maximum) const {
        V both[2];
        forces(stages.wrench(stage), both);
        square = both[0], maximum = both[1];
    }

    // Judge the starts of `fresh` lanes, in state S with stage 0 at `t`.
    INLINE void start(M fresh, V t, T begin) {
        gauges(&t, stages.S, stages.k(0), after, after + GAUGES, after + 2 * GAUGES, tolerance);
        carry(fresh);
        M first = grid.start(fresh, begin);
        EACH_GAUGE {
            M out = first & ~(after[i] <= T(BOUNDS[i]));
            last[i] = wide(fresh) ? (wide(out) ? L{} : L{} - 1) : last[i];
        }
        V square, maximum;
        force(0, square, maximum);
        largest = fresh ? (first ? after[GAUGES - 1] : all(-INFINITE)) : largest;
        sum = fresh ? V{} : sum;
        first_square = fresh ? square : first_square;
        peak = fresh ? maximum : peak;
    }

    // The end of the step is the beginning of the next.
    INLINE void carry(M lanes) {
        UNROLLED for (int64_t j = 0; j < 3 * GAUGES; j++) replace(before[j], lanes, after[j]);
    }

    // Judge the accepted steps; `scale` is the tolerance of an entry of order one.
    INLINE void take(const Step &step, M accepted, V scale) {
        V t = step.t_new;
        gauges(&t, stages.Y, stages.k(STAGES), after, after + GAUGES, after + 2 * GAUGES, tolerance);
        M due = grid.advance(t, accepted), grown;
        M pending = enclose(step, due, NOISE * scale, grown);
        if (any(pending)) search(step, pending, grown);
        integrate(step, accepted);
        carry(accepted);
    }

    // Decide what the enclosures decide. Returns the lanes to be searched; in those that have `grown`, the largest
    // value may be new.
    INLINE M enclose(const Step &step, M due, V noise, M &grown) {
        M pending = none();
        V high{};
        EACH_GAUGE {
            V bend = fit(i, step.h);
            const V *b = curve + 6 * i;
            margin[i] = smooth() ? SHARE * bend + noise * (2 * tolerance[i] + noise) : all(INFINITE);
            V low = least(least(least(b[0], b[1]), least(b[2], b[3])), least(b[4], b[5]));
            high = most(most(most(b[0], b[1]), most(b[2], b[3])), most(b[4], b[5]));
            M within = high + margin[i] <= T(BOUNDS[i]), outside = low - margin[i] > T(BOUNDS[i]);
            last[i] = wide(due & outside) ? grid.latest() : last[i];
            open[i] = due & ~within & ~outside;
            pending |= open[i];
        }
        grown = smooth() ? risen(step, due & ~(high <= largest)) : due;
        return pending | grown;
    }

    // Update the largest value in the lanes where the last gauge only rises; returns the others of `grown`.
    INLINE M risen(const Step &step, M grown) {
        const V *b = curve + 6 * (GAUGES - 1);
        M rising = grown & (b[0] <= b[1]) & (b[1] <= b[2]) & (b[2] <= b[3]) & (b[3] <= b[4]) & (b[4] <= b[5]);
        if (any(rising)) {
            V time = grid.time(grid.latest(), rising);
            enlarge(rising, quintic(GAUGES - 1, (time - step.t) / step.h));
        }
        return grown & ~rising;
    }

    INLINE void enlarge(M lanes, V value) { largest = (lanes & ~(value <= largest)) ? value : largest; }

    // The quintic of gauge i in Bernstein's basis; returns how far its ends bend from the cubic.
    INLINE V fit(int64_t i, V h) {
        V a = before[i], da = h * before[GAUGES + i], dda = h * h * before[2 * GAUGES + i];
        V b = after[i], db = h * after[GAUGES + i], ddb = h * h * after[2 * GAUGES + i];
        V *c = curve + 6 * i;
        c[0] = a;
        c[1] = a + T(0.2) * da;
        c[2] = a + T(0.4) * da + T(0.05) * dda;
        c[3] = b - T(0.4) * db + T(0.05) * ddb;
        c[4] = b - T(0.2) * db;
        c[5] = b;
        V rise = 6 * (b - a);
        return size(dda - rise + 4 * da + 2 * db) + size(ddb + rise - 2 * da - 4 * db);
    }

    // Σ_j (5 over j) b_j θ^j (1 − θ)^(5−j)
    INLINE V quintic(int64_t i, V theta) const {
        const V *b = curve + 6 * i;
        V rest = 1 - theta, power = theta, total = b[0];
        total = total * rest + 5 * power * b[1], power *= theta;
        total = total * rest + 10 * power * b[2], power *= theta;
        total = total * rest + 10 * power * b[3], power *= theta;
        total = total * rest + 5 * power * b[4], power *= theta;
        return total * rest + power * b[5];
    }

    // Look at the judged times of the step, the latest first, in the lanes `here`.
    INLINE void search(const Step &step, M here, M grown) {
        for (L place = grid.latest(); any(here); here &= grid.reached(place)) {
            look(step, here, place, grown);
            M left = grown;
            EACH_GAUGE left |= open[i];
            here &= left;
            place -= 1;
        }
    }

    // Evaluate the gauges at the judged times `place`, from dense output where a quintic is in doubt.
    INLINE void look(const Step &step, M here, L place, M grown) {
        V time = grid.time(place, here), theta = (time - step.t) / step.h;
        grown &= here;
        M doubtful = none();
        EACH_GAUGE {
            exact[i] = quintic(i, theta);
            doubtful |= here & open[i] & ~(size(exact[i] - T(BOUNDS[i])) > margin[i]);
        }
        V value = exact[GAUGES - 1];
        M undefined = smooth() ? grown & (value != value) : grown;
        if (any(doubtful | undefined)) {
            dense.evaluate(step, time);
            values(&time, dense.state, stages.k(STAGES), found);
            EACH_GAUGE {
                M doubt = here & open[i] & ~(size(exact[i] - T(BOUNDS[i])) > margin[i]);
                if (i == GAUGES - 1) doubt |= undefined;
                exact[i] = doubt ? found[i] : exact[i];
            }
        }
        EACH_GAUGE {
            M out = here & open[i] & ~(exact[i] <= T(BOUNDS[i]));
            last[i] = wide(out) ? place : last[i];
            open[i] &= ~out;
        }
        enlarge(grown, exact[GAUGES - 1]);
    }

    // Add the forces of the accepted steps.
    INLINE void integrate(const Step &step, M accepted) {
        V total{}, maximum = peak;
        UNROLLED for (int64_t stage = 0; stage <= STAGES; stage++) {
            V square, most_of_stage;
            force(stage, square, most_of_stage);
            if (stage < STAGES && B[stage] != 0) total += T(B[stage]) * square;
            maximum = most(most_of_stage, maximum);
        }
        sum = accepted ? sum + step.h * total : sum;
        peak = accepted ? maximum : peak;
    }

    // Judge the last states of runs that have ended early, which are at no judged time, as those of single runs.
    INLINE void end(M lanes) { enlarge(lanes, before[GAUGES - 1]); }

    // Write the reductions of the run in `lane`, which lasted `seconds`, to `row`.
    INLINE void store(int64_t lane, T seconds, double *row) const {
        int64_t latest = -1;
        EACH_GAUGE {
            int64_t place = last[i][lane];
            row[1 + i] = place >= 0 ? grid.times[place] : -1;
            latest = place > latest ? place : latest;
        }
        row[0] = latest + 1 < grid.cursor[lane] ? grid.times[latest + 1] : double(INFINITE);
        row[GAUGES + 1] = root(largest)[lane];
        row[GAUGES + 2] = seconds > 0 ? sum[lane] / seconds : first_square[lane];
        row[GAUGES + 3] = peak[lane];
    }
};
