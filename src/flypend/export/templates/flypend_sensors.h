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

/* How many numbers are remembered. */
#define FLYPEND_SENSORS_MEMORY $sensors_memory

$readings_struct

/* The flight computer between two control periods. */
typedef struct {
    /* set by flypend_sensors_begin */
    unsigned long mark;
    /* gains of the law; may be changed between two steps */
    flypend_gains gains;
    flypend_real memory[FLYPEND_SENSORS_MEMORY];
} flypend_sensors;

/* Prepares for a vehicle whose rotors give their least force, and that is about where `estimate` says: within the
 * standard deviations $start. */
flypend_status flypend_sensors_begin(flypend_sensors *computer, const flypend_gains *gains, const flypend_params *params,
                                     const flypend_state *estimate);

/* The flight computer, once every FLYPEND_PERIOD: rotor forces to command now for the readings that have arrived.
 *
 * Null or unsound readings (not finite, FLYPEND_ROD, FLYPEND_ATTITUDE) are ignored as a whole and told, and the estimate
 * goes on by the model. With unusable parameters the rotors are at 0; if the answer is not finite (FLYPEND_SINGULAR) or the
 * computer has not begun, at their least force, and nothing is remembered. */
flypend_status flypend_sensors_step(flypend_sensors *computer, const flypend_readings *readings,
                                    const flypend_path *reference, const flypend_params *params, flypend_rotors *rotors);

/* The estimate that the last step was computed for, moved on by one period. */
flypend_status flypend_sensors_estimate(const flypend_sensors *computer, flypend_state *estimate);

#ifdef __cplusplus
}
#endif
#endif
