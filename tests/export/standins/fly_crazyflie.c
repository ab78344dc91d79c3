/* Reads x, x_dot, quaternion xyzw, gyro (deg/s), bob, its velocity, setpoint; writes what the controller asks for, and
 * the status that it logs, before the bob is seen, and at the steps 0, 1 (not executed), 2 and 102 (the bob too old). */
#include <stdint.h>
#include <stdio.h>

#include "controller.h"
#include "log.h"

extern const standin_log standin_log_flypend[];

void flypend_crazyflie_bob(const float position[3], const float velocity[3]);

static void fly(const setpoint_t *setpoint, const sensorData_t *sensors, const state_t *state, unsigned step)
{
    control_t control = {-1, -1, -1, -1, controlModeLegacy};
    controllerOutOfTree(&control, setpoint, sensors, state, step);
    (void)printf("%.9g %.9g %.9g %.9g %d %d\n", (double)control.thrustSi, (double)control.torqueX,
                 (double)control.torqueY, (double)control.torqueZ, (int)control.controlMode,
                 (int)*(const uint8_t *)standin_log_flypend[0].address);
}

int main(void)
{
    static const unsigned steps[] = {0, 1, 2, 102};
    float v[28];
    for (int i = 0; i < 28; i++) {
        if (scanf("%f", &v[i]) != 1) {
            return 1;
        }
    }
    const state_t now = {{v[6], v[7], v[8], v[9]}, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    const sensorData_t sensors = {{v[10], v[11], v[12]}};
    const setpoint_t setpoint = {{v[19], v[20], v[21]}, {v[22], v[23], v[24]}, {v[25], v[26], v[27]}};
    controllerOutOfTreeInit();
    fly(&setpoint, &sensors, &now, 0);
    flypend_crazyflie_bob(&v[13], &v[16]);
    for (int i = 0; i < 4; i++) {
        fly(&setpoint, &sensors, &now, steps[i]);
    }
    return controllerOutOfTreeTest() ? 0 : 1;
}
