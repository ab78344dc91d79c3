// Stand-in: the fields of the messages that the PX4 adapter uses, as in their definitions.
#pragma once
#include <cstdint>

struct vehicle_local_position_s {
    uint64_t timestamp;
    float x, y, z, vx, vy, vz;
    bool xy_valid, z_valid, v_xy_valid, v_z_valid;
};
struct vehicle_attitude_s {
    uint64_t timestamp;
    float q[4];
};
struct vehicle_angular_velocity_s {
    uint64_t timestamp, timestamp_sample;
    float xyz[3];
};
struct debug_array_s {
    uint64_t timestamp;
    float data[58];
};
struct debug_key_value_s {
    uint64_t timestamp;
    float value;
    char key[10];
};
struct trajectory_setpoint_s {
    uint64_t timestamp;
    float position[3], velocity[3], acceleration[3], jerk[3];
};
struct actuator_motors_s {
    uint64_t timestamp, timestamp_sample;
    float control[12];
};
