/* $title
 *
 * A plan that is planned again in flight. Two tasks share one flypend_nmpc, in static memory:
 *  - at every tick of the control loop, flypend_nmpc_command: feedback about the newest plan;
 *  - with a lower priority, every FLYPEND_NMPC_TICK seconds, flypend_nmpc_improve: one iteration, begun from the last
 *    one, of the rest of the plan from where the flight is. The control task takes its result over when it is due.
 * Time t begins with the plan. SI units, world frame with e3 up. A state has 24 numbers: position of the pivot, its
 * velocity, the rotation from body to world row by row, angular velocity in the body frame, direction of the rod and its
 * rate. Predict it to the time at which a command acts, and add that delay to t.
 *
 * No heap, no recursion, and sqrt is all that it needs of a library. The work of a call is bounded: an iteration tries
 * $tries lengths of its step at most. */
#ifndef FLYPEND_NMPC_H
#define FLYPEND_NMPC_H

#define FLYPEND_NMPC_ROTORS $rotors
#define FLYPEND_NMPC_STAGES $stages
#define FLYPEND_NMPC_STAGE $stage /* s */
#define FLYPEND_NMPC_TICK $tick /* s */
#define FLYPEND_NMPC_DURATION $duration /* s; then a law hovers */

#ifdef __cplusplus
extern "C" {
#endif

$real

/* Lengths: of a state with rotor forces, of its coordinates, of the inequalities of a stage, and so on. All stages are
 * those of the plan and hover behind it; the horizon has at most FLYPEND_NMPC_STAGES. */
enum {
    FLYPEND_NMPC_STATE = 24 + FLYPEND_NMPC_ROTORS,
    FLYPEND_NMPC_D = 16 + FLYPEND_NMPC_ROTORS,
    FLYPEND_NMPC_LIMITS = 2 * FLYPEND_NMPC_ROTORS + 1,
    FLYPEND_NMPC_GAINS = FLYPEND_NMPC_ROTORS * (FLYPEND_NMPC_D + 2),
    FLYPEND_NMPC_SLOPES = $slopes,
    FLYPEND_NMPC_ALL = $all,
    FLYPEND_NMPC_SCRATCH = $scratch
};

/* A plan to begin with: nominal states and rotor forces at the beginning of each stage and at the end, and commands, the
 * last for hover, all in units of its own about the target; gains in SI units. Other plans for the same vehicle and target,
 * with as many stages of the same duration, may take the place of the exported one. */
typedef struct {
    flypend_real states[FLYPEND_NMPC_STAGES + 1][FLYPEND_NMPC_STATE];
    flypend_real commands[FLYPEND_NMPC_STAGES + 1][FLYPEND_NMPC_ROTORS];
    flypend_real gains[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_ROTORS][18 + FLYPEND_NMPC_ROTORS];
} flypend_nmpc_table;
extern const flypend_nmpc_table flypend_nmpc_exported;

/* A plan, in units of its own about the target; the state of stage `first` is that `since` seconds after its beginning. */
typedef struct {
    flypend_real states[FLYPEND_NMPC_ALL + 1][FLYPEND_NMPC_STATE];
    flypend_real commands[FLYPEND_NMPC_ALL + 1][FLYPEND_NMPC_ROTORS];
    flypend_real since;
    int first;
} flypend_nmpc_plan;

typedef struct {
    flypend_nmpc_plan best, flown; /* what is improved, and what is flown */
    const flypend_nmpc_table *begun; /* what it began with */
    flypend_real slack[FLYPEND_NMPC_ALL][FLYPEND_NMPC_LIMITS], dual[FLYPEND_NMPC_ALL][FLYPEND_NMPC_LIMITS];
    flypend_real shared, damping; /* squared radius of the ball that holds the plan */
    flypend_real due;             /* s: when the result of the iteration is taken */
    flypend_real been;            /* squared largest distance so far */
    volatile int ready;           /* whether there is a result that is not taken */
    int next, failed;             /* tick of the next iteration; how many iterations failed in a row */
    /* What an iteration works in, stage by stage of the horizon. */
    flypend_real slopes[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_SLOPES], gap[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_D];
    flypend_real gains[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_GAINS];
    flypend_real delta[FLYPEND_NMPC_STAGES + 1][FLYPEND_NMPC_D], dual_step[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_LIMITS];
    flypend_real new_states[FLYPEND_NMPC_STAGES + 1][FLYPEND_NMPC_STATE];
    flypend_real new_commands[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_ROTORS];
    flypend_real new_slack[FLYPEND_NMPC_STAGES][FLYPEND_NMPC_LIMITS];
    flypend_real to_go[$to_go], cost[$cost];
    flypend_real P[FLYPEND_NMPC_D][FLYPEND_NMPC_D], PF[FLYPEND_NMPC_D][FLYPEND_NMPC_D + FLYPEND_NMPC_ROTORS];
    volatile flypend_real scratch[FLYPEND_NMPC_SCRATCH], control_scratch[FLYPEND_NMPC_SCRATCH];
} flypend_nmpc;

/* Begin with a plan, which has to last as long as it is flown. */
void flypend_nmpc_begin(flypend_nmpc *nmpc, const flypend_nmpc_table *plan);

/* Rotor forces (N), within their limits, for a state and the forces of the rotors at time t (s), before 0 as at 0.
 * Returns 0, or leaves `command` and returns
 *   1 if rod or pivot are too far from the plan, $most_failed iterations in a row failed, an input is not a finite number,
 *     or the answer would not be;
 *   2 if the plan has ended.
 * Then a law has to take over, for good. */
int flypend_nmpc_command(flypend_nmpc *nmpc, flypend_real t, const flypend_real *state, const flypend_real *rotors,
    flypend_real *command);

/* Improve the plan from the next tick after t (s) on, when the result is due, with the flight at `state` and `rotors` at t:
 * there is a tick to compute it, over which the state is predicted. Returns 0; 1 if the iteration failed; 2 if there was
 * nothing to do: t is before 0, a result is not taken yet, the tick had its iteration, the plan has ended, or an input is
 * not a finite number. Unless it returns 0, the plan that is flown stays as it is. */
int flypend_nmpc_improve(flypend_nmpc *nmpc, flypend_real t, const flypend_real *state, const flypend_real *rotors);

#ifdef __cplusplus
}
#endif
#endif
