/* The $law law for the vehicle $vehicle, by flypend $version. Generated: change the law, not this file. */
#include "flypend_law.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-ffast-math and -ffinite-math-only let a compiler assume that no number is NaN, and drop the checks below"
#endif

/* Lengths of the records, as numbers in their order. STATE is without the external forces. */
#define FLYPEND_STATE 24
#define FLYPEND_FORCES 6
#define FLYPEND_REFERENCE $reference_length
#define FLYPEND_PATH $path_length
#define FLYPEND_GAINS $gains_length
#define FLYPEND_PARAMS_LENGTH $params_length
#define FLYPEND_MARK $mark
/* Where attitude and rates lie in a state. */
#define FLYPEND_R 6
#define FLYPEND_TURNING 12
/* Numbers that the bare law works with. */
#define FLYPEND_LAW_SCRATCH $law_scratch

const flypend_gains flypend_default_gains = $gains;
const flypend_params flypend_default_params = $params;

$programs

$conversions

$checks
static int spins_as_written(const flypend_real *spin)
{
    static const flypend_real written[FLYPEND_ROTORS] = {$spins};
    int same = 1;
    for (int i = 0; i < FLYPEND_ROTORS; i++) {
        same = same && (spin[i] * written[i] > 0);
    }
    return same;
}

static flypend_status check_params(const flypend_real *p)
{
    if (!numbers(p, FLYPEND_PARAMS_LENGTH)) {
        return FLYPEND_NOT_FINITE;
    }
    if (!spins_as_written(p + $place_spin)) {
        return FLYPEND_WRONG_VEHICLE;
    }
    const int bodies = (p[$place_mass] > 0) && (p[$place_bob_mass] > 0) && (p[$place_rod_length] > 0)
        && (p[$place_gravity] >= 0) && $positive_inertia;
    const int rotors = (p[$place_rotor_least] >= 0) && (p[$place_rotor_largest] > p[$place_rotor_least]);
    return (bodies && rotors) ? FLYPEND_OK : FLYPEND_PARAMS;
}

/* Safe answers ------------------------------------------------------------------------------------------------- */

/* The wrench w for the numbers s of a state, null for none, and p of usable parameters: it levels the vehicle if its
 * attitude can be trusted, and has no moment and the least thrust if not. Like all functions with it, it works in `rest`,
 * FLYPEND_SCRATCH numbers. */
static void safe_wrench(flypend_real *rest, const flypend_real *s, const flypend_real *p, flypend_real *w)
{
    const flypend_real least = FLYPEND_ROTORS * p[$place_rotor_least];
    if ((s != NULL) && numbers(s + FLYPEND_R, FLYPEND_TURNING) && is_rotation(rest, s)) {
        $call_hold
        if (numbers(w, 4)) {
            return;
        }
    }
    w[0] = numbers(&least, 1) ? least : 0;
    for (int i = 1; i < 4; i++) {
        w[i] = 0;
    }
}

static void least_forces(const flypend_real *p, flypend_real *forces)
{
    for (int i = 0; i < FLYPEND_ROTORS; i++) {
        forces[i] = p[$place_rotor_least];
    }
}

static void safe_command(flypend_real *rest, const flypend_real *s, const flypend_real *p, flypend_real *command)
{
    flypend_real w[4];
    safe_wrench(rest, s, p, w);
    $call_share_safe
    if (!numbers(command, FLYPEND_ROTORS)) {
        least_forces(p, command);
    }
}

static flypend_status usable_params(const flypend_params *params)
{
    return (params == NULL) ? FLYPEND_NULL : check_params(params_numbers(params));
}

static void copy(const flypend_real *from, flypend_real *to, int count)
{
    for (int i = 0; i < count; i++) {
        to[i] = from[i];
    }
}

static void stop(flypend_real *values, int count)
{
    for (int i = 0; i < count; i++) {
        values[i] = 0;
    }
}

/* The least forces, or none with unusable parameters. */
static flypend_status safe_rotors(flypend_status status, const flypend_real *p, flypend_rotors *rotors)
{
    flypend_real forces[FLYPEND_ROTORS];
    stop(forces, FLYPEND_ROTORS);
    if (p != NULL) {
        least_forces(p, forces);
    }
    rotors_of(forces, rotors);
    return status;
}

/* The flight computer ------------------------------------------------------------------------------------------ */

/* The gains as numbers: the struct holds nothing else. */
static const flypend_real *gains_numbers(const flypend_gains *gains)
{
    return (const flypend_real *)gains;
}

/* What `check` holds as long as nobody but the functions below has written to the board. */
static uint32_t check_of(const flypend_board *board)
{
    const uint32_t h = check_word(FLYPEND_MARK, gains_numbers(&board->gains), FLYPEND_GAINS);
    return check_word(h, board->memory, FLYPEND_MEMORY);
}

static int has_begun(const flypend_board *board)
{
    return (board != NULL) && (board->mark == FLYPEND_MARK) && (board->check == check_of(board));
}

flypend_status flypend_board_begin(flypend_board *board, const flypend_gains *gains, const flypend_params *params)
{
    return flypend_board_restart(board, gains, params, NULL);
}

