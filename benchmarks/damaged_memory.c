/* Damages memories of the exported flight computer and steps them: `damaged COUNT SEED`, see damaged_memory.py.
 *
 * Prints for each kind of damage how many there were, how many were refused (FLYPEND_NOT_BEGUN), and of the others how
 * many commanded what the sound memory does and how many did not. Exits with 1 if an answer to a damaged memory is not
 * finite or out of limits, if a restart fails, or a refusal is not for the memory's sake. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "flown.h"

/* What is damaged: a struct of words of 32 bits. */
#define BYTES ((int)offsetof(COMPUTER, scratch)) /* what is remembered; the rest is written before it is read */
#define PAST 8

enum { FLIP, TWO_FLIPS, BURST, BYTES_RANDOM, STUCK, PATTERN, SWAPPED, REGION, PART_REPLAYED, WHOLE_REPLAYED, KINDS };

static const char *const names[KINDS] = {"one bit flipped",  "two bits flipped",       "a burst of up to 32 bits",
                                         "random bytes",     "a region stuck",         "a number replaced",
                                         "regions swapped",  "a region of random bits", "a region of the past",
                                         "all of the past"};
static uint64_t seed;

static uint32_t randomly(uint32_t below)
{
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return (uint32_t)(((seed >> 33) * below) >> 31);
}

static void flip(unsigned char *bytes, int bit)
{
    bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ (1U << (bit % 8)));
}

static void replace(unsigned char *bytes)
{
    const flypend_real values[] = {(flypend_real)NAN, (flypend_real)INFINITY, -(flypend_real)INFINITY, 0,
                                   -(flypend_real)0., (flypend_real)1e-40,    (flypend_real)1e30,      1,
                                   -1,                (flypend_real)1e-310};
    const uint32_t count = (uint32_t)(sizeof values / sizeof values[0]);
    const size_t place = 8 + sizeof(flypend_real) * randomly((uint32_t)(((size_t)BYTES - 8) / sizeof(flypend_real)));
    memcpy(bytes + place, &values[randomly(count)], sizeof(flypend_real));
}

static void damage(int kind, unsigned char *bytes, const unsigned char *past)
{
    const int from = (int)randomly((uint32_t)BYTES);
    const int length = 1 + (int)randomly((uint32_t)(BYTES - from));
    const int first = (int)randomly(8U * (uint32_t)BYTES);
    int bits = 1 + (int)randomly(32);
    unsigned char kept[sizeof(COMPUTER)];
    switch (kind) {
    case FLIP:
        flip(bytes, first);
        break;
    case TWO_FLIPS:
        flip(bytes, first);
        flip(bytes, (int)randomly(8U * (uint32_t)BYTES));
        break;
    case BURST:
        bits = (first + bits > 8 * BYTES) ? 8 * BYTES - first : bits;
        for (int i = 0; i < bits; i++) {
            if (randomly(2) == 1) {
                flip(bytes, first + i);
            }
        }
        break;
    case BYTES_RANDOM:
        for (uint32_t i = 0, count = 1 + randomly(16); i < count; i++) {
            bytes[randomly((uint32_t)BYTES)] = (unsigned char)randomly(256);
        }
        break;
    case STUCK:
        memset(bytes + from, (int)((randomly(2) == 1) ? randomly(256) : 255 * randomly(2)), (size_t)length);
        break;
    case PATTERN:
        replace(bytes);
        break;
    case SWAPPED:
        memcpy(kept, bytes, sizeof kept);
        bits = 4 * (1 + (int)randomly((uint32_t)BYTES / 8)); /* of two regions in different halves */
        bits = (bits > BYTES / 2) ? BYTES / 2 : bits;
        memcpy(bytes, kept + BYTES - bits, (size_t)bits);
        memcpy(bytes + BYTES - bits, kept, (size_t)bits);
        break;
    case REGION:
        for (int i = 0; i < length; i++) {
            bytes[from + i] = (unsigned char)randomly(256);
        }
        break;
    case PART_REPLAYED:
        memcpy(bytes + from, past + from, (size_t)length);
        break;
    default:
        memcpy(bytes, past, sizeof kept);
    }
}

static int within_limits(const flypend_rotors *rotors)
{
    int good = 1;
    for (int i = 0; i < FLYPEND_ROTORS; i++) {
        good = good && (rotors->force[i] >= flypend_default_params.rotor_least * (flypend_real)0.999999)
            && (rotors->force[i] <= flypend_default_params.rotor_largest * (flypend_real)1.000001);
    }
    return good;
}

int main(int argc, char **argv)
{
    const long count = (argc > 1) ? atol(argv[1]) : 1000;
    const int periods = (int)(sizeof flypend_flights / sizeof flypend_flights[0]);
    static COMPUTER past[PAST];
    COMPUTER sound;
    long tried[KINDS] = {0}, refused[KINDS] = {0}, same[KINDS] = {0}, other[KINDS] = {0};
    seed = (argc > 2) ? (uint64_t)atol(argv[2]) : 1;
    memset(&sound, 0, sizeof sound);
    for (long n = 0, tick = 0; n < count; n++) {
        const int period = (int)(tick % periods);
        if (period % FLYPEND_FLIGHT_STEPS == 0) {
            if (begin(&sound) != FLYPEND_OK) {
                return 2;
            }
            for (int i = 0; i < PAST; i++) {
                past[i] = sound;
            }
        }
        COMPUTER damaged = sound, after = sound;
        int kind = (int)randomly(KINDS);
        const COMPUTER *before = &past[randomly(PAST)];
        damage(kind, (unsigned char *)&damaged, (const unsigned char *)before);
        if ((kind == PART_REPLAYED) && (memcmp(&damaged, before, (size_t)BYTES) == 0)) {
            kind = WHOLE_REPLAYED; /* the region held all that has changed since */
        }
        flypend_rotors expected, rotors;
        const flypend_status right = step(&after, &flypend_flights[period], &expected);
        if (memcmp(&damaged, &sound, (size_t)BYTES) != 0) {
            COMPUTER again = damaged;
            const flypend_status status = step(&damaged, &flypend_flights[period], &rotors);
            tried[kind]++;
            if (!within_limits(&rotors)) {
                (void)printf("%s: a command out of limits\n", names[kind]);
                return 1;
            }
            if (status == FLYPEND_NOT_BEGUN) {
                refused[kind]++;
                if ((pass(&damaged) != FLYPEND_NOT_BEGUN) || (restart(&again, &rotors) != FLYPEND_OK)
                    || (step(&again, &flypend_flights[period], &rotors) != right) || !within_limits(&rotors)) {
                    (void)printf("%s: it does not begin again\n", names[kind]);
                    return 1;
                }
            } else if ((status == right) && (memcmp(&rotors, &expected, sizeof rotors) == 0)) {
                same[kind]++;
            } else {
                other[kind]++;
            }
        }
        if (n % 16 == 15) { /* on to the next period */
            past[tick % PAST] = sound;
            sound = after;
            tick++;
        }
    }
    for (int k = 0; k < KINDS; k++) {
        (void)printf("%s,%ld,%ld,%ld,%ld\n", names[k], tried[k], refused[k], same[k], other[k]);
    }
    return 0;
}
