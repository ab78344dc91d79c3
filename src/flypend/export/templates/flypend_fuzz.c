/* libFuzzer target: whatever the bits of the inputs, no output is NaN or infinite. */
#include "flypend_law.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    flypend_state state;
    flypend_reference reference;
    flypend_path path;
    flypend_gains gains;
    flypend_params params;
    flypend_wrench wrench;
    flypend_rotors wanted;
    flypend_rotors modelled;
    flypend_real lead;
} inputs;

static void require_finite(const flypend_real *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!((values[i] >= -$largest) && (values[i] <= $largest))) {
            abort();
        }
    }
}

#define REQUIRE_FINITE(record) require_finite((const flypend_real *)&(record), sizeof(record) / sizeof(flypend_real))

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The first byte says which records keep numbers that are valid, so that the equations are reached as well. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const flypend_real upright[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    inputs in;
    flypend_wrench wrench;
    flypend_rotors rotors;
    flypend_reference reference;
    unsigned valid;
    if (size == 0) {
        return 0;
    }
    valid = data[0];
    memset(&in, 0, sizeof in);
    memcpy(&in, data + 1, (size - 1 < sizeof in) ? size - 1 : sizeof in);
    if (valid & 1U) {
        in.params = flypend_default_params;
    }
    if (valid & 2U) {
        in.gains = flypend_default_gains;
    }
    if (valid & 4U) {
        memcpy(in.state.R, upright, sizeof upright);
    }
    if (valid & 8U) {
        memcpy(in.state.y, upright, sizeof in.state.y);
        in.state.y_dot[0] = 0;
    }
    if (valid & 16U) {
        memset(&in.reference, 0, sizeof in.reference);
    }
    (void)flypend_step(&in.state, &in.reference, &in.gains, &in.params, &wrench);
    REQUIRE_FINITE(wrench);
    (void)flypend_mix((valid & 32U) ? &wrench : &in.wrench, &in.params, &rotors);
    REQUIRE_FINITE(rotors);
    (void)flypend_lead((valid & 32U) ? &rotors : &in.wanted, &in.modelled, in.lead, &in.params, &in.wanted);
    REQUIRE_FINITE(in.wanted);
    (void)flypend_follow(&in.path, &in.state, &in.params, &reference);
    REQUIRE_FINITE(reference);
    return 0;
}
