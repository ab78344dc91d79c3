/* Reads x, x_dot, quaternion xyzw, gyro (deg/s), bob, its velocity, setpoint; writes what the controller asks for at the
 * steps 0, 1 (not executed), 100 and 102 (the bob too old). */
#include <stdio.h>

#include "controller.h"

void flypend_crazyflie_bob(const float position[3], const float velocity[3]);

int main(void)
{
    static const unsigned steps[] = {0, 1, 100, 102};
    float v[28];
    const state_t *state;
    for (int i = 0; i < 28; i++) {
        if (scanf("%f", &v[i]) != 1) {
            return 1;
        }
    }
    const state_t now = {{v[6], v[7], v[8], v[9]}, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    const sensorData_t sensors = {{v[10], v[11], v[12]}};
    const setpoint_t setpoint = {{v[19], v[20], v[21]}, {v[22], v[23], v[24]}, {v[25], v[26], v[27]}};
    state = &now;
    controllerOutOfTreeInit();
    flypend_crazyflie_bob(&v[13], &v[16]);
    for (int i = 0; i < 4; i++) {
        control_t control = {-1, -1, -1, -1, controlModeLegacy};
        controllerOutOfTree(&control, &setpoint, &sensors, state, steps[i]);
        (void)printf("%.9g %.9g %.9g %.9g %d\n", (double)control.thrustSi, (double)control.torqueX,
                     (double)control.torqueY, (double)control.torqueZ, (int)control.controlMode);
    }
    return controllerOutOfTreeTest() ? 0 : 1;
}
