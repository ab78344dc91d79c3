/* Checks the compiled law against numbers that flypend computed in Python: exit code 0 if all agree. */
#include "flypend_law.h"
#include "flypend_vectors.h"

#include <float.h>
#include <stddef.h>
#include <stdio.h>

/* Difference of `count` numbers over the largest of them, but at least `scale`. */
static double difference(const flypend_real *found, const flypend_real *wanted, int count, double scale)
{
    double apart = 0.0;
    for (int i = 0; i < count; i++) {
        const double error = (double)found[i] - (double)wanted[i];
        const double size = (wanted[i] < 0) ? -(double)wanted[i] : (double)wanted[i];
        const double off = (error < 0) ? -error : error;
        scale = (size > scale) ? size : scale;
        /* Written so that NaN counts as infinitely far. */
        apart = (off <= apart) ? apart : ((off <= DBL_MAX) ? off : DBL_MAX);
    }
    return apart / scale;
}

static double most(double a, double b)
{
    return (a > b) ? a : b;
}

/* Largest difference of the bare law and the mixing; -1 if a vector is refused. */
static double law_apart(void)
{
    const flypend_params *params = &flypend_default_params;
    const double moment_scale = $moment_scale;
    const double thrust_scale = $thrust_scale;
    const int count = (int)(sizeof flypend_vectors / sizeof flypend_vectors[0]);
    double worst = 0.0;
    for (int i = 0; i < count; i++) {
        const flypend_vector *vector = &flypend_vectors[i];
        flypend_wrench wrench;
        flypend_rotors rotors;
        if ((flypend_step(&vector->state, &vector->reference, &flypend_default_gains, params, &wrench) != FLYPEND_OK)
            || (flypend_mix(&vector->wrench, params, &rotors) != FLYPEND_OK)) {
            (void)printf("vector %d is refused\n", i);
            return -1;
        }
        worst = most(worst, difference(&wrench.thrust, &vector->wrench.thrust, 1, thrust_scale));
        worst = most(worst, difference(wrench.moment, vector->wrench.moment, 3, moment_scale));
        worst = most(worst, difference(rotors.force, vector->rotors.force, FLYPEND_ROTORS, thrust_scale));
    }
    (void)printf("%d vectors, largest relative difference %.3g, allowed %.3g\n", count, worst, FLYPEND_VECTOR_TOLERANCE);
    return worst;
}

/* The same of the board along flights, in which it remembers what it did itself. */
static double board_apart(void)
{
    const flypend_params *params = &flypend_default_params;
    const int count = (int)(sizeof flypend_flights / sizeof flypend_flights[0]);
    flypend_board board;
    double worst = 0.0;
    for (int i = 0; i < count; i++) {
        const flypend_period *period = &flypend_flights[i];
        flypend_rotors rotors;
        if (((i % FLYPEND_FLIGHT_STEPS == 0)
             && (flypend_board_begin(&board, &flypend_default_gains, params) != FLYPEND_OK))
            || (flypend_board_step(&board, &period->measurement, &period->path, params, &rotors) != FLYPEND_OK)) {
            (void)printf("period %d is refused\n", i);
            return -1;
        }
        worst = most(worst, difference(rotors.force, period->rotors.force, FLYPEND_ROTORS, $thrust_scale));
    }
    (void)printf("%d periods, largest relative difference %.3g, allowed %.3g\n", count, worst, FLYPEND_VECTOR_TOLERANCE);
    return worst;
}

int main(void)
{
    const double law = law_apart();
    const double board = board_apart();
    const int right = (law >= 0) && (law <= FLYPEND_VECTOR_TOLERANCE) && (board >= 0) && (board <= FLYPEND_VECTOR_TOLERANCE);
    return right ? 0 : 1;
}
