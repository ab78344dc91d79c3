// Reads position, velocity, quaternion wxyz, rates, bob, its velocity (all NED and FRD), setpoint position; writes the
// state and the path as the adapter sees them, the motors with the status, the same half a period later, a period later,
// 0.2 s later with the same bob, and with a new one but no valid position; then a motor that is not used.
#include <cstdio>

#include "flypend_px4.hpp"

namespace
{
template <typename Message> void give(const Message &message)
{
    standin::Topic<Message>::message = message;
    standin::Topic<Message>::given = true;
}

void print(const flypend_real *values, int count)
{
    for (int i = 0; i < count; i++) {
        std::printf("%.17g ", static_cast<double>(values[i]));
    }
    std::printf("\n");
}

void print_motors()
{
    for (int i = 0; i < FLYPEND_ROTORS; i++) {
        std::printf("%.9g ", static_cast<double>(standin::Topic<actuator_motors_s>::message.control[i]));
    }
    const debug_key_value_s &told = standin::Topic<debug_key_value_s>::message;
    std::printf("%g %d\n", static_cast<double>(told.value), static_cast<int>(told.timestamp));
}

void fly(Flypend &module, vehicle_angular_velocity_s &rates, uint64_t time)
{
    rates.timestamp = rates.timestamp_sample = time;
    give(rates);
    module.ScheduleNow();
    print_motors();
}
} // namespace

int main()
{
    float v[22];
    for (float &value : v) {
        if (std::scanf("%f", &value) != 1) {
            return 1;
        }
    }
    vehicle_local_position_s position{0, v[0], v[1], v[2], v[3], v[4], v[5], true, true, true, true};
    vehicle_attitude_s attitude{0, {v[6], v[7], v[8], v[9]}};
    vehicle_angular_velocity_s rates{5, 5, {v[10], v[11], v[12]}};
    debug_array_s bob{0, {v[13], v[14], v[15], v[16], v[17], v[18]}};
    const float none = __builtin_nanf("");
    trajectory_setpoint_s setpoint{0, {v[19], v[20], v[21]}, {none, none, none}, {none, none, none}, {none, none, none}};
    const flypend_measurement state = flypend_from_px4(position, attitude, rates, bob);
    const flypend_path path = flypend_path_from_px4(setpoint);
    print(reinterpret_cast<const flypend_real *>(&state), 24);
    print(reinterpret_cast<const flypend_real *>(&path), 27);
    give(position);
    give(attitude);
    give(rates);
    give(bob);
    give(setpoint);
    Flypend module;
    if (!module.init()) {
        return 1;
    }
    fly(module, rates, 5);
    fly(module, rates, 1005);
    fly(module, rates, 2005);
    position.timestamp = attitude.timestamp = 200000;
    give(position);
    give(attitude);
    fly(module, rates, 200000);
    bob.timestamp = 200000;
    position.v_z_valid = false;
    give(bob);
    give(position);
    fly(module, rates, 202000);
    std::printf("%g\n", static_cast<double>(standin::Topic<actuator_motors_s>::message.control[FLYPEND_ROTORS]));
    return 0;
}
