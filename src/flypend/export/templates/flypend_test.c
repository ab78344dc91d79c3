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

int main(void)
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
        double apart[3];
        if ((flypend_step(&vector->state, &vector->reference, &flypend_default_gains, params, &wrench) != FLYPEND_OK)
            || (flypend_mix(&vector->wrench, params, &rotors) != FLYPEND_OK)) {
            (void)printf("vector %d is refused\n", i);
            return 1;
        }
        apart[0] = difference(&wrench.thrust, &vector->wrench.thrust, 1, thrust_scale);
        apart[1] = difference(wrench.moment, vector->wrench.moment, 3, moment_scale);
        apart[2] = difference(rotors.force, vector->rotors.force, FLYPEND_ROTORS, thrust_scale);
        for (int j = 0; j < 3; j++) {
            worst = (apart[j] > worst) ? apart[j] : worst;
        }
    }
    (void)printf("%d vectors, largest relative difference %.3g, allowed %.3g\n", count, worst, FLYPEND_VECTOR_TOLERANCE);
    return (worst <= FLYPEND_VECTOR_TOLERANCE) ? 0 : 1;
}
