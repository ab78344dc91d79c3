/* Flies the app on a Cortex-M4F of QEMU with a painted stack, and prints how much of it one call of the controller took. */
#include <string.h>

#include "firmware.h"

#define PAINT 0xa5a5a5a5U
#ifndef DEPTH
#define DEPTH 4096U /* words that are painted */
#endif
#ifndef ROUNDS
#define ROUNDS 600 /* ms */
#endif

extern uint32_t _stack_top, _data, _data_end, _load, _bss, _bss_end;
extern const standin_entry standin_log_flypend[], standin_param_flypend[];

int main(void);
void reset(void);
static uint32_t ticks = 1000;
static unsigned char packet[13];
static const float posed[8] = {0, 0, 0, 4, 0.998f, 0, 0.06f, 0}; /* from 1 on x, y, z and quaternion; a plan begins */
static void *back[5];

__attribute__((section(".vectors"), used)) static void *const vectors[2] = {&_stack_top, (void *)reset};

static void say(const char *text)
{
    register uint32_t what __asm__("r0") = 4; /* SYS_WRITE0 */
    register const char *which __asm__("r1") = text;
    __asm__ volatile("bkpt 0xab" : "+r"(what) : "r"(which) : "memory");
}

static void leave(void)
{
    register uint32_t what __asm__("r0") = 0x18; /* SYS_EXIT, of the application's own accord */
    register uint32_t which __asm__("r1") = 0x20026;
    __asm__ volatile("bkpt 0xab" : "+r"(what) : "r"(which) : "memory");
}

void reset(void)
{
    *(volatile uint32_t *)0xE000ED88 |= 0xFU << 20; /* the floating-point unit */
    memcpy(&_data, &_load, (size_t)((char *)&_data_end - (char *)&_data));
    memset(&_bss, 0, (size_t)((char *)&_bss_end - (char *)&_bss));
    (void)main();
    leave();
}

uint32_t xTaskGetTickCount(void) { return ticks; }
StateEstimatorType stateEstimatorGetType(void) { return StateEstimatorTypeKalman; }
bool pmIsBatteryLow(void) { return false; }
float pmGetBatteryVoltage(void) { return 4.0f; }
uint16_t motorsGetRatio(uint32_t id) { return (uint16_t)(40000U + id); }
bool supervisorIsFlying(void) { return true; }
/* The last letter of x, y, z, qw, qx, qy, qz, and of tick, which comes last; quaternions from 'w' + 4 on. */
logVarId_t logGetVarId(const char *group, const char *name)
{
    (void)group;
    return (name[0] == 'q') ? name[1] + 4 : name[0];
}
unsigned int logGetUint(logVarId_t id) { return (uint16_t)(ticks / 10 * 10) + 0U * (unsigned)id; }
float logGetFloat(logVarId_t id) { return posed[id - 'w']; }
paramVarId_t paramGetVarId(const char *group, const char *name) { return group[0] == name[0]; }
void paramSetInt(paramVarId_t id, int value) { (void)id, (void)value; }
void controllerPidInit(void) {}
bool controllerPidTest(void) { return true; }
void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors, const state_t *state,
                   const stabilizerStep_t step)
{
    (void)setpoint, (void)sensors, (void)state, (void)step;
    control->controlMode = controlModeLegacy;
}

size_t appchannelReceiveDataPacket(void *buffer, size_t max_length, int timeout_ms)
{
    static int odd = 0;
    (void)timeout_ms;
    odd = !odd;
    if (!odd) {
        __builtin_longjmp(back, 1);
    }
    memcpy(buffer, packet, max_length);
    return max_length;
}

/* The bob above (1) or below (-1) the vehicle. */
static void see(float side)
{
    const float numbers[3] = {0.1f, 0, 0.49f * side};
    packet[0] = 'b';
    memcpy(packet + 1, numbers, sizeof numbers);
    if (__builtin_setjmp(back) == 0) {
        appMain();
    }
}

static uint32_t used_by(const setpoint_t *setpoint, const state_t *state)
{
    control_t control;
    const sensorData_t sensors = {.acc = {0.1f, 0, 1}, .gyro = {20, -30, 10}};
    volatile uint32_t *here;
    __asm__ volatile("mov %0, sp" : "=r"(here));
    for (uint32_t i = 1; i <= DEPTH; i++) {
        here[-(int)i] = PAINT;
    }
    controllerOutOfTree(&control, setpoint, &sensors, state, ++ticks);
    uint32_t depth = DEPTH;
    while ((depth > 0) && (here[-(int)depth] == PAINT)) {
        depth--;
    }
    return 4 * depth;
}

static void print(const char *text, uint32_t number)
{
    char digits[12];
    int place = 11;
    digits[place] = 0;
    do {
        digits[--place] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    say(text);
    say(digits + place);
}

int main(void)
{
    state_t state = {{0, 0, 0, 0}, {0, 0.06f, 0, 0.998f}, {0, 0, 0, 4}, {0, 0.1f, 0, 0}};
    setpoint_t setpoint = {.position = {0, 0, 0, 4}};
    const uint8_t *flies = standin_log_flypend[0].address;
    uint32_t most = 0, flown = 0;
    setpoint.mode.x = setpoint.mode.y = setpoint.mode.z = modeAbs;
    controllerOutOfTreeInit();
    *(uint8_t *)standin_param_flypend[0].address = 1;
    for (int i = 0; i < ROUNDS; i++) {
        if (i < 450) {
            see((i / 10 % 2 == 0) ? 1.f : -1.f); /* turning over */
        } /* then it is lost, and the vehicle lands */
        if (i == 400) {
            setpoint.position.x = __builtin_nanf(""); /* the law refuses */
        }
        const uint32_t used = used_by(&setpoint, &state);
        most = (used > most) ? used : most;
        flown += (*flies == 2) && (ticks % 2 == 0);
    }
    print("stack ", most);
    print(" flown ", flown);
    say("\n");
    return 0;
}
