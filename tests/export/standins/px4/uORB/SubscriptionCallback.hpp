// Stand-in: see uorb.hpp.
#include <uORB/uorb.hpp>
