// A program at every stage of a horizon: of one problem per lane or, ABREAST, of W stages of one problem at a time.
#include "horizon.hpp"
#include "transpose.hpp"

extern "C" {
extern const int64_t INPUTS, ABREAST;
extern const double LENGTHS[];  // of each array at a stage; inputs come first
extern const int64_t TOTAL;     // their sum
void stage(T *const *arrays);   // arrays of vectors
}

#if WIDTH == 8
// Rows of W stages to vectors, and back.
static INLINE void spread(const T *rows, V *vectors, int64_t length) {
    const int64_t whole = length - length % W;
    for (int64_t first = 0; first < whole; first += W) {
        V block[W];
        EACH_LANE block[lane] = *(const Row *)(rows + lane * length + first);
        transpose(block);
        UNROLLED for (int64_t i = 0; i < W; i++) vectors[first + i] = block[i];
    }
    EACH_LANE from_row(rows + lane * length + whole, vectors + whole, lane, length - whole);
}

static INLINE void turn(V *vectors, T *rows, int64_t length) {
    const int64_t whole = length - length % W;
    for (int64_t first = 0; first < whole; first += W) {
        V block[W];
        UNROLLED for (int64_t i = 0; i < W; i++) block[i] = vectors[first + i];
        transpose(block);
        EACH_LANE *(Row *)(rows + lane * length + first) = block[lane];
    }
    EACH_LANE into_row(vectors + whole, lane, rows + lane * length + whole, length - whole);
}

// The last stages are computed twice if their number is no multiple of W.
static INLINE void abreast(int64_t first, int64_t count, T *const *arrays) {
    V memory[TOTAL];
    T *here[ARRAYS], *own[ARRAYS];
    int64_t place = 0;
    UNROLLED for (int64_t a = 0; a < ARRAYS; place += int64_t(LENGTHS[a++])) own[a] = (T *)(memory + place);
    UNROLLED for (int64_t a = 0; a < INPUTS; a++)
        if (STRIDES[a] == 0)
            for (int64_t i = 0; i < int64_t(LENGTHS[a]); i++) ((V *)own[a])[i] = all(arrays[a][i]);
    for (int64_t group = 0; group < count; group += W) {
        find(arrays, first + (group < count - W ? group : count - W), here);
        UNROLLED for (int64_t a = 0; a < INPUTS; a++)
            if (STRIDES[a] != 0) spread(here[a], (V *)own[a], int64_t(LENGTHS[a]));
        stage(own);
        UNROLLED for (int64_t a = INPUTS; a < ARRAYS; a++) turn((V *)own[a], here[a], int64_t(LENGTHS[a]));
    }
}
#else
static INLINE void abreast(int64_t, int64_t, T *const *) {}
#endif

extern "C" void kernel(int64_t first, int64_t count, T *const *arrays) {
    if (ABREAST) abreast(first, count, arrays);
    else each_stage(first, count, arrays, [](T *const *here) WITHIN { stage(here); });
}
