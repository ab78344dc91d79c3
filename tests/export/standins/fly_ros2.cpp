// Reads position, quaternion xyzw, twist (body frame), bob, its velocity, target; writes the state, then the wrench, its
// status and whether a period was due: at once, half a period later, and a period later.
#include <cstdio>

#include "flypend_ros2.hpp"

int main()
{
    double v[22];
    for (double &value : v) {
        if (std::scanf("%lf", &value) != 1) {
            return 1;
        }
    }
    nav_msgs::msg::Odometry odometry;
    odometry.pose.pose = {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
    odometry.twist.twist = {{v[7], v[8], v[9]}, {v[10], v[11], v[12]}};
    const geometry_msgs::msg::Point bob{v[13], v[14], v[15]}, target{v[19], v[20], v[21]};
    const geometry_msgs::msg::Vector3 bob_velocity{v[16], v[17], v[18]};
    const flypend_measurement state = flypend_from_ros(odometry, bob, bob_velocity);
    for (int i = 0; i < 24; i++) {
        std::printf("%.17g ", static_cast<double>(reinterpret_cast<const flypend_real *>(&state)[i]));
    }
    std::printf("\n");
    FlypendControl control;
    for (uint32_t milliseconds = 0; milliseconds < 3; milliseconds++) {
        flypend_status status;
        geometry_msgs::msg::Wrench wrench{};
        odometry.header.stamp.sec = 17;
        odometry.header.stamp.nanosec = milliseconds * 1000000U;
        const bool due = control.step(odometry, bob, bob_velocity, target, wrench, status);
        std::printf("%.17g %.17g %.17g %.17g %d %d\n", wrench.force.z, wrench.torque.x, wrench.torque.y,
                    wrench.torque.z, static_cast<int>(status), static_cast<int>(due));
    }
    return 0;
}
