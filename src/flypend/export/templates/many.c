/* Many states in one call, for tests and measurements. */
#include "$include"

#include <stddef.h>

void flypend_many(int count, const flypend_state *state, const flypend_reference *reference,
                  const flypend_gains *gains, const flypend_params *params, flypend_wrench *wrench,
                  flypend_rotors *rotors, int *status);
void flypend_fly(int count, flypend_board *board, const flypend_measurement *measurement, const flypend_path *path,
                 const flypend_params *params, flypend_rotors *rotors, int *status);
int flypend_board_bytes(void);
int flypend_board_memory(void);
int flypend_sensors_bytes(void);
int flypend_sensors_memory(void);

void flypend_many(int count, const flypend_state *state, const flypend_reference *reference,
                  const flypend_gains *gains, const flypend_params *params, flypend_wrench *wrench,
                  flypend_rotors *rotors, int *status)
{
    for (int i = 0; i < count; i++) {
        status[i] = (int)flypend_step(&state[i], &reference[i], gains, params, &wrench[i]);
        if (status[i] == (int)FLYPEND_OK) {
            status[i] = (int)flypend_mix(&wrench[i], params, &rotors[i]);
        }
    }
}

void flypend_fly(int count, flypend_board *board, const flypend_measurement *measurement, const flypend_path *path,
                 const flypend_params *params, flypend_rotors *rotors, int *status)
{
    for (int i = 0; i < count; i++) {
        status[i] = (int)flypend_board_step(board, &measurement[i], &path[i], params, &rotors[i]);
    }
}

int flypend_board_bytes(void)
{
    return (int)sizeof(flypend_board);
}

int flypend_board_memory(void)
{
    return (int)offsetof(flypend_board, memory);
}

int flypend_sensors_bytes(void)
{
#ifdef FLYPEND_SENSORS_H
    return (int)sizeof(flypend_sensors);
#else
    return 0;
#endif
}

int flypend_sensors_memory(void)
{
#ifdef FLYPEND_SENSORS_H
    return (int)offsetof(flypend_sensors, memory);
#else
    return 0;
#endif
}
