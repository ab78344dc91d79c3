/* The $law law for the vehicle $vehicle with an estimator, by flypend $version. Generated: change the law, not this file.
 *
 * flypend_sensors_step is the whole flight computer from sensors to rotors: an error-state Kalman filter on position,
 * attitude and rod with modelled thrust, then what flypend_board_step does. Constants of the code: control rate $rate Hz,
 * delay of commands $command_delay s, and rate, noise and latency of each sensor:
$sensor_table
 *
 * Units, frames and guarantees are those of flypend_law.h. The estimate never leaves the manifold, and a period without
 * readings is flown on the model.
 */
#ifndef FLYPEND_SENSORS_H
#define FLYPEND_SENSORS_H

#include "flypend_law.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How many numbers are remembered, and at which of them each part begins. */
$sensors_memory

$readings_struct

/* What a step works with, and forgets. On the stack it would take kilobytes. */
typedef struct {
    flypend_real readings[1 + $readings_length];
    flypend_real command[FLYPEND_ROTORS];
    flypend_real memory[FLYPEND_SENSORS_MEMORY];
    flypend_real rest[$scratch];
} flypend_scratch_of_sensors;

/* The flight computer between two control periods. What flypend_board says of itself holds here too. */
typedef struct {
    /* the code that began it, and a word that every function checks and renews */
    uint32_t mark;
    uint32_t check;
    /* gains of the law: flypend_sensors_set_gains changes them */
    flypend_gains gains;
    flypend_real memory[FLYPEND_SENSORS_MEMORY];
    /* not checked: written before it is read, in every step */
    flypend_scratch_of_sensors scratch;
} flypend_sensors;

/* Prepares for a vehicle whose rotors give their least force, and that is about where `estimate` says: within the
 * standard deviations $start.
 *
 * Returns OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE. After anything but FLYPEND_OK the computer
 * has not begun. */
flypend_status flypend_sensors_begin(flypend_sensors *computer, const flypend_gains *gains, const flypend_params *params,
                                     const flypend_state *estimate);

/* The same in flight, after FLYPEND_NOT_BEGUN: the rotors give the forces `rotors`, and `estimate` is what
 * flypend_sensors_estimate said before. `rotors` may be null: then they give their least force.
 *
 * Returns OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE. After anything but FLYPEND_OK the computer
 * has not begun. */
flypend_status flypend_sensors_restart(flypend_sensors *computer, const flypend_gains *gains,
                                       const flypend_params *params, const flypend_state *estimate,
                                       const flypend_rotors *rotors);

/* Changes the gains between two steps.
 *
 * Returns OK, NULL, NOT_FINITE, NOT_BEGUN. After anything but FLYPEND_OK the computer is as it was. */
flypend_status flypend_sensors_set_gains(flypend_sensors *computer, const flypend_gains *gains);

/* The flight computer, once every FLYPEND_PERIOD: rotor forces to command now for the readings that have arrived.
 *
 * Null or unsound readings (not finite, FLYPEND_ROD, FLYPEND_ATTITUDE) are ignored as a whole and told, and the estimate
 * goes on by the model. With unusable parameters the rotors are at 0; if the answer is not finite (FLYPEND_SINGULAR) or the
 * computer has not begun, at their least force, and nothing is remembered. `reference` may be null if FLYPEND_FOLLOWS
 * is 0.
 *
 * Returns OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE, NOT_BEGUN. */
flypend_status flypend_sensors_step(flypend_sensors *computer, const flypend_readings *readings,
                                    const flypend_path *reference, const flypend_params *params, flypend_rotors *rotors);

/* The estimate that the last step was computed for, moved on by one period.
 *
 * Returns OK, NULL, NOT_BEGUN. After anything but FLYPEND_OK `estimate` is as it was. */
flypend_status flypend_sensors_estimate(const flypend_sensors *computer, flypend_state *estimate);

#ifdef __cplusplus
}
#endif
#endif
