/* libFuzzer target: whatever the bits of the inputs, no output is NaN or infinite. */
#include "flypend_law.h"

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What the board is given one after the other: good measurements follow on bad ones. */
#define STEPS 3

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
    flypend_real memory[FLYPEND_MEMORY];
    flypend_measurement measurement[STEPS];
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

static const flypend_real upright[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void fly_board(unsigned valid, inputs *in)
{
    flypend_board board;
    flypend_rotors rotors;
    int damaged = 0;
    memset(&board, 0, sizeof board);
    if (flypend_board_restart(&board, &in->gains, &in->params, (valid & 32U) ? NULL : &in->modelled) == FLYPEND_OK) {
        require_finite(board.memory, FLYPEND_MEMORY);
        (void)flypend_board_set_gains(&board, &in->gains);
    }
    if (valid & 64U) { /* whatever is written there, it is not flown with */
        damaged = memcmp(board.memory, in->memory, sizeof board.memory) != 0;
        memcpy(board.memory, in->memory, sizeof board.memory);
    }
    for (int i = 0; i < STEPS; i++) {
        flypend_measurement *measurement = &in->measurement[i];
        flypend_status status;
        if (valid & 4U) {
            memcpy(measurement->R, upright, sizeof upright);
        }
        if (valid & 8U) {
            memcpy(measurement->y, upright, sizeof measurement->y);
            measurement->y_dot[0] = 0;
        }
        status = flypend_board_step(&board, (valid & 128U) && (i == 1) ? NULL : measurement, &in->path, &in->params, &rotors);
        REQUIRE_FINITE(rotors);
        if (damaged && ((status == FLYPEND_OK) || (status == FLYPEND_SINGULAR) || (flypend_board_pass(&board) == FLYPEND_OK))) {
            abort();
        }
        (void)flypend_board_pass(&board);
    }
    if (!damaged) {
        require_finite(board.memory, FLYPEND_MEMORY);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The first byte says which records keep numbers that are valid, so that the equations are reached as well. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
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
        memset(&in.path, 0, sizeof in.path);
    }
    (void)flypend_step(&in.state, &in.reference, &in.gains, &in.params, &wrench);
    REQUIRE_FINITE(wrench);
    (void)flypend_mix((valid & 32U) ? &wrench : &in.wrench, &in.params, &rotors);
    REQUIRE_FINITE(rotors);
    (void)flypend_lead((valid & 32U) ? &rotors : &in.wanted, &in.modelled, in.lead, &in.params, &in.wanted);
    REQUIRE_FINITE(in.wanted);
    (void)flypend_unmix(&in.modelled, &in.params, &wrench);
    REQUIRE_FINITE(wrench);
    (void)flypend_follow(&in.path, &in.state, &in.params, &reference);
    REQUIRE_FINITE(reference);
    fly_board(valid, &in);
    return 0;
}
