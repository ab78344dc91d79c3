// Stand-in: the fields of the ROS 2 messages that the adapter uses.
#pragma once
namespace geometry_msgs
{
namespace msg
{
struct Point {
    double x, y, z;
};
struct Vector3 {
    double x, y, z;
};
struct Quaternion {
    double x, y, z, w;
};
struct Wrench {
    Vector3 force, torque;
};
struct Pose {
    Point position;
    Quaternion orientation;
};
struct Twist {
    Vector3 linear, angular;
};
struct PoseWithCovariance {
    Pose pose;
};
struct TwistWithCovariance {
    Twist twist;
};
} // namespace msg
} // namespace geometry_msgs
