/* The $law law for the vehicle $vehicle, by flypend $version. Generated: change the law, not this file. */
#include "flypend_law.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#ifdef __FAST_MATH__
#error "-ffast-math lets a compiler assume that no number is NaN, and drops the checks below"
#endif

const flypend_gains flypend_default_gains = $gains;
const flypend_params flypend_default_params = $params;

$law_function

$carry

$share

$quicken

$defects

static int number(flypend_real value)
{
    return (value >= -$largest) && (value <= $largest);
}

static int numbers(const flypend_real *values, int count)
{
    int all = 1;
    for (int i = 0; i < count; i++) {
        all = all && number(values[i]);
    }
    return all;
}

$finite

static flypend_status check_params(const flypend_params *params)
{
    if (!finite_params(params)) {
        return FLYPEND_NOT_FINITE;
    }
    const int bodies = (params->mass > 0) && (params->bob_mass > 0) && (params->rod_length > 0)
        && (params->gravity >= 0) && $positive_inertia;
    const int rotors = (params->rotor_least >= 0) && (params->rotor_largest > params->rotor_least);
    return (bodies && rotors) ? FLYPEND_OK : FLYPEND_PARAMS;
}

static flypend_status check_state(const flypend_state *state)
{
    flypend_real defect[5];
    if (!finite_state(state)) {
        return FLYPEND_NOT_FINITE;
    }
    defects(state, defect);
    if (!((defect[0] <= FLYPEND_TOLERANCE) && (defect[1] <= FLYPEND_TOLERANCE * (1 + defect[2])))) {
        return FLYPEND_ROD;
    }
    return ((defect[3] <= FLYPEND_ROTATION_TOLERANCE) && (defect[4] > 0)) ? FLYPEND_OK : FLYPEND_ATTITUDE;
}

/* The least force of a rotor, 0 if that is not known. */
static flypend_real least_force(const flypend_params *params)
{
    const int known = (params != NULL) && (check_params(params) == FLYPEND_OK);
    return (known && number(FLYPEND_ROTORS * params->rotor_least)) ? params->rotor_least : 0;
}

static flypend_status safe_rotors(flypend_status status, const flypend_params *params, flypend_rotors *rotors)
{
    const flypend_real force = least_force(params);
    for (int i = 0; i < FLYPEND_ROTORS; i++) {
        rotors->force[i] = force;
    }
    return status;
}

static flypend_status try_step(const flypend_state *state, const flypend_reference *reference,
                               const flypend_gains *gains, const flypend_params *params, flypend_wrench *wrench)
{
    flypend_status status;
$ignored    if ((state == NULL) || (params == NULL)$null_checks) {
        return FLYPEND_NULL;
    }
$finite_checks    status = check_params(params);
    if (status == FLYPEND_OK) {
        status = check_state(state);
    }
    if (status != FLYPEND_OK) {
        return status;
    }
    $call_law
    return finite_wrench(wrench) ? FLYPEND_OK : FLYPEND_SINGULAR;
}

flypend_status flypend_step(const flypend_state *state, const flypend_reference *reference, const flypend_gains *gains,
                            const flypend_params *params, flypend_wrench *wrench)
{
    flypend_status status;
    if (wrench == NULL) {
        return FLYPEND_NULL;
    }
    status = try_step(state, reference, gains, params, wrench);
    if (status != FLYPEND_OK) {
        wrench->thrust = FLYPEND_ROTORS * least_force(params);
        for (int i = 0; i < 3; i++) {
            wrench->moment[i] = 0;
        }
    }
    return status;
}

/* Hover at the origin with the rod upright, or, without a vehicle, all 0. */
static flypend_status safe_reference(flypend_status status, const flypend_params *params, flypend_reference *reference)
{
    static const flypend_reference still = $still;
    *reference = still;
    if ((params != NULL) && (check_params(params) == FLYPEND_OK)) {
        reference->p[2] = params->rod_length;
    }
    return status;
}

flypend_status flypend_follow(const flypend_path *path, const flypend_state *state, const flypend_params *params,
                              flypend_reference *reference)
{
    flypend_status status;
    if (reference == NULL) {
        return FLYPEND_NULL;
    }
    if ((path == NULL) || (state == NULL) || (params == NULL)) {
        return safe_reference(FLYPEND_NULL, params, reference);
    }
    status = check_params(params);
    if ((status == FLYPEND_OK) && !(finite_path(path) && finite_state(state))) {
        status = FLYPEND_NOT_FINITE;
    }
    if (status == FLYPEND_OK) {
        $call_carry
        status = finite_reference(reference) ? FLYPEND_OK : FLYPEND_SINGULAR;
    }
    return (status == FLYPEND_OK) ? status : safe_reference(status, params, reference);
}

flypend_status flypend_mix(const flypend_wrench *wrench, const flypend_params *params, flypend_rotors *rotors)
{
    flypend_status status;
    if (rotors == NULL) {
        return FLYPEND_NULL;
    }
    if ((wrench == NULL) || (params == NULL)) {
        return safe_rotors(FLYPEND_NULL, params, rotors);
    }
    status = check_params(params);
    if ((status == FLYPEND_OK) && !finite_wrench(wrench)) {
        status = FLYPEND_NOT_FINITE;
    }
    if (status == FLYPEND_OK) {
        share(wrench, params, rotors);
        status = finite_rotors(rotors) ? FLYPEND_OK : FLYPEND_SINGULAR;
    }
    return (status == FLYPEND_OK) ? status : safe_rotors(status, params, rotors);
}

flypend_status flypend_lead(const flypend_rotors *wanted, const flypend_rotors *modelled, flypend_real lead,
                            const flypend_params *params, flypend_rotors *command)
{
    flypend_status status;
    if (command == NULL) {
        return FLYPEND_NULL;
    }
    if ((wanted == NULL) || (modelled == NULL) || (params == NULL)) {
        return safe_rotors(FLYPEND_NULL, params, command);
    }
    status = check_params(params);
    if ((status == FLYPEND_OK) && !(finite_rotors(wanted) && finite_rotors(modelled) && number(lead))) {
        status = FLYPEND_NOT_FINITE;
    }
    if (status == FLYPEND_OK) {
        quicken(wanted, modelled, lead, params, command);
        status = finite_rotors(command) ? FLYPEND_OK : FLYPEND_SINGULAR;
    }
    return (status == FLYPEND_OK) ? status : safe_rotors(status, params, command);
}
