/* The $law law for the vehicle $vehicle, by flypend $version. Generated: change the law, not this file.
 *
 * SI units. World frame with z up, body frame front-left-up, R takes body to world. The rod points from the pivot,
 * which is the centre of mass of the quadrotor, to the bob: y = (0, 0, 1) is inverted.
 *
 * flypend_board_step is the whole flight computer: observer of external forces, prediction over the latency, law,
 * allocation within rotor limits, and lead over the rotors. Constants of the code: control rate $rate Hz, latency
 * $latency s, rotor lag $lag s, lead $lead, bandwidth of the observer $observer 1/s. Gains and vehicle come at run time.
 *
 * Nothing here allocates, recurses or loops without a bound; the only function of the C library that is called is the
 * square root. What is remembered lies in flypend_board. Functions may be called from several threads at once, each
 * with a board of its own. `Returns` lists the statuses of a function, FLYPEND_NULL for each pointer of which the text
 * does not say that it may be null.
 */
#ifndef FLYPEND_LAW_H
#define FLYPEND_LAW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

$real

#define FLYPEND_ROTORS $rotors
/* 1 if the law reads a reference. */
#define FLYPEND_FOLLOWS $follows
/* Control period, s: flypend_board_step is to be called once in each. */
#define FLYPEND_PERIOD $period
/* How many numbers the board remembers, and at which of them each part begins. */
$memory
/* How many more it works with, and forgets. */
#define FLYPEND_SCRATCH $scratch
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
    FLYPEND_SINGULAR = 6,
    /* The rotors of the vehicle spin otherwise than those that the code was written for. */
    FLYPEND_WRONG_VEHICLE = 7,
    /* The board was not begun by this code, or its memory is damaged: call flypend_board_restart. */
    FLYPEND_NOT_BEGUN = 8
} flypend_status;

$structs

/* What a step works with, and forgets. On the stack it would take kilobytes. */
typedef struct {
    flypend_real measurement[25];
    flypend_real command[FLYPEND_ROTORS];
    flypend_real memory[FLYPEND_MEMORY];
    flypend_real rest[FLYPEND_SCRATCH];
} flypend_scratch;

/* The flight computer between two control periods. Only the functions below write to it. Each checks first that nothing
 * else has: it sees every damage within one number in single precision, within 32 bits in a row, of two bits, and of two
 * words of 32 bits that are exchanged, and all but one in 2^32 of any other kind. It cannot see that an earlier state of
 * the whole struct was put back, or damage that comes and goes within a step. */
typedef struct {
    /* the code that began it, and a word that every function checks and renews */
    uint32_t mark;
    uint32_t check;
    /* gains of the law: flypend_board_set_gains changes them */
    flypend_gains gains;
    /* the table above */
    flypend_real memory[FLYPEND_MEMORY];
    /* not checked: written before it is read, in every step */
    flypend_scratch scratch;
} flypend_board;

/* What flypend proposes for this vehicle. Masses and inertia are divided by its thrust_scale, since rotor forces are in
 * newtons as commanded. */
extern const flypend_gains flypend_default_gains;
extern const flypend_params flypend_default_params;

/* Prepares `board` for a vehicle whose rotors give their least force. Call it on the ground, before the first step.
 *
 * Returns OK, NULL, NOT_FINITE, PARAMS, WRONG_VEHICLE. After anything but FLYPEND_OK the board has not begun. */
flypend_status flypend_board_begin(flypend_board *board, const flypend_gains *gains, const flypend_params *params);

/* The same in flight, after FLYPEND_NOT_BEGUN: the rotors give the forces `rotors`, such as the safe command that came
 * with it. `rotors` may be null: then they give their least force.
 *
 * Returns OK, NULL, NOT_FINITE, PARAMS, WRONG_VEHICLE. After anything but FLYPEND_OK the board has not begun. */
flypend_status flypend_board_restart(flypend_board *board, const flypend_gains *gains, const flypend_params *params,
                                     const flypend_rotors *rotors);

/* Changes the gains between two steps.
 *
 * Returns OK, NULL, NOT_FINITE, NOT_BEGUN. After anything but FLYPEND_OK the board is as it was. */
flypend_status flypend_board_set_gains(flypend_board *board, const flypend_gains *gains);

