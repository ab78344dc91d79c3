/* $title */
#include "flypend_nmpc.h"
#include <math.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-ffast-math and -ffinite-math-only let a compiler assume that no number is NaN, and drop the checks below"
#endif

enum {
    ROTORS = FLYPEND_NMPC_ROTORS, STAGES = FLYPEND_NMPC_STAGES, ALL = FLYPEND_NMPC_ALL, STATE = FLYPEND_NMPC_STATE,
    D = FLYPEND_NMPC_D, W = D + ROTORS, LIMITS = FLYPEND_NMPC_LIMITS, BALL = LIMITS - 1, SLOPES = FLYPEND_NMPC_SLOPES,
    LEAST = $least, PHASES = $phases, AHEAD = $ahead, OFF = 18 + ROTORS, CURVED = $curved,
    /* Places in a cost, and in a cost to go. */
    OF_R = 2 * W, OF_C = OF_R + ROTORS, OF_Q = OF_C + 2, OF_P = D * (D + 1) / 2, OF_P_E = OF_P + W, OF_SHARED = OF_P_E + W
};
typedef flypend_real real;

static const real stage = $stage, tick = $tick, weight = $weight;
/* Of a rest of this duration of a stage: see flypend.plants.lag.step_timing; units of the plan. */
static const real timings[PHASES][4] = {
$timings
};
static const real units[STATE] = {$units};
static const real target[3] = {$target};
const flypend_nmpc_table flypend_nmpc_exported = {
    {
$states
    },
    {
$commands
    },
    {
$gains
    }
};
/* F = [A B] column by column: where each column begins, and rows; and the rows and columns of the entries of Q. */
static const unsigned short F_COLUMN[W + 1] = {$F_column};
static const unsigned char F_ROW[SLOPES] = {$F_row};
static const unsigned char Q_ROW[CURVED] = {$Q_row}, Q_COLUMN[CURVED] = {$Q_column};

$programs

static real size_of(real a) { return (a < 0) ? -a : a; }
static real least(real a, real b) { return (b < a) ? b : a; }
static real most(real a, real b) { return (b > a) ? b : a; }

/* The natural logarithm, by halving or doubling to around 1 and the series of the area tangent. What no slack is, none or
 * beyond all bounds, costs so much that a step to it fails. */
static real log_of(real x)
{
    real twos = 0, s, power, sum = 0;
    int k;
    if (!((x > $tiny) && (x < $huge))) {
        return -$huge;
    }
    for (; x < $low_256; x *= 256) {
        twos -= 8;
    }
    for (; x < $root_half; x *= 2) {
        twos -= 1;
    }
    for (; x > $root_two; x *= $half) {
        twos += 1;
    }
    s = (x - 1) / (x + 1);
    power = s;
    for (k = 1; k < 2 * $log_terms; k += 2) {
        sum += power / (real)k;
        power *= s * s;
    }
    return 2 * sum + twos * $log_two;
}

/* The merit of `count` stages with states x, commands u and a ball of squared radius `shared`; writes their slacks. */
static real merit_of(flypend_nmpc *n, int count, real (*x)[STATE], real (*u)[ROTORS], real (*slack)[LIMITS], real shared,
    real ball_weight, real gap_cost)
{
    real sum = ball_weight * shared + gap_cost, own, missed[$errors];
    int k, i;
    for (k = 0; k < count; k++) {
        real logs = 0;
        $call_values
        for (i = 0; i < LIMITS; i++) {
            logs += log_of(slack[k][i]);
        }
        sum += own - $barrier * logs;
    }
    $call_errors
    own = 0;
    for (i = 0; i < $errors; i++) {
        own += missed[i] * missed[i];
    }
    return sum + weight * own / 2;
}

