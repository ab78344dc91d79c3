// Stand-in: see topics.hpp.
#include <uORB/topics/topics.hpp>
