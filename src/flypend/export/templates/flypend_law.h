/* The $law law for the vehicle $vehicle, by flypend $version. Generated: change the law, not this file.
 *
 * SI units. World frame with z up, body frame front-left-up, R takes body to world. The rod points from the pivot,
 * which is the centre of mass of the quadrotor, to the bob: y = (0, 0, 1) is inverted.
 * Nothing here allocates, recurses, loops without a bound or keeps a state; the only function of the C library that is
 * called is the square root. All functions may be called from several threads at once.
 */
#ifndef FLYPEND_LAW_H
#define FLYPEND_LAW_H

#ifdef __cplusplus
extern "C" {
#endif

typedef $precision flypend_real;

#define FLYPEND_ROTORS $rotors
/* 1 if the law reads a reference. */
#define FLYPEND_FOLLOWS $follows
/* How far y may be from a unit vector and y_dot from tangent (relative to 1 + |y_dot|), and R from a rotation. */
#define FLYPEND_TOLERANCE $tolerance
#define FLYPEND_ROTATION_TOLERANCE $rotation_tolerance

typedef enum {
    FLYPEND_OK = 0,
    /* A pointer that must not be null is. */
    FLYPEND_NULL = 1,
    /* An input is not a finite number. */
    FLYPEND_NOT_FINITE = 2,
    /* y is not a unit vector, or y_dot not tangent to the sphere at y. */
    FLYPEND_ROD = 3,
    /* R is not a rotation. */
    FLYPEND_ATTITUDE = 4,
    /* A mass, length, inertia or rotor limit is out of range. */
    FLYPEND_PARAMS = 5,
    /* The law has no finite answer at this state: its numbers overflow, or it is singular there. */
    FLYPEND_SINGULAR = 6
} flypend_status;

$structs

/* What flypend proposes for this vehicle. */
extern const flypend_gains flypend_default_gains;
extern const flypend_params flypend_default_params;

/* The law: the wrench for a state.
 *
 * Anything but FLYPEND_OK comes with the safe wrench: no moment, and the least thrust that the rotors give (none if the
 * parameters are unusable). With an attitude that cannot be trusted any larger thrust would push in a direction that
 * nobody knows; the least one is what a flight computer can take over from. The output is finite in every case.
 * `reference` may be null if FLYPEND_FOLLOWS is 0. */
flypend_status flypend_step(const flypend_state *state, const flypend_reference *reference, const flypend_gains *gains,
                            const flypend_params *params, flypend_wrench *wrench);

/* The reference on a path of the pivot. It leans the rod along the acceleration (and the force on the bob that `state`
 * holds), so the bob's derivatives take those of the path up to the eighth. Hover at a point: only x0 is not 0. */
flypend_status flypend_follow(const flypend_path *path, const flypend_state *state, const flypend_params *params,
                              flypend_reference *reference);

/* Rotor forces for a wrench, each within its limits: roll and pitch first, then thrust, then yaw.
 * Anything but FLYPEND_OK comes with all rotors at their least force (0 if the parameters are unusable). */
flypend_status flypend_mix(const flypend_wrench *wrench, const flypend_params *params, flypend_rotors *rotors);

/* Commands modelled + lead (wanted - modelled) within the limits, for rotors that lag: lead $lead is proposed here, at
 * most 1 / (1 - exp(-h / T)) for a control period h and a lag T. `command` may be `wanted`. Called with the command
 * that acts in place of `wanted` and 1 - exp(-h / T) in place of `lead`, it moves the model on by a period h. */
flypend_status flypend_lead(const flypend_rotors *wanted, const flypend_rotors *modelled, flypend_real lead,
                            const flypend_params *params, flypend_rotors *command);

#ifdef __cplusplus
}
#endif
#endif
