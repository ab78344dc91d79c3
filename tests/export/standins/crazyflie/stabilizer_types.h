/* Stand-in: what the Crazyflie adapter uses of the firmware's header, declared as there. */
#ifndef STANDIN_STABILIZER_TYPES_H
#define STANDIN_STABILIZER_TYPES_H
#include <stdint.h>

typedef struct {
    float x, y, z;
} vector_t;
typedef struct {
    float x, y, z, w;
} quaternion_t;
typedef struct {
    vector_t gyro; /* deg/s */
} sensorData_t;
typedef struct {
    quaternion_t attitudeQuaternion;
    vector_t position; /* m */
    vector_t velocity; /* m/s */
} state_t;
typedef struct {
    vector_t position, velocity, acceleration;
} setpoint_t;
typedef enum { controlModeLegacy = 0, controlModeForceTorque = 1, controlModeForce = 2 } control_mode_t;
typedef struct {
    float thrustSi;                  /* N */
    float torqueX, torqueY, torqueZ; /* N m */
    control_mode_t controlMode;
} control_t;
typedef uint32_t stabilizerStep_t;

#define RATE_MAIN_LOOP 1000
#define RATE_500_HZ 500
#define RATE_DO_EXECUTE(RATE_HZ, TICK) (((TICK) % (RATE_MAIN_LOOP / (RATE_HZ))) == 0)
#endif
