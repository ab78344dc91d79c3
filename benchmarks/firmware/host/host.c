/* The board around the firmware's stabilizer: time, tasks, sensors, battery, motors and the radio link, for Python.
 *
 * Sources of the firmware keep their own interfaces; what they call of the hardware is here, as little as it takes.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <ucontext.h>

#include "FreeRTOS.h"
#include "autoconf.h"
#include "groups.h"

#include "app.h"
#include "commander.h"
#include "crtp.h"
#include "crtp_localization_service.h"
#include "crtp_supervisor.h"
#include "eprintf.h"
#include "estimator.h"
#include "estimator_kalman.h"
#include "motors.h"
#include "platform_defaults.h"
#include "platformservice.h"
#include "pm.h"
#include "power_distribution.h"
#include "sensors.h"
#include "stabilizer.h"

#define TASKS 16
#define STACK (256 * 1024)

/* Tasks ------------------------------------------------------------------------------------------------------------ */

typedef struct {
    ucontext_t context;
    void (*run)(void *);
    void *argument;
    int priority;
} task_t;

struct host_queue {
    int length, size, count, first;
    unsigned char *items;
};

static task_t tasks[TASKS];
static int task_count, order[TASKS];
static task_t *current;
static ucontext_t outside;
static TickType_t ticks = 1000;
static bool queues_changed;

TickType_t xTaskGetTickCount(void) { return ticks; }

static void wait_a_turn(void)
{
    if (current == NULL) {
        fprintf(stderr, "host: only tasks can wait\n");
        abort();
    }
    swapcontext(&current->context, &outside);
}

static void begin_task(int number) { tasks[number].run(tasks[number].argument); }

TaskHandle_t xTaskCreateStatic(void (*run)(void *), const char *name, int depth, void *argument, int priority,
                               StackType_t *stack, StaticTask_t *memory)
{
    (void)name, (void)depth, (void)stack, (void)memory;
    if (task_count == TASKS) {
        abort();
    }
    task_t *task = &tasks[task_count];
    task->run = run;
    task->argument = argument;
    task->priority = priority;
    getcontext(&task->context);
    task->context.uc_stack.ss_sp = malloc(STACK);
    task->context.uc_stack.ss_size = STACK;
    task->context.uc_link = &outside;
    makecontext(&task->context, (void (*)(void))begin_task, 1, task_count);
    int place = task_count++;
    for (; (place > 0) && (tasks[order[place - 1]].priority < priority); place--) {
        order[place] = order[place - 1];
    }
    order[place] = (int)(task - tasks);
    return task;
}

/* Until nobody has anything to do in this tick: a task may wait for what another one sends. */
static void all_tasks(void)
{
    do {
        queues_changed = false;
        for (int i = 0; i < task_count; i++) {
            current = &tasks[order[i]];
            swapcontext(&outside, &current->context);
            current = NULL;
        }
    } while (queues_changed);
}

void vTaskDelay(TickType_t duration)
{
    for (const TickType_t begun = ticks; ticks - begun < duration;) {
        wait_a_turn();
    }
}

void vTaskDelayUntil(TickType_t *woken, TickType_t duration)
{
    *woken += duration;
    while ((int32_t)(ticks - *woken) < 0) {
        wait_a_turn();
    }
}

QueueHandle_t host_queue_create(int length, int size, int count)
{
    QueueHandle_t queue = calloc(1, sizeof *queue);
    *queue = (struct host_queue){length, size, count, 0, calloc((size_t)length, (size_t)(size + 1))};
    return queue;
}

int host_queue_send(QueueHandle_t queue, const void *item, bool overwrite)
{
    if (overwrite) {
        queue->count = 0;
    }
    if (queue->count == queue->length) {
        return pdFALSE;
    }
    if (item != NULL) {
        memcpy(queue->items + queue->size * ((queue->first + queue->count) % queue->length), item, (size_t)queue->size);
    }
    queue->count++;
    queues_changed = true;
    return pdTRUE;
}

int host_queue_take(QueueHandle_t queue, void *item, TickType_t duration, bool keep)
{
    for (const TickType_t begun = ticks; queue->count == 0;) {
        if (ticks - begun >= duration) {
            return pdFALSE;
        }
        wait_a_turn();
    }
    if (item != NULL) {
        memcpy(item, queue->items + queue->size * queue->first, (size_t)queue->size);
    }
    if (!keep) {
        queue->first = (queue->first + 1) % queue->length;
        queue->count--;
    }
    return pdTRUE;
}

/* Parameters and logs ---------------------------------------------------------------------------------------------- */

#define GROUPS 200

static struct {
    const void *rows;
    int is_parameter;
} groups[GROUPS];
static int group_count;

void host_group(const void *rows, int is_parameter)
{
    if (group_count == GROUPS) {
        abort();
    }
    groups[group_count].rows = rows;
    groups[group_count++].is_parameter = is_parameter;
}

