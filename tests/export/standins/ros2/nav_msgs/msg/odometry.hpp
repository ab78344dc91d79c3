// Stand-in: an odometry with the stamp of its header.
#pragma once
#include <cstdint>

#include <geometry_msgs/msg/messages.hpp>
namespace nav_msgs
{
namespace msg
{
struct Odometry {
    struct {
        struct {
            int32_t sec = 0;
            uint32_t nanosec = 0;
        } stamp;
    } header;
    geometry_msgs::msg::PoseWithCovariance pose;
    geometry_msgs::msg::TwistWithCovariance twist;
};
} // namespace msg
} // namespace nav_msgs