flypend_status flypend_board_restart(flypend_board *board, const flypend_gains *gains, const flypend_params *params,
                                     const flypend_rotors *rotors)
{
    flypend_real forces[FLYPEND_ROTORS];
    flypend_status status;
    if (board == NULL) {
        return FLYPEND_NULL;
    }
    board->mark = 0;
    status = (gains == NULL) ? FLYPEND_NULL : usable_params(params);
    if (status != FLYPEND_OK) {
        return status;
    }
    if (rotors == NULL) {
        least_forces(params_numbers(params), forces);
    } else {
        copy(rotors_numbers(rotors), forces, FLYPEND_ROTORS);
    }
    if (!(numbers(forces, FLYPEND_ROTORS) && numbers(gains_numbers(gains), FLYPEND_GAINS))) {
        return FLYPEND_NOT_FINITE;
    }
    $call_begin
    board->gains = *gains;
    board->mark = FLYPEND_MARK;
    board->check = check_of(board);
    return FLYPEND_OK;
}

flypend_status flypend_board_set_gains(flypend_board *board, const flypend_gains *gains)
{
    if ((board == NULL) || (gains == NULL)) {
        return FLYPEND_NULL;
    }
    if (!has_begun(board)) {
        return FLYPEND_NOT_BEGUN;
    }
    if (!numbers(gains_numbers(gains), FLYPEND_GAINS)) {
        return FLYPEND_NOT_FINITE;
    }
    board->gains = *gains;
    board->check = check_of(board);
    return FLYPEND_OK;
}

static flypend_status try_board(flypend_board *board, const flypend_measurement *measurement,
                                const flypend_path *reference, const flypend_real *p)
{
    flypend_scratch *in = &board->scratch;
$board_locals    if ($board_null) {
        return FLYPEND_NULL;
    }
$board_fill    if (!numbers(in->measurement + 1, FLYPEND_STATE)$board_finite) {
        return FLYPEND_NOT_FINITE;
    }
    const flypend_status status = check_state(in->rest, in->measurement + 1);
    if (status != FLYPEND_OK) {
        return status;
    }
    $call_board
    return (numbers(in->command, FLYPEND_ROTORS) && numbers(in->memory, FLYPEND_MEMORY)) ? FLYPEND_OK : FLYPEND_SINGULAR;
}

static void remember(flypend_board *board)
{
    copy(board->scratch.memory, board->memory, FLYPEND_MEMORY);
    board->check = check_of(board);
}

flypend_status flypend_board_step(flypend_board *board, const flypend_measurement *measurement,
                                  const flypend_path *reference, const flypend_params *params, flypend_rotors *rotors)
{
    if (rotors == NULL) {
        return FLYPEND_NULL;
    }
    flypend_status status = usable_params(params);
    const int usable = status == FLYPEND_OK;
    const flypend_real *p = params_numbers(params);
    if (board == NULL) {
        return safe_rotors(FLYPEND_NULL, usable ? p : NULL, rotors);
    }
    flypend_scratch *in = &board->scratch;
    const int begun = has_begun(board);
    in->measurement[0] = 0; /* the time, on which the law does not depend */
    if (measurement != NULL) {
        copy(measurement_numbers(measurement), in->measurement + 1, FLYPEND_STATE);
    }
    if (usable) {
        status = begun ? try_board(board, measurement, reference, p) : FLYPEND_NOT_BEGUN;
        if (status != FLYPEND_OK) {
            safe_command(in->rest, (measurement == NULL) ? NULL : in->measurement + 1, p, in->command);
        }
    } else {
        stop(in->command, FLYPEND_ROTORS);
    }
    if (begun) {
        if (status != FLYPEND_OK) {
            $call_unmeasured
        }
        remember(board);
    }
    rotors_of(in->command, rotors);
    return status;
}

flypend_status flypend_board_pass(flypend_board *board)
{
    if (board == NULL) {
        return FLYPEND_NULL;
    }
    if (!has_begun(board)) {
        return FLYPEND_NOT_BEGUN;
    }
    $call_pass
    remember(board);
    return FLYPEND_OK;
}

/* The law alone ------------------------------------------------------------------------------------------------ */

static flypend_status try_step(flypend_real *rest, const flypend_real *s, const flypend_reference *reference,
                               const flypend_gains *gains, const flypend_real *p, flypend_real *w)
{
$step_locals    if ($step_null) {
        return FLYPEND_NULL;
    }
$step_fill    if (!numbers(s, FLYPEND_STATE + FLYPEND_FORCES)$step_finite) {
        return FLYPEND_NOT_FINITE;
    }
    const flypend_status status = check_state(rest, s);
    if (status != FLYPEND_OK) {
        return status;
    }
    $call_law
    return numbers(w, 4) ? FLYPEND_OK : FLYPEND_SINGULAR;
}