/* Number of the group and of the row in it, in 16 bits; 0xffff if there is none. Groups may have several parts. */
static uint16_t found(int is_parameter, const char *group, const char *name)
{
    for (int i = 0; i < group_count; i++) {
        const struct param_s *p = groups[i].rows;
        const struct log_s *l = groups[i].rows;
        if ((groups[i].is_parameter != is_parameter) || (strcmp(is_parameter ? p->name : l->name, group) != 0)) {
            continue;
        }
        for (int row = 1;; row++) {
            const int type = is_parameter ? p[row].type : l[row].type;
            if ((type & (is_parameter ? PARAM_GROUP : LOG_GROUP)) != 0) {
                break;
            }
            if (strcmp(is_parameter ? p[row].name : l[row].name, name) == 0) {
                return (uint16_t)(i * 256 + row);
            }
        }
    }
    return 0xffff;
}

static const struct param_s *parameter_row(uint16_t id) { return (const struct param_s *)groups[id / 256].rows + id % 256; }
static const struct log_s *log_row(uint16_t id) { return (const struct log_s *)groups[id / 256].rows + id % 256; }

paramVarId_t paramGetVarId(const char *group, const char *name)
{
    const uint16_t id = found(1, group, name);
    return (paramVarId_t){.id = id, .index = id};
}

void paramSetInt(paramVarId_t id, int value)
{
    const struct param_s *row = parameter_row(id.id);
    memcpy(row->address, &value, (size_t)1 << (row->type & PARAM_BYTES_MASK)); /* little-endian */
    if (row->callback != NULL) {
        row->callback();
    }
}

logVarId_t logGetVarId(const char *group, const char *name) { return found(0, group, name); }

/* The number at the row `id`, of the types that Python asks for. */
static double value_of(const struct log_s *row)
{
    switch (row->type & ~LOG_CORE) {
        case LOG_UINT8: return *(const uint8_t *)row->address;
        case LOG_UINT16: return *(const uint16_t *)row->address;
        case LOG_FLOAT: return (double)*(const float *)row->address;
        default: abort();
    }
}

unsigned int logGetUint(logVarId_t id) { return (unsigned int)value_of(log_row(id)); }
float logGetFloat(logVarId_t id) { return (float)value_of(log_row(id)); }

/* The radio link --------------------------------------------------------------------------------------------------- */

static CrtpCallback callbacks[16];
static QueueHandle_t inbox[16];

void crtpInit(void) {}
void crtpRegisterPortCB(int port, CrtpCallback call) { callbacks[port] = call; }
void crtpInitTaskQueue(CRTPPort port) { inbox[port] = xQueueCreate(16, sizeof(CRTPPacket)); }
int crtpReceivePacketBlock(CRTPPort port, CRTPPacket *packet) { return xQueueReceive(inbox[port], packet, portMAX_DELAY); }
int crtpSendPacket(CRTPPacket *packet) { return (void)packet, 1; }
int crtpSendPacketBlock(CRTPPacket *packet) { return (void)packet, 1; }

/* Sensors, battery and motors -------------------------------------------------------------------------------------- */

static sensorData_t measured;
static bool ready;
static float voltage = 4.2f;
static bool battery_is_low;
static uint16_t ratios[4];

void sensorsInit(void) {}
bool sensorsTest(void) { return true; }
bool sensorsAreCalibrated(void) { return true; }
bool isSensorsSuspended(void) { return false; }

void sensorsWaitDataReady(void)
{
    while (!ready) {
        wait_a_turn();
    }
    ready = false;
}

void sensorsAcquire(sensorData_t *sensors)
{
    *sensors = measured;
    measurement_t sample = {.type = MeasurementTypeGyroscope, .data.gyroscope.gyro = measured.gyro};
    estimatorEnqueue(&sample);
    sample = (measurement_t){.type = MeasurementTypeAcceleration, .data.acceleration.acc = measured.acc};
    estimatorEnqueue(&sample);
}

float pmGetBatteryVoltage(void) { return voltage; }
bool pmIsBatteryLow(void) { return battery_is_low; }

void motorsInit(const MotorPerifDef **map) { (void)map; }
bool motorsTest(void) { return true; }
void motorsSetRatio(uint32_t id, uint16_t ratio) { ratios[id] = ratio; }
uint16_t motorsGetRatio(uint32_t id) { return ratios[id]; }
#ifdef CONFIG_MOTORS_ARMING_RPM_MIN /* what arming expects of motors that idle; the supervisor asks no more later */
uint16_t motorsGetRPM(uint32_t id)
{
    (void)id;
    return (CONFIG_MOTORS_ARMING_RPM_MIN + CONFIG_MOTORS_ARMING_RPM_MAX) / 2;
}
#endif
void motorsResetESCs(void) {}
void motorsBurstDshot(void) {}
void motorsStop(void)
{
    for (int i = 0; i < 4; i++) {
        ratios[i] = powerDistributionStopRatio((uint32_t)i);
    }
}

