// Stand-in: see messages.hpp.
#include <geometry_msgs/msg/messages.hpp>