/* The flight computer, once every FLYPEND_PERIOD: rotor forces to command now for what was measured now. It works
 * in the board's `scratch`; beside that it takes hundreds of bytes of stack, or in double precision thousands: the
 * table in flypend's docs/export/export.md tells them law by law.
 *
 * `reference` is the path of the pivot with its derivatives at the time of the measurement; it may be null if
 * FLYPEND_FOLLOWS is 0.
 *
 * Anything but FLYPEND_OK comes with a safe command. As long as attitude and rates are finite and R is a rotation, the
 * vehicle is levelled, its rates are damped, and the thrust carries it (FLYPEND_ROD, FLYPEND_SINGULAR,
 * FLYPEND_NOT_BEGUN, numbers elsewhere that are not finite). Otherwise nobody knows where a thrust would push: all rotors
 * at their least force, or 0 with unusable parameters. The output is finite in every case. A board that has begun
 * remembers the command that was given and keeps its estimates of external forces, so that it flies on with the next good
 * measurement.
 *
 * Returns OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE, NOT_BEGUN. */
flypend_status flypend_board_step(flypend_board *board, const flypend_measurement *measurement,
                                  const flypend_path *reference, const flypend_params *params, flypend_rotors *rotors);

/* For a period in which flypend_board_step was not called and the last command stayed.
 *
 * Returns OK, NULL, NOT_BEGUN. */
flypend_status flypend_board_pass(flypend_board *board);

/* The law alone, for those who have their own flight computer: the wrench for a state.
 *
 * Anything but FLYPEND_OK comes with the safe wrench, chosen as flypend_board_step chooses its safe command.
 * `reference` may be null if FLYPEND_FOLLOWS is 0.
 *
 * Returns OK, NULL, NOT_FINITE, ROD, ATTITUDE, PARAMS, SINGULAR, WRONG_VEHICLE. */
flypend_status flypend_step(const flypend_state *state, const flypend_reference *reference, const flypend_gains *gains,
                            const flypend_params *params, flypend_wrench *wrench);

/* The reference on a path of the pivot. It leans the rod along the acceleration (and the force on the bob that `state`
 * holds), so the bob's derivatives take those of the path up to the eighth. Hover at a point: only x0 is not 0.
 *
 * Returns OK, NULL, NOT_FINITE, PARAMS, SINGULAR, WRONG_VEHICLE. Anything but FLYPEND_OK comes with hover at the origin,
 * or with zeros if the parameters are unusable. */
flypend_status flypend_follow(const flypend_path *path, const flypend_state *state, const flypend_params *params,
                              flypend_reference *reference);

/* Rotor forces for a wrench, each within its limits: roll and pitch first, then thrust, then yaw.
 *
 * Returns OK, NULL, NOT_FINITE, PARAMS, SINGULAR, WRONG_VEHICLE. Anything but FLYPEND_OK comes with all rotors at their
 * least force, 0 if the parameters are unusable. */
flypend_status flypend_mix(const flypend_wrench *wrench, const flypend_params *params, flypend_rotors *rotors);

/* The wrench of rotor forces.
 *
 * Returns OK, NULL, NOT_FINITE, PARAMS, SINGULAR, WRONG_VEHICLE. Anything but FLYPEND_OK comes with zeros. */
flypend_status flypend_unmix(const flypend_rotors *rotors, const flypend_params *params, flypend_wrench *wrench);

/* Commands modelled + lead (wanted - modelled) within the limits, for rotors that lag: lead $lead is proposed here, at
 * most 1 / (1 - exp(-h / T)) for a control period h and a lag T. `command` may be `wanted`. Called with the command
 * that acts in place of `wanted` and 1 - exp(-h / T) in place of `lead`, it moves the model on by a period h.
 *
 * Returns OK, NULL, NOT_FINITE, PARAMS, WRONG_VEHICLE. Anything but FLYPEND_OK comes with all rotors at their
 * least force, 0 if the parameters are unusable. */
flypend_status flypend_lead(const flypend_rotors *wanted, const flypend_rotors *modelled, flypend_real lead,
                            const flypend_params *params, flypend_rotors *command);

#ifdef __cplusplus
}
#endif
#endif
