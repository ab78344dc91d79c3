// Stand-in: an odometry without its header.
#pragma once
#include <geometry_msgs/msg/messages.hpp>
namespace nav_msgs
{
namespace msg
{
struct Odometry {
    geometry_msgs::msg::PoseWithCovariance pose;
    geometry_msgs::msg::TwistWithCovariance twist;
};
} // namespace msg
} // namespace nav_msgs
