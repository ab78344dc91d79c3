/* Random inputs, and what flypend answers in Python. */
#ifndef FLYPEND_VECTORS_H
#define FLYPEND_VECTORS_H
#include "flypend_law.h"

#define FLYPEND_VECTOR_TOLERANCE $vector_tolerance
#define FLYPEND_FLIGHT_STEPS $steps

typedef struct {
    flypend_state state;
    flypend_reference reference;
    flypend_wrench wrench;
    flypend_rotors rotors;
} flypend_vector;

static const flypend_vector flypend_vectors[] = {
$vectors
};

/* Flights of the board one after the other, FLYPEND_FLIGHT_STEPS control periods each. */
typedef struct {
    flypend_measurement measurement;
    flypend_path path;
    flypend_rotors rotors;
} flypend_period;

static const flypend_period flypend_flights[] = {
$flights
};
#endif
