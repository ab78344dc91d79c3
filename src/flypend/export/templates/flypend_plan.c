/* $title */
#include <math.h>
#include "flypend_plan.h"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-ffast-math and -ffinite-math-only let a compiler assume that no number is NaN, and drop the checks below"
#endif

enum { ROTORS = FLYPEND_PLAN_ROTORS, STAGES = FLYPEND_PLAN_STAGES, STATE = $state, OFF = $off };
static const flypend_real stage = $stage;
/* Nominal states and rotor forces at the beginning of each stage, the last being hover. */
static const flypend_real states[STAGES + 1][STATE] = {
$states
};
static const flypend_real commands[STAGES + 1][ROTORS] = {
$commands
};
static const flypend_real gains[STAGES + 1][ROTORS][OFF] = {
$gains
};

$functions

int flypend_plan_command(flypend_real t, const flypend_real *state, const flypend_real *rotors, flypend_real *command)
{
$scratch    flypend_real here[STATE], nominal[STATE], off[OFF], forces[ROTORS], into, rod, pivot, sum;
    int i, j, k = STAGES;

    sum = $zero * t; /* 0 as long as all are finite, else not a number */
    for (i = 0; i < 24; i++)
        here[i] = state[i];
    for (i = 0; i < ROTORS; i++)
        here[24 + i] = rotors[i];
    for (i = 0; i < STATE; i++)
        sum += $zero * here[i];
    if (t < stage * (flypend_real)STAGES)
        k = (t > 0) ? (int)(t / stage) : 0;
    into = t - stage * (flypend_real)k;
    if (k < STAGES && into > $short * stage) {
        $advance
    } else {
        for (i = 0; i < STATE; i++)
            nominal[i] = states[k][i];
    }
    if (k < STAGES)
        $deviation
    else
        $hovering
    rod = off[12] * off[12] + off[13] * off[13] + off[14] * off[14];
    pivot = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
    for (i = 0; i < ROTORS; i++) {
        forces[i] = commands[k][i];
        for (j = 0; j < OFF; j++)
            forces[i] -= gains[k][i][j] * off[j];
        sum += $zero * forces[i];
    }
    if (!(rod < $far_rod && pivot < $far_pivot && sum >= 0))
        return 1;
    for (i = 0; i < ROTORS; i++)
        command[i] = (forces[i] < $low) ? $low : ((forces[i] > $high) ? $high : forces[i]);
    return 0;
}
