/* The $law law for the vehicle $vehicle with an estimator, by flypend $version. Generated: change the law, not this file. */
#include "flypend_sensors.h"

#include <math.h>
#include <stddef.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-ffast-math and -ffinite-math-only let a compiler assume that no number is NaN, and drop the checks below"
#endif

#define FLYPEND_STATE 24
#define FLYPEND_FORCES 6
#define FLYPEND_READINGS $readings_length
#define FLYPEND_PATH $path_length
#define FLYPEND_GAINS $gains_length
#define FLYPEND_PARAMS_LENGTH $params_length
#define FLYPEND_MARK $mark

$programs

$conversions

$checks
/* The gains as numbers: the struct holds nothing else. */
static const flypend_real *gains_numbers(const flypend_gains *gains)
{
    return (const flypend_real *)gains;
}

/* What `check` holds as long as nobody but the functions below has written to the memory. */
static uint32_t check_of(const flypend_sensors *computer)
{
    const uint32_t h = check_word(FLYPEND_MARK, gains_numbers(&computer->gains), FLYPEND_GAINS);
    return check_word(h, computer->memory, FLYPEND_SENSORS_MEMORY);
}

static int has_begun(const flypend_sensors *computer)
{
    return (computer != NULL) && (computer->mark == FLYPEND_MARK) && (computer->check == check_of(computer));
}

/* Whether the parameters are usable, and the least forces for them. */
static flypend_status least_forces(const flypend_params *params, flypend_rotors *rotors)
{
    const flypend_wrench none = {0, {0, 0, 0}};
    flypend_status status;
    if (params == NULL) {
        for (int i = 0; i < FLYPEND_ROTORS; i++) {
            rotors->force[i] = 0;
        }
        return FLYPEND_NULL;
    }
    status = flypend_mix(&none, params, rotors);
    if (status == FLYPEND_OK) {
        for (int i = 0; i < FLYPEND_ROTORS; i++) {
            rotors->force[i] = params->rotor_least;
        }
    }
    return status;
}

flypend_status flypend_sensors_begin(flypend_sensors *computer, const flypend_gains *gains, const flypend_params *params,
                                     const flypend_state *estimate)
{
    return flypend_sensors_restart(computer, gains, params, estimate, NULL);
}

flypend_status flypend_sensors_restart(flypend_sensors *computer, const flypend_gains *gains,
                                       const flypend_params *params, const flypend_state *estimate,
                                       const flypend_rotors *rotors)
{
    flypend_rotors given;
    if (computer == NULL) {
        return FLYPEND_NULL;
    }
    computer->mark = 0;
    if ((gains == NULL) || (estimate == NULL)) {
        return FLYPEND_NULL;
    }
    const flypend_status usable = least_forces(params, &given);
    if (usable != FLYPEND_OK) {
        return usable;
    }
    if (rotors != NULL) {
        given = *rotors;
    }
    if (!(numbers(given.force, FLYPEND_ROTORS) && numbers(gains_numbers(gains), FLYPEND_GAINS))) {
        return FLYPEND_NOT_FINITE;
    }
    const flypend_real *p = params_numbers(params);
    const flypend_real *s = state_numbers(estimate);
    if (!numbers(s, FLYPEND_STATE + FLYPEND_FORCES)) {
        return FLYPEND_NOT_FINITE;
    }
    const flypend_status state = check_state(computer->scratch.rest, s);
    if (state != FLYPEND_OK) {
        return state;
    }
    $call_begin
    if (!numbers(computer->memory, FLYPEND_SENSORS_MEMORY)) {
        return FLYPEND_SINGULAR;
    }
    computer->gains = *gains;
    computer->mark = FLYPEND_MARK;
    computer->check = check_of(computer);
    return FLYPEND_OK;
}

flypend_status flypend_sensors_set_gains(flypend_sensors *computer, const flypend_gains *gains)
{
    if ((computer == NULL) || (gains == NULL)) {
        return FLYPEND_NULL;
    }
    if (!has_begun(computer)) {
        return FLYPEND_NOT_BEGUN;
    }
    if (!numbers(gains_numbers(gains), FLYPEND_GAINS)) {
        return FLYPEND_NOT_FINITE;
    }
    computer->gains = *gains;
    computer->check = check_of(computer);
    return FLYPEND_OK;
}

/* No readings at all. */
static void nothing(flypend_real *r)
{
    for (int i = 0; i < FLYPEND_READINGS; i++) {
        r[i] = -1;
    }
}

/* The readings as numbers r, and what is wrong with them; works in `rest`. */
static flypend_status check_readings(flypend_real *rest, const flypend_readings *readings, flypend_real *r)
{
    flypend_real defect[2];
    (void)rest;
    if (readings == NULL) {
        return FLYPEND_NULL;
    }
    for (int i = 0; i < FLYPEND_READINGS; i++) {
        r[i] = readings_numbers(readings)[i];
    }
    if (!numbers(r, FLYPEND_READINGS)) {
        return FLYPEND_NOT_FINITE;
    }
    $call_sound
    if (!(defect[0] <= 2 * FLYPEND_TOLERANCE)) {
        return FLYPEND_ROD;
    }
    return (defect[1] <= FLYPEND_ROTATION_TOLERANCE * FLYPEND_ROTATION_TOLERANCE) ? FLYPEND_OK : FLYPEND_ATTITUDE;
}

flypend_status flypend_sensors_step(flypend_sensors *computer, const flypend_readings *readings,
                                    const flypend_path *reference, const flypend_params *params, flypend_rotors *rotors)
{
$locals    if (rotors == NULL) {
        return FLYPEND_NULL;
    }
    const flypend_status usable = least_forces(params, rotors);
    if (usable != FLYPEND_OK) {
        return usable;
    }
    if (computer == NULL$null) {
        return FLYPEND_NULL;
    }
    if (!has_begun(computer)) {
        return FLYPEND_NOT_BEGUN;
    }
    const flypend_real *p = params_numbers(params);
$fill    flypend_scratch_of_sensors *in = &computer->scratch;
    in->readings[0] = 0; /* the time, on which the law does not depend */
    const flypend_status status = check_readings(in->rest, readings, in->readings + 1);
    if (status != FLYPEND_OK) {
        nothing(in->readings + 1);
    }
    $call_board
    if (!(numbers(in->command, FLYPEND_ROTORS) && numbers(in->memory, FLYPEND_SENSORS_MEMORY))) {
        return FLYPEND_SINGULAR;
    }
    for (int i = 0; i < FLYPEND_SENSORS_MEMORY; i++) {
        computer->memory[i] = in->memory[i];
    }
    computer->check = check_of(computer);
    rotors_of(in->command, rotors);
    return status;
}

flypend_status flypend_sensors_estimate(const flypend_sensors *computer, flypend_state *estimate)
{
    flypend_real s[FLYPEND_STATE + FLYPEND_FORCES];
    if ((computer == NULL) || (estimate == NULL)) {
        return FLYPEND_NULL;
    }
    if (!has_begun(computer)) {
        return FLYPEND_NOT_BEGUN;
    }
    for (int i = 0; i < FLYPEND_STATE; i++) {
        s[i] = computer->memory[FLYPEND_SENSORS_MEMORY_ESTIMATE_STATE + i];
    }
    for (int i = FLYPEND_STATE; i < FLYPEND_STATE + FLYPEND_FORCES; i++) {
        s[i] = 0;
    }
    state_of(s, estimate);
    return FLYPEND_OK;
}
