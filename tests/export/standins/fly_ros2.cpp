// Reads position, quaternion xyzw, twist (body frame), bob, its velocity, target; writes the state, then the wrench.
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
    const flypend_state state = flypend_from_ros(odometry, bob, bob_velocity);
    for (int i = 0; i < 24; i++) {
        std::printf("%.17g ", static_cast<double>(reinterpret_cast<const flypend_real *>(&state)[i]));
    }
    flypend_status status;
    const geometry_msgs::msg::Wrench wrench = flypend_control(odometry, bob, bob_velocity, target, status);
    std::printf("\n%.17g %.17g %.17g %.17g %d\n", wrench.force.z, wrench.torque.x, wrench.torque.y, wrench.torque.z,
                static_cast<int>(status));
    return 0;
}
