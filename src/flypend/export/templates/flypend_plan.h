/* $title
 *
 * Fly it with flypend_plan_command at every tick, from t = 0 where the plan starts. SI units, world frame with e3 up.
 * A state has 24 numbers: position of the pivot, its velocity, the rotation from body to world row by row, angular
 * velocity in the body frame, direction of the rod and its rate. Predict it to the time at which a command acts, and
 * add that delay to t. */
#ifndef FLYPEND_PLAN_H
#define FLYPEND_PLAN_H

#define FLYPEND_PLAN_ROTORS $rotors
#define FLYPEND_PLAN_STAGES $stages
#define FLYPEND_PLAN_DURATION $duration /* s; then it hovers */

#ifdef __cplusplus
extern "C" {
#endif

$real

/* Rotor forces (N), within their limits, for a state and the forces of the rotors at time t (s), before 0 as at 0.
 * Returns 0; or 1, and leaves `command`, if rod or pivot are too far from the plan, an input is not a finite number, or
 * the answer would not be: then another law has to take over, for good. */
int flypend_plan_command(flypend_real t, const flypend_real *state, const flypend_real *rotors, flypend_real *command);

#ifdef __cplusplus
}
#endif
#endif