/* What else is asked of the rest of the firmware. */
void systemWaitStart(void) {}
bool healthShallWeRunTest(void) { return false; }
const MotorPerifDef **platformConfigGetMotorMapping(void) { return NULL; }
uint64_t usecTimestamp(void) { return 1000ULL * ticks; }
void eventTrigger(const void *event) { (void)event; }
uint64_t configblockGetRadioAddress(void) { return 0xE7E7E7E7E7ULL; }
void memoryRegisterHandler(const void *handler) { (void)handler; }
bool deckGetRequiredKalmanEstimatorAttitudeReversionOff(void) { return false; }
bool usddeckLoggingEnabled(void) { return false; }
bool deckSupervisorHasFault(void) { return false; }
void outlierFilterTdoaReset(void *state) { (void)state; }
void outlierFilterLighthouseReset(void *state, uint32_t now) { (void)state, (void)now; }

static char said[4000];
void assertFail(char *expression, char *file, int line)
{
    fprintf(stderr, "%s:%d: %s\n", file, line, expression);
    abort();
}
int eprintf(putc_t put, const char *format, ...)
{
    (void)put;
    va_list arguments;
    va_start(arguments, format);
    const size_t length = strlen(said);
    vsnprintf(said + length, sizeof said - length, format, arguments);
    va_end(arguments);
    return 0;
}

/* For Python ------------------------------------------------------------------------------------------------------- */

typedef struct {
    float gyro[3];           /* deg/s */
    float acc[3];            /* g */
    float voltage;
    int32_t battery_is_low;
} host_world;

void appInit(void);
void host_boot(int estimator);
void host_step(const host_world *world, float *forces);
int host_packet(int port, int channel, const void *data, int length);
double host_log(const char *group, const char *name);
double host_parameter(const char *group, const char *name);
int host_set(const char *group, const char *name, double value);
const char *host_said(void);
void host_numbers(float *numbers);

/* In the order of system.c. */
void host_boot(int estimator)
{
    crtpSupervisorInit();
    platformserviceInit();
    locSrvInit();
    commanderInit();
    estimatorKalmanTaskInit();
    stabilizerInit((StateEstimatorType)estimator);
    appInit();
    all_tasks();
}

/* Force of a rotor, N: the firmware's own fit of thrust against motor voltage, read forwards. */
static float force_of(uint16_t ratio)
{
    const float v = voltage * (float)ratio / 65535.0f;
    const float force = VMOTOR2THRUST0 + v * (VMOTOR2THRUST1 + v * (VMOTOR2THRUST2 + v * VMOTOR2THRUST3));
    return ((ratio > 0) && (force > 0)) ? force : 0;
}

/* One tick; packets before it arrived in the same one. */
void host_step(const host_world *world, float *forces)
{
    memcpy(measured.gyro.axis, world->gyro, sizeof measured.gyro.axis);
    memcpy(measured.acc.axis, world->acc, sizeof measured.acc.axis);
    voltage = world->voltage;
    battery_is_low = world->battery_is_low != 0;
    ready = true;
    all_tasks();
    ticks++;
    for (int i = 0; i < 4; i++) {
        forces[i] = force_of(ratios[i]);
    }
}

/* A packet from the ground; 0 if nobody listens on its port. */
int host_packet(int port, int channel, const void *data, int length)
{
    CRTPPacket packet = {.size = (uint8_t)length};
    packet.header = CRTP_HEADER(port, channel);
    memcpy(packet.data, data, (size_t)length);
    if (callbacks[port] != NULL) {
        callbacks[port](&packet);
    }
    if (inbox[port] != NULL) {
        xQueueSend(inbox[port], &packet, 0);
    }
    return (callbacks[port] != NULL) || (inbox[port] != NULL);
}

double host_log(const char *group, const char *name)
{
    const uint16_t id = found(0, group, name);
    return (id == 0xffff) ? (double)NAN : value_of(log_row(id));
}

double host_parameter(const char *group, const char *name)
{
    const uint16_t id = found(1, group, name);
    if (id == 0xffff) {
        return (double)NAN;
    }
    const struct param_s *row = parameter_row(id);
    return ((row->type & 0x0f) == PARAM_FLOAT) ? (double)*(float *)row->address : *(uint8_t *)row->address;
}

/* Set a parameter of 8 bits or a float as an upload does; 0 if there is none. */
int host_set(const char *group, const char *name, double value)
{
    const uint16_t id = found(1, group, name);
    if (id == 0xffff) {
        return 0;
    }
    const struct param_s *row = parameter_row(id);
    if ((row->type & 0x0f) == PARAM_FLOAT) {
        *(float *)row->address = (float)value;
    } else {
        *(uint8_t *)row->address = (uint8_t)value;
    }
    if (row->callback != NULL) {
        row->callback();
    }
    return 1;
}

const char *host_said(void) { return said; }

/* Arm from the axes (m), least and largest force of a rotor (N), torque over thrust (m). */
void host_numbers(float *numbers)
{
    const float own[] = {0.707106781f * ARM_LENGTH, THRUST_MIN, THRUST_MAX, THRUST2TORQUE};
    memcpy(numbers, own, sizeof own);
}
