// Where the parts of a packed state begin.
#pragma once

#include <stdint.h>

constexpr int64_t OMEGA = 15;  // the angular velocity