static real squared(const real *x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

/* The recursion ------------------------------------------------------------------------------------------------ */

/* PF = P F. P is symmetric; ten sums at a time share what they load. */
static void times_slopes(flypend_nmpc *n, const real *F)
{
    int group, j, f;
    for (group = 0; group < D; group += 10) {
        const int i = (group < D - 10) ? group : D - 10;
        for (j = 0; j < W; j++) {
            real $sums_10;
            for (f = F_COLUMN[j]; f < F_COLUMN[j + 1]; f++) {
                const real by = F[f], *row = &n->P[F_ROW[f]][i];
                $add_10
            }
            $put_10
        }
    }
}

/* sum = row i of the transpose of F times PF, in a group of eight from column j on. */
static void curve(const flypend_nmpc *n, const real *F, int i, int j, real *sum)
{
    int f;
    real $sums_8;
    for (f = F_COLUMN[i]; f < F_COLUMN[i + 1]; f++) {
        const real by = F[f], *row = &n->PF[F_ROW[f]][j];
        $add_8
    }
    $put_8
}

/* x = -S^-1 x for the factors S = L D L^T, the inverse of D on the diagonal. */
static void solve(real (*L)[ROTORS], real *x, int stride)
{
    int i, h;
    for (i = 0; i < ROTORS; i++) {
        for (h = 0; h < i; h++) {
            x[i * stride] -= L[i][h] * x[h * stride];
        }
    }
    for (i = ROTORS - 1; i >= 0; i--) {
        x[i * stride] *= -L[i][i];
        for (h = i + 1; h < ROTORS; h++) {
            x[i * stride] -= L[h][i] * x[h * stride];
        }
    }
}

static void factorise(real (*S)[ROTORS])
{
    int i, j, h;
    for (j = 0; j < ROTORS; j++) {
        real column[ROTORS];
        for (i = j; i < ROTORS; i++) {
            column[i] = S[i][j];
            for (h = 0; h < j; h++) {
                column[i] -= S[i][h] * S[j][h] / S[h][h];
            }
        }
        S[j][j] = 1 / column[j];
        for (i = j + 1; i < ROTORS; i++) {
            S[i][j] = column[i] * S[j][j];
        }
    }
}

/* One stage of it, from the cost to go after, which n->P and `to_go` hold, to the one before; writes the gains. */
static void recur(flypend_nmpc *n, const real *F, const real *d, real *gain)
{
    real *p = n->to_go + OF_P, *p_e = n->to_go + OF_P_E, *shared = n->to_go + OF_SHARED;
    const real *cost = n->cost;
    real p_d[D], x[W], e[W], Q_u[ROTORS][W], S[ROTORS][ROTORS], sum[8];
    real *k = gain + ROTORS * D, *k_e = k + ROTORS;
    int i, j, f, b;

    times_slopes(n, F);
    shared[0] += cost[OF_C];
    shared[1] += cost[OF_C + 1];
    for (i = 0; i < D; i++) {
        p_d[i] = p[i];
        for (j = 0; j < D; j++) {
            p_d[i] += n->P[i][j] * d[j];
        }
        shared[1] += d[i] * p_e[i];
    }
    for (j = 0; j < W; j++) {
        x[j] = cost[j];
        e[j] = cost[W + j];
        for (f = F_COLUMN[j]; f < F_COLUMN[j + 1]; f++) {
            x[j] += F[f] * p_d[F_ROW[f]];
            e[j] += F[f] * p_e[F_ROW[f]];
        }
    }
    for (i = 0; i < ROTORS; i++) {
        for (b = 0; b < W; b += 8) {
            const int from = (b < W - 8) ? b : W - 8;
            curve(n, F, D + i, from, &Q_u[i][from]);
        }
        for (j = 0; j < ROTORS; j++) {
            S[i][j] = Q_u[i][D + j];
        }
        S[i][i] += cost[OF_R + i] + n->damping;
        k[i] = x[D + i];
        k_e[i] = e[D + i];
        for (j = 0; j < D; j++) {
            gain[i * D + j] = Q_u[i][j];
        }
    }
    factorise(S);
    solve(S, k, 1);
    solve(S, k_e, 1);
    for (j = 0; j < D; j++) {
        solve(S, gain + j, D);
    }
    for (i = 0; i < D; i++) {
        for (b = (i / 8) * 8; b < D; b += 8) {
            const int from = (b < W - 8) ? b : W - 8;
            curve(n, F, i, from, sum);
            for (j = (i > from) ? i : from; (j < from + 8) && (j < D); j++) {
                real entry = sum[j - from];
                for (f = 0; f < ROTORS; f++) {
                    entry += Q_u[f][i] * gain[f * D + j];
                }
                n->P[i][j] = entry;
            }
        }
        n->P[i][i] += $state_damping * n->damping;
        p[i] = x[i];
        p_e[i] = e[i];
        for (j = 0; j < ROTORS; j++) {
            p[i] += Q_u[j][i] * k[j];
            p_e[i] += Q_u[j][i] * k_e[j];
        }
    }
    for (i = 0; i < CURVED; i++) {
        if (Q_ROW[i] <= Q_COLUMN[i]) {
            n->P[Q_ROW[i]][Q_COLUMN[i]] += cost[OF_Q + i];
        }
    }
    for (j = 0; j < ROTORS; j++) {
        shared[0] += k_e[j] * e[D + j];
        shared[1] += k[j] * e[D + j];
    }
    for (i = 0; i < D; i++) {
        for (j = i + 1; j < D; j++) {
            n->P[j][i] = n->P[i][j];
        }
    }
}

/* delta after a stage. */
static void ahead(const real *F, const real *gap, const real *delta, const real *upsilon, real *after)
{
    int i, f;
    for (i = 0; i < D; i++) {
        after[i] = gap[i];
    }
    for (i = 0; i < W; i++) {
        const real by = (i < D) ? delta[i] : upsilon[i - D];
        for (f = F_COLUMN[i]; f < F_COLUMN[i + 1]; f++) {
            after[F_ROW[f]] += F[f] * by;
        }
    }
}

/* The largest multiplier of the motion: n->to_go holds p of the end, and n->P its P. */
static real price_of(flypend_nmpc *n, int first, int count, real epsilon)
{
    real largest = 1, costate[D], before[D];
    int i, k, f;
    for (i = 0; i < D; i++) {
        costate[i] = n->to_go[OF_P + i];
        for (f = 0; f < D; f++) {
            costate[i] += n->P[i][f] * n->delta[count][f];
        }
    }
    for (k = count; k > 0; k--) {
        const real *delta = n->delta[k - 1];
        for (i = 0; i < D; i++) {
            largest = most(largest, $price * size_of(costate[i]));
        }
        $call_terms_before
        for (i = 0; i < D; i++) {
            before[i] = n->cost[i] + n->cost[W + i] * epsilon + $state_damping * n->damping * delta[i];
            for (f = F_COLUMN[i]; f < F_COLUMN[i + 1]; f++) {
                before[i] += n->slopes[k - 1][f] * costate[F_ROW[f]];
            }
        }
        for (i = 0; i < CURVED; i++) {
            before[Q_ROW[i]] += n->cost[OF_Q + i] * delta[Q_COLUMN[i]];
        }
        for (i = 0; i < D; i++) {
            costate[i] = before[i];
        }
    }
    return largest;
}

static void end_at(flypend_nmpc *n, const real *state, real ball_weight)
{
    int i, j, at = 0;
    $call_ending
    for (j = 0; j < D; j++) {
        for (i = 0; i <= j; i++) {
            n->P[i][j] = n->to_go[at];
            n->P[j][i] = n->to_go[at];
            at++;
        }
    }
    n->to_go[OF_SHARED + 1] = ball_weight;
}

/* An iteration ------------------------------------------------------------------------------------------------- */

/* Let the ball hold the states of `count` stages from `first` on. */
static void fit(flypend_nmpc *n, int first, int count)
{
    int k;
    for (k = first; k <= first + count; k++) {
        n->shared = most(n->shared, $ball_share * squared(n->best.states[k]) + $ball_more);
    }
}

/* A step on `count` stages from `first` on, the first of which lasts as the `phase` has it. Whether it succeeded. */
static int iterate(flypend_nmpc *n, int first, int count, int phase)
{
    static const real shrinks[$tries] = {$shrinks};
    real (*x)[STATE] = n->best.states + first, (*u)[ROTORS] = n->best.commands + first;
    real (*slack)[LIMITS] = n->slack + first, (*dual)[LIMITS] = n->dual + first;
    real epsilon, price, ball_weight, merit, gap = 0, turns = 0, longest = 0, length, dual_length, upsilon[ROTORS];
    real shared, found;
    int i, j, k, tried;

    fit(n, first, count);
    ball_weight = (n->shared > n->been) ? $ball_weight : $ball_sunk;
    for (k = 0; k < count; k++) {
        real own;
        (void)own;
        $call_limits
        for (i = 0; i < LIMITS; i++) {
            const real middle = $barrier / slack[k][i];
            dual[k][i] = least(most(dual[k][i], middle / $spread), middle * $spread);
        }
    }
    end_at(n, x[count], ball_weight);
    for (k = count - 1; k >= 0; k--) {
        const real *timing = timings[(k == 0) ? phase : 0];
        $call_linearised
        $call_terms
        recur(n, n->slopes[k], n->gap[k], n->gains[k]);
        for (i = 0; i < D; i++) {
            gap += size_of(n->gap[k][i]);
        }
    }
    epsilon = -n->to_go[OF_SHARED + 1] / n->to_go[OF_SHARED];
    for (i = 0; i < D; i++) {
        n->delta[0][i] = 0;
    }
    for (k = 0; k < count; k++) {
        const real *gain = n->gains[k], *delta = n->delta[k];
        real share;
        for (i = 0; i < ROTORS; i++) {
            upsilon[i] = gain[ROTORS * D + i] + gain[ROTORS * (D + 1) + i] * epsilon;
            for (j = 0; j < D; j++) {
                upsilon[i] += gain[i * D + j] * delta[j];
            }
        }
        ahead(n->slopes[k], n->gap[k], delta, upsilon, n->delta[k + 1]);
        $call_steps
        longest = most(longest, share);
        for (i = 0; i < 3; i++) {
            turns = most(turns, size_of(n->delta[k + 1][6 + i]));
        }
        turns = most(turns, most(size_of(n->delta[k + 1][12]), size_of(n->delta[k + 1][13])));
    }
    end_at(n, x[count], ball_weight);
    price = price_of(n, first, count, epsilon);
    merit = merit_of(n, count, x, u, slack, n->shared, ball_weight, price * gap);
    merit += $rounding * size_of(merit);
    dual_length = (longest > $room) ? $room / longest : 1;
    length = (turns > $turn) ? $turn / turns : 1;
    for (tried = 0; tried < $tries; tried++) {
        length *= shrinks[tried];
        shared = n->shared + length * epsilon;
        for (i = 0; i < STATE; i++) {
            n->new_states[0][i] = x[0][i];
        }
        for (k = 0; k < count; k++) {
            const real *timing = timings[(k == 0) ? phase : 0];
            $call_rollout
            shared = most(shared, squared(n->new_states[k]) + most((1 - $room) * slack[k][BALL], $least_room));
        }
        found = merit_of(n, count, n->new_states, n->new_commands, n->new_slack, shared, ball_weight,
            price * (1 - length) * gap);
        if (found < merit) {
            break;
        }
    }
    if (tried == $tries) {
        n->damping = least($worse * n->damping, $most_damping);
        return 0;
    }
    if (tried == 0) {
        n->damping = most($better * n->damping, $least_damping);
    }
    n->shared = shared;
    for (k = 0; k < count; k++) {
        for (i = 0; i < STATE; i++) {
            x[k + 1][i] = n->new_states[k + 1][i];
        }
        for (i = 0; i < ROTORS; i++) {
            u[k][i] = n->new_commands[k][i];
        }
        for (i = 0; i < LIMITS; i++) {
            slack[k][i] = n->new_slack[k][i];
            dual[k][i] += dual_length * n->dual_step[k][i];
        }
    }
    return 1;
}

/* In flight ---------------------------------------------------------------------------------------------------- */

void flypend_nmpc_begin(flypend_nmpc *n, const flypend_nmpc_table *plan)
{
    int i, k;
    n->begun = plan;
    for (k = 0; k <= ALL; k++) {
        const int from = (k < STAGES) ? k : STAGES;
        for (i = 0; i < STATE; i++) {
            n->best.states[k][i] = plan->states[from][i];
            n->flown.states[k][i] = plan->states[from][i];
        }
        for (i = 0; i < ROTORS; i++) {
            n->best.commands[k][i] = least(most(plan->commands[from][i], $inside_low), $inside_high);
            n->flown.commands[k][i] = plan->commands[from][i];
        }
    }
    n->flown.first = 0;
    n->flown.since = 0;
    n->shared = 0;
    n->been = 0;
    n->damping = $damping;
    n->ready = 0;
    n->failed = 0;
    n->next = 1;
    fit(n, 0, ALL);
    for (k = 0; k < ALL; k++) {
        real own, (*x)[STATE] = n->best.states, (*u)[ROTORS] = n->best.commands, (*slack)[LIMITS] = n->slack;
        (void)own;
        $call_limits
        for (i = 0; i < LIMITS; i++) {
            n->dual[k][i] = $barrier / n->slack[k][i];
        }
    }
}

/* 0 if all of a state with rotor forces, and t, are finite; else not a number. */
static real join(real t, const real *state, const real *rotors, real *here)
{
    real sum = 0 * t;
    int i;
    for (i = 0; i < STATE; i++) {
        here[i] = (i < 24) ? state[i] : rotors[i - 24];
        sum += 0 * here[i];
    }
    return sum;
}

/* The command of the plan at t for a state `here`, and the deviation; 0 if it is finite, else not a number. */
static real follow(const flypend_nmpc *n, volatile real *w, real t, const real *here, real *command, real *off)
{
    real nominal[STATE], begun[STATE], wanted[ROTORS], into, sum = 0;
    int i, j, k = STAGES - 1;
    (void)w;
    if (t < stage * ((real)k - $short)) {
        k = (t > 0) ? (int)(t / stage + $short) : 0;
    }
    into = t - stage * (real)k - ((k == n->flown.first) ? n->flown.since : 0);
    for (i = 0; i < STATE; i++) {
        begun[i] = n->flown.states[k][i] * units[i] + ((i < 3) ? target[i] : 0);
        nominal[i] = begun[i];
    }
    for (i = 0; i < ROTORS; i++) {
        wanted[i] = n->flown.commands[k][i] * units[24];
    }
    if (into > $short * stage) {
        $call_advance
    }
    $call_deviation
    for (i = 0; i < ROTORS; i++) {
        command[i] = wanted[i];
        for (j = 0; j < OFF; j++) {
            command[i] -= n->begun->gains[k][i][j] * off[j];
        }
        sum += 0 * command[i];
        command[i] = least(most(command[i], $low), $high);
    }
    return sum;
}

int flypend_nmpc_command(flypend_nmpc *n, real t, const real *state, const real *rotors, real *command)
{
    real here[STATE], off[OFF], forces[ROTORS], sum = join(t, state, rotors, here), rod, pivot;
    int i, k;
    if (n->ready && (t >= n->due - $short * stage)) {
        const int count = (STAGES - n->best.first > LEAST) ? STAGES - n->best.first : LEAST;
        for (k = n->best.first; k <= n->best.first + count; k++) {
            for (i = 0; i < STATE; i++) {
                n->flown.states[k][i] = n->best.states[k][i];
            }
            for (i = 0; (i < ROTORS) && (k < n->best.first + count); i++) {
                n->flown.commands[k][i] = n->best.commands[k][i];
            }
        }
        n->flown.first = n->best.first;
        n->flown.since = n->best.since;
        n->ready = 0;
    }
    if ((sum >= 0) && (t >= stage * (real)STAGES)) {
        return 2;
    }
    sum += follow(n, n->control_scratch, t, here, forces, off);
    rod = squared(off + 12);
    pivot = squared(off);
    if (!((rod < $far_rod) && (pivot < $far_pivot) && (sum >= 0)) || (n->failed >= $most_failed)) {
        return 1;
    }
    for (i = 0; i < ROTORS; i++) {
        command[i] = forces[i];
    }
    return 0;
}

int flypend_nmpc_improve(flypend_nmpc *n, real t, const real *state, const real *rotors)
{
    real here[STATE], off[OFF], command[ROTORS], sum = join(t, state, rotors, here), h, at = 0;
    int i, k, first, count, good, next;
    if (n->ready || !(sum >= 0) || (t < 0) || !(t < stage * (real)STAGES)) {
        return 2;
    }
    next = 1 + (int)(t / tick + $short);
    first = next / PHASES;
    if ((next < n->next) || (first >= STAGES)) {
        return 2;
    }
    count = (STAGES - first > LEAST) ? STAGES - first : LEAST;
    h = (tick * (real)next - t) / AHEAD;
    for (i = 0; i < 3; i++) {
        off[i] = (here[i] - target[i]) / units[i];
    }
    n->been = most(n->been, squared(off));
    for (k = 0; (k < AHEAD) && (h > $short * tick); k++) {
        const real *begun = here, *wanted = command, into = h;
        real *nominal = here;
        sum += follow(n, n->scratch, t + at, here, command, off);
        $call_advance_here
        at += h;
    }
    n->next = next + 1;
    n->best.first = first;
    n->best.since = tick * (real)(next - PHASES * first);
    n->due = tick * (real)next;
    for (i = 0; i < STATE; i++) {
        n->best.states[first][i] = (here[i] - ((i < 3) ? target[i] : 0)) / units[i];
    }
    good = iterate(n, first, count, next - PHASES * first);
    n->failed = good ? 0 : n->failed + 1;
    n->ready = good;
    return good ? 0 : 1;
}
