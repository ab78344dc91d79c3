/* Checks ------------------------------------------------------------------------------------------------------- */

/* 0 times infinity, or times what is no number, is no number, and neither is a sum with it. */
static int numbers(const flypend_real *values, int count)
{
    flypend_real none = 0;
    for (int i = 0; i < count; i++) {
        none += 0 * values[i];
    }
    return none >= 0;
}

/* Words of 32 bits in a number. */
#define FLYPEND_WORDS ((int)(sizeof(flypend_real) / sizeof(uint32_t)))

/* The check word after `count` more numbers, of 32 bits each or of twice as many. A step h -> R L (h ^ word), with L of
 * the two left shifts and R of the right one, is linear over bits and runs through all 2^32 - 1 words but 0, so it is a
 * product in the field of 2^32 words. Hence no change of one word, of two bits, or of two words that are exchanged stays
 * unseen; and since L takes bits up and R takes them down again, no change within 32 bits in a row. Of all other changes
 * it misses one in 2^32. */
static uint32_t check_word(uint32_t h, const flypend_real *values, int count)
{
    for (int i = 0; i < count; i++) {
        union {
            flypend_real value;
            uint32_t words[FLYPEND_WORDS];
        } bits;
        bits.value = values[i];
        for (int k = 0; k < FLYPEND_WORDS; k++) {
            h ^= bits.words[k];
            h ^= h << 5;
            h ^= h << 7;
            h ^= h >> 9;
        }
    }
    return h;
}

static int is_rotation(flypend_real *rest, const flypend_real *s)
{
    flypend_real defect[2];
    (void)rest;
    $call_attitude
    return (defect[0] <= FLYPEND_ROTATION_TOLERANCE) && (defect[1] > 0);
}

static flypend_status check_state(flypend_real *rest, const flypend_real *s)
{
    flypend_real defect[3];
    $call_rod
    if (!((defect[0] <= FLYPEND_TOLERANCE) && (defect[1] <= FLYPEND_TOLERANCE * (1 + defect[2])))) {
        return FLYPEND_ROD;
    }
    return is_rotation(rest, s) ? FLYPEND_OK : FLYPEND_ATTITUDE;
}
