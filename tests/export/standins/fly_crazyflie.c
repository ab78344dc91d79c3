/* The rest of a firmware around the app, for a test: what time it is, what arrives, what the PID controller is asked for. */
#include <setjmp.h>
#include <string.h>

#include "firmware.h"

extern const standin_entry standin_log_flypend[], standin_param_flypend[];

static jmp_buf back;
static unsigned char packet[64];
static size_t packet_length;
static uint32_t ticks;
static setpoint_t asked;
static int pid_calls, tumble_check = 1;
static int flying = 1;
static uint32_t pose_tick;
static float pose[8];
static uint16_t ratio; /* of all motors */
static int battery_is_low, estimator = StateEstimatorTypeKalman;

uint32_t xTaskGetTickCount(void) { return ticks; }
StateEstimatorType stateEstimatorGetType(void) { return (StateEstimatorType)estimator; }
bool pmIsBatteryLow(void) { return battery_is_low != 0; }
float pmGetBatteryVoltage(void) { return 4.0f; }
uint16_t motorsGetRatio(uint32_t id) { return (id < 4) ? ratio : 0; }
bool supervisorIsFlying(void) { return flying != 0; }
/* Of the last pose 1 to 3 are x, y, z, 4 to 7 its quaternion w, x, y, z, 8 when it came. */
logVarId_t logGetVarId(const char *group, const char *name)
{
    const int letter = name[strlen(name) - 1];
    return (strncmp(group, "locSrv", 6) != 0) ? 0 : (letter == 'k') ? 8 : (letter - 'w') + ((name[0] == 'q') ? 4 : 0);
}
unsigned int logGetUint(logVarId_t id) { return (id == 8) ? (uint16_t)pose_tick : 0; }
float logGetFloat(logVarId_t id) { return pose[id]; }
paramVarId_t paramGetVarId(const char *group, const char *name)
{
    return (strcmp(group, "supervisor") == 0) && (strcmp(name, "tmblChckEn") == 0);
}
void paramSetInt(paramVarId_t id, int value)
{
    if (id == 1) {
        tumble_check = value;
    }
}
void controllerPidInit(void) {}
bool controllerPidTest(void) { return true; }
void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors, const state_t *state,
                   const stabilizerStep_t step)
{
    (void)sensors, (void)state, (void)step;
    if ((setpoint->mode.z == modeDisable) && (setpoint->thrust <= 0)) {
        memset(control, 0, sizeof *control);
        return;
    }
    pid_calls++;
    asked = *setpoint;
    control->controlMode = controlModeLegacy;
    control->thrust = 30000;
}

/* The first call of a round gives the packet, if there is one; the second ends the round. */
size_t appchannelReceiveDataPacket(void *buffer, size_t max_length, int timeout_ms)
{
    static int round_ends = 0;
    (void)timeout_ms;
    round_ends = !round_ends;
    if (!round_ends) {
        longjmp(back, 1);
    }
    const size_t length = (packet_length < max_length) ? packet_length : max_length;
    memcpy(buffer, packet, length);
    packet_length = 0;
    return length;
}

void standin_app(const void *bytes, int length);
void standin_set(uint32_t now, int low, int kind, int in_the_air, uint32_t posed, int turning);
void standin_get(float *found);
const standin_entry *standin_entries(int parameters);
void standin_fly(const float *v, const int *modes, uint32_t step, float *found);

/* One round of appMain, with a packet of `length` bytes. */
void standin_app(const void *bytes, int length)
{
    memcpy(packet, bytes, (size_t)length);
    packet_length = (size_t)length;
    if (setjmp(back) == 0) {
        appMain();
    }
}

void standin_set(uint32_t now, int low, int kind, int in_the_air, uint32_t posed, int turning)
{
    ratio = (uint16_t)turning;
    flying = in_the_air;
    pose_tick = posed;
    ticks = now;
    battery_is_low = low;
    estimator = kind;
}

/* Calls of the PID controller, mode and velocity of z and position x that it was asked for; the check for tumbling. */
void standin_get(float *found)
{
    found[0] = (float)pid_calls;
    found[1] = (float)asked.mode.z;
    found[2] = asked.velocity.z;
    found[3] = asked.position.x;
    found[4] = (float)tumble_check;
}

const standin_entry *standin_entries(int parameters)
{
    return (parameters != 0) ? standin_param_flypend : standin_log_flypend;
}

/* x, x_dot, quaternion xyzw, gyro (deg/s), setpoint, thrust (17 numbers); modes of x, y, z → control mode, four numbers. */
void standin_fly(const float *v, const int *modes, uint32_t step, float *found)
{
    control_t control;
    const state_t state = {{0, 0, 0, 7},
                           {v[6], v[7], v[8], v[9]},
                           {ticks, v[0], v[1], v[2]},
                           {ticks, v[3], v[4], v[5]}};
    const float x = v[6], y = v[7], z = v[8], w = v[9];
    const sensorData_t sensors = {
        .acc = {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}, /* it is carried */
        .gyro = {v[10], v[11], v[12]}};
    const float seen[8] = {0, v[0], v[1], v[2], w, x, y, z};
    memcpy(pose, seen, sizeof pose);
    setpoint_t setpoint = {.thrust = v[16], .position = {ticks, v[13], v[14], v[15]}};
    setpoint.mode.x = (stab_mode_t)modes[0];
    setpoint.mode.y = (stab_mode_t)modes[1];
    setpoint.mode.z = (stab_mode_t)modes[2];
    memset(&control, 0xff, sizeof control);
    controllerOutOfTree(&control, &setpoint, &sensors, &state, step);
    found[0] = (float)control.controlMode;
    memcpy(found + 1, control.normalizedForces, sizeof control.normalizedForces);
}
