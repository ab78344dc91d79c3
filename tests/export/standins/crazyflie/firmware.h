/* Stand-in: what the app uses of the Crazyflie firmware, declared as there. Each of its headers includes this one. */
#ifndef STANDIN_FIRMWARE_H
#define STANDIN_FIRMWARE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint32_t timestamp;
    float x, y, z;
} vector_t;
typedef struct {
    float x, y, z;
} Axis3f;
typedef struct {
    uint32_t timestamp;
    float roll, pitch, yaw;
} attitude_t;
typedef struct {
    float x, y, z, w;
} quaternion_t;
typedef struct {
    Axis3f acc;  /* g */
    Axis3f gyro; /* deg/s */
} sensorData_t;
typedef struct {
    attitude_t attitude; /* deg */
    quaternion_t attitudeQuaternion;
    vector_t position; /* m */
    vector_t velocity; /* m/s */
} state_t;
typedef enum { modeDisable = 0, modeAbs, modeVelocity } stab_mode_t;
typedef struct {
    attitude_t attitude;
    float thrust;
    vector_t position, velocity, acceleration;
    struct {
        stab_mode_t x, y, z, roll, pitch, yaw, quat;
    } mode;
} setpoint_t;
typedef enum { controlModeLegacy = 0, controlModeForceTorque = 1, controlModeForce = 2 } control_mode_t;
typedef struct {
    union {
        struct {
            int16_t roll, pitch, yaw;
            float thrust;
        };
        float normalizedForces[4];
    };
    control_mode_t controlMode;
} control_t;
typedef uint32_t stabilizerStep_t;

#define RATE_MAIN_LOOP 1000
#define RATE_DO_EXECUTE(RATE_HZ, TICK) (((TICK) % (RATE_MAIN_LOOP / (RATE_HZ))) == 0)

void controllerOutOfTreeInit(void);
bool controllerOutOfTreeTest(void);
void controllerOutOfTree(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                         const state_t *state, const stabilizerStep_t stabilizerStep);
void controllerPidInit(void);
bool controllerPidTest(void);
void controllerPid(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors, const state_t *state,
                   const stabilizerStep_t stabilizerStep);

void appMain(void);
size_t appchannelReceiveDataPacket(void *buffer, size_t max_length, int timeout_ms);
uint32_t xTaskGetTickCount(void);
#define M2T(X) ((unsigned int)(X))
#define T2M(X) ((unsigned int)(X))
#define taskENTER_CRITICAL()
#define taskEXIT_CRITICAL()

typedef enum { StateEstimatorTypeAutoSelect, StateEstimatorTypeComplementary, StateEstimatorTypeKalman } StateEstimatorType;
StateEstimatorType stateEstimatorGetType(void);
bool pmIsBatteryLow(void);
float pmGetBatteryVoltage(void);
uint16_t motorsGetRatio(uint32_t id);
bool supervisorIsFlying(void);

/* Groups of logged variables and parameters are tables that end with an entry without a name. */
typedef struct {
    int type;
    const char *name;
    void *address;
    void (*callback)(void);
} standin_entry;
enum { LOG_UINT8, LOG_UINT16, LOG_FLOAT, PARAM_UINT8, PARAM_FLOAT };
#define LOG_GROUP_START(NAME) const standin_entry standin_log_##NAME[] = {
#define LOG_ADD(TYPE, NAME, ADDRESS) {TYPE, #NAME, (void *)(ADDRESS), NULL},
#define LOG_GROUP_STOP(NAME) {0, NULL, NULL, NULL}};
#define PARAM_GROUP_START(NAME) const standin_entry standin_param_##NAME[] = {
#define PARAM_ADD(TYPE, NAME, ADDRESS) {TYPE, #NAME, (void *)(ADDRESS), NULL},
#define PARAM_ADD_WITH_CALLBACK(TYPE, NAME, ADDRESS, CALLBACK) {TYPE, #NAME, (void *)(ADDRESS), CALLBACK},
#define PARAM_GROUP_STOP(NAME) {0, NULL, NULL, NULL}};
typedef int paramVarId_t;
paramVarId_t paramGetVarId(const char *group, const char *name);
void paramSetInt(paramVarId_t id, int value);

typedef int logVarId_t;
logVarId_t logGetVarId(const char *group, const char *name);
unsigned int logGetUint(logVarId_t id);
float logGetFloat(logVarId_t id);

#define ARM_LENGTH 0.046f
#define THRUST_MIN 0.012817578f
#define THRUST_MAX 0.12f
#define VMOTOR2THRUST0 0.0f
#define VMOTOR2THRUST1 0.03f
#define VMOTOR2THRUST2 0.0f
#define VMOTOR2THRUST3 0.0f
#endif