flypend_status flypend_step(const flypend_state *state, const flypend_reference *reference, const flypend_gains *gains,
                            const flypend_params *params, flypend_wrench *wrench)
{
    flypend_real w[4];
    if (wrench == NULL) {
        return FLYPEND_NULL;
    }
    const flypend_real *p = params_numbers(params);
    const flypend_real *s = state_numbers(state);
    flypend_status status = usable_params(params);
    if (status != FLYPEND_OK) {
        stop(w, 4);
    } else {
        flypend_real rest[FLYPEND_LAW_SCRATCH];
        status = try_step(rest, s, reference, gains, p, w);
        if (status != FLYPEND_OK) {
            safe_wrench(rest, s, p, w);
        }
    }
    wrench_of(w, wrench);
    return status;
}

flypend_status flypend_follow(const flypend_path *path, const flypend_state *state, const flypend_params *params,
                              flypend_reference *reference)
{
    flypend_real r[FLYPEND_REFERENCE];
    if (reference == NULL) {
        return FLYPEND_NULL;
    }
    const flypend_real *p = params_numbers(params);
    /* Hover at the origin with the rod upright, or, without a vehicle, all 0. */
    stop(r, FLYPEND_REFERENCE);
    flypend_status status = usable_params(params);
    if (status == FLYPEND_OK) {
        r[$place_p + 2] = p[$place_rod_length];
        status = ((path == NULL) || (state == NULL)) ? FLYPEND_NULL : FLYPEND_OK;
    }
    reference_of(r, reference);
    if (status == FLYPEND_OK) {
$rest_carry        const flypend_real *s = state_numbers(state);
        const flypend_real *along = path_numbers(path);
        if (!(numbers(along, FLYPEND_PATH) && numbers(s, FLYPEND_STATE + FLYPEND_FORCES))) {
            return FLYPEND_NOT_FINITE;
        }
        $call_carry
        if (!numbers(r, FLYPEND_REFERENCE)) {
            return FLYPEND_SINGULAR;
        }
        reference_of(r, reference);
    }
    return status;
}

flypend_status flypend_mix(const flypend_wrench *wrench, const flypend_params *params, flypend_rotors *rotors)
{
    flypend_real forces[FLYPEND_ROTORS];
$rest_share    if (rotors == NULL) {
        return FLYPEND_NULL;
    }
    const flypend_real *p = params_numbers(params);
    const flypend_real *w = wrench_numbers(wrench);
    const flypend_status status = usable_params(params);
    if (status != FLYPEND_OK) {
        return safe_rotors(status, NULL, rotors);
    }
    if (wrench == NULL) {
        return safe_rotors(FLYPEND_NULL, p, rotors);
    }
    if (!numbers(w, 4)) {
        return safe_rotors(FLYPEND_NOT_FINITE, p, rotors);
    }
    $call_share
    if (!numbers(forces, FLYPEND_ROTORS)) {
        return safe_rotors(FLYPEND_SINGULAR, p, rotors);
    }
    rotors_of(forces, rotors);
    return FLYPEND_OK;
}

flypend_status flypend_unmix(const flypend_rotors *rotors, const flypend_params *params, flypend_wrench *wrench)
{
    flypend_real w[4];
$rest_gather    if (wrench == NULL) {
        return FLYPEND_NULL;
    }
    const flypend_real *p = params_numbers(params);
    const flypend_real *forces = rotors_numbers(rotors);
    flypend_status status = usable_params(params);
    if ((status == FLYPEND_OK) && (rotors == NULL)) {
        status = FLYPEND_NULL;
    }
    if (status == FLYPEND_OK) {
        $call_gather
        if (!numbers(w, 4)) {
            status = numbers(forces, FLYPEND_ROTORS) ? FLYPEND_SINGULAR : FLYPEND_NOT_FINITE;
        }
    }
    if (status != FLYPEND_OK) {
        stop(w, 4);
    }
    wrench_of(w, wrench);
    return status;
}

flypend_status flypend_lead(const flypend_rotors *wanted, const flypend_rotors *modelled, flypend_real lead,
                            const flypend_params *params, flypend_rotors *command)
{
    flypend_real to[FLYPEND_ROTORS];
$rest_quicken    if (command == NULL) {
        return FLYPEND_NULL;
    }
    const flypend_real *p = params_numbers(params);
    const flypend_real *from = rotors_numbers(modelled);
    const flypend_status status = usable_params(params);
    if (status != FLYPEND_OK) {
        return safe_rotors(status, NULL, command);
    }
    if ((wanted == NULL) || (modelled == NULL)) {
        return safe_rotors(FLYPEND_NULL, p, command);
    }
    copy(rotors_numbers(wanted), to, FLYPEND_ROTORS);
    if (!(numbers(to, FLYPEND_ROTORS) && numbers(from, FLYPEND_ROTORS) && numbers(&lead, 1))) {
        return safe_rotors(FLYPEND_NOT_FINITE, p, command);
    }
    $call_quicken /* within the limits, whatever overflows, but where 0 times infinity is no number */
    if (!numbers(to, FLYPEND_ROTORS)) {
        return safe_rotors(FLYPEND_NOT_FINITE, p, command);
    }
    rotors_of(to, command);
    return FLYPEND_OK;
}
