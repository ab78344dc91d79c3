// The backward recursion of linear-quadratic problems; `flypend.planning.riccati` has the equations and the layout.
//
// With BY_LANE each lane has a problem. Else there is one: the lanes take W numbers of a row, and a number stands in all.
#include "horizon.hpp"

extern "C" {
extern const int64_t BY_LANE, n, m;       // lengths of state and command
extern const int64_t PARTS;               // of a row: vectors
extern const int64_t P_AT[];              // (n, n): the place of the entry i, j of P, or of its transpose
extern const int64_t F_COLUMN[], F_ROW[], F_AT[];     // F = [A B], column by column: first entries, rows, places
extern const int64_t F_PART[], F_PART_ROW[], F_PART_AT[];  // the same of its vectors that are not zero
extern const int64_t Q_ENTRIES, Q_AT[];   // places in P of what is not zero of Q; -1 for its lower half
extern const int64_t SHARED;              // the place of c, g and v in a cost to go
}

constexpr int64_t GROUP = 4;  // sums at a time, which hide the latency of each other,
constexpr int64_t MANY = 10;  // and share what they load
#define EACH_OF_GROUP UNROLLED for (int64_t g = 0; g < GROUP; g++)
#define EACH_OF_MANY UNROLLED for (int64_t g = 0; g < MANY; g++)

static INLINE V number(const T *memory, int64_t i) { return BY_LANE ? ((const Row *)memory)[i] : all(memory[i]); }
static INLINE V number(const Row *row, int64_t i) { return number((const T *)row, i); }
static INLINE void put(V value, T *memory, int64_t i) {
    if (BY_LANE) ((Row *)memory)[i] = value;
    else memory[i] = value[0];
}

// Factors of a matrix S = L D Lᵀ (m, m), symmetric and definite; L is below a diagonal of ones.
struct Factors {
    V *L, *D;

    INLINE void of(const V *S) const {
        for (int64_t j = 0; j < m; j++) {
            for (int64_t i = j; i < m; i++) {
                V rest = S[i * m + j];
                for (int64_t h = 0; h < j; h++) rest -= L[i * m + h] * L[j * m + h] * D[h];
                if (i == j) D[j] = rest;
                else L[i * m + j] = rest / D[j];
            }
        }
    }

    // x = −S⁻¹ x
    INLINE void solve(V *x) const {
        for (int64_t i = 0; i < m; i++)
            for (int64_t h = 0; h < i; h++) x[i] -= L[i * m + h] * x[h];
        for (int64_t i = 0; i < m; i++) x[i] *= -1 / D[i];
        for (int64_t i = m - 1; i >= 0; i--)
            for (int64_t h = i + 1; h < m; h++) x[i] -= L[h * m + i] * x[h];
    }
};

// Row i of PF times F from its part `first` on: Σ_j F_ji (PF)_j.
static INLINE void curve(const V *PF, const T *F, int64_t i, int64_t first, V *sum) {
    EACH_OF_GROUP sum[g] = V{};
    for (int64_t f = F_COLUMN[i]; f < F_COLUMN[i + 1]; f++) {
        const V factor = number(F, F_AT[f]);
        EACH_OF_GROUP if (g < PARTS) sum[g] += PF[F_ROW[f] * PARTS + first + g] * factor;
    }
}

extern "C" void kernel(int64_t first, int64_t count, T *const *arrays) {
    V PF[n * PARTS + GROUP], Q_u[m * PARTS], K[m * PARTS];
    V whole[(BY_LANE ? n * n : n * n / W + 1) + MANY], p_d[PARTS], x[PARTS], e[PARTS], S[m * m], L[m * m], D[m], k[m], k_e[m], column[m];
    T *const P = (T *)whole;
    const Factors factors{L, D};

    each_stage(first, count, arrays, [&](T *const *here) WITHIN {
        const T *after = here[0], *F = here[1], *d = here[2], *cost = here[3], *damping = here[4];
        T *before = here[5], *gains = here[6];
        const Row *F_parts = (const Row *)F, *h = (const Row *)cost, *h_e = h + PARTS;
        const T *R = cost + 2 * PARTS * W, *Q;
        const int64_t row = BY_LANE ? 1 : W, unit = BY_LANE ? W : 1;  // numbers in a part; doubles in a number
        const Row *p = (const Row *)(after + (SHARED - 2 * PARTS * row) * unit), *p_e = p + PARTS;
        Q = R + (m + 2) * unit;

        // P whole, of one of its halves: what rounding leaves of a difference between them would grow like an open loop.
        for (int64_t i = 0; i < n; i++)
            for (int64_t j = i; j < n; j++) {
                const V entry = number(after, P_AT[i * n + j]);
                put(entry, P, i * n + j), put(entry, P, j * n + i);
            }

        // PF, p + P d and the rows of F below them
        for (int64_t group = 0; group < n; group += MANY) {
            const int64_t last = n < MANY ? 0 : n - MANY, i = group < last ? group : last;
            for (int64_t b = 0; b < PARTS; b++) {
                V sum[MANY];
                EACH_OF_MANY sum[g] = V{};
                for (int64_t f = F_PART[b]; f < F_PART[b + 1]; f++) {
                    const V part = F_parts[F_PART_AT[f]];
                    EACH_OF_MANY sum[g] += part * number(P, F_PART_ROW[f] * n + i + g);
                }
                EACH_OF_MANY if (n >= MANY || g < n) PF[(i + g) * PARTS + b] = sum[g];
            }
        }
        for (int64_t b = 0; b < PARTS; b++) {
            V sum = p[b];
            for (int64_t j = 0; j < n; j++)
                if (!BY_LANE) sum += ((const Row *)after)[j * PARTS + b] * number(d, j);
                else if (b < n) sum += ((const Row *)after)[P_AT[b * n + j]] * number(d, j);
            p_d[b] = sum;
        }
        for (int64_t b = 0; b < PARTS; b++) {
            V sum = h[b], sum_e = h_e[b];
            for (int64_t f = F_PART[b]; f < F_PART[b + 1]; f++) {
                sum += F_parts[F_PART_AT[f]] * number(p_d, F_PART_ROW[f]);
                sum_e += F_parts[F_PART_AT[f]] * number(p_e, F_PART_ROW[f]);
            }
            x[b] = sum, e[b] = sum_e;
        }

        // The command: υ = K δ + k + k_e ε
        for (int64_t i = 0; i < m; i++) {
            for (int64_t b = 0; b < PARTS; b += GROUP) {
                V sum[GROUP];
                curve(PF, F, n + i, b, sum);
                EACH_OF_GROUP if (b + g < PARTS) Q_u[i * PARTS + b + g] = sum[g];
            }
            for (int64_t j = 0; j < m; j++) S[i * m + j] = number(Q_u + i * PARTS, n + j);
            S[i * m + i] += number(R, i) + number(damping, 1);
            k[i] = number(x, n + i), k_e[i] = number(e, n + i);
        }
        factors.of(S);
        factors.solve(k), factors.solve(k_e);
        for (int64_t b = 0; b < PARTS; b++) {
            for (int64_t i = 0; i < m; i++) column[i] = Q_u[i * PARTS + b];
            factors.solve(column);
            for (int64_t i = 0; i < m; i++) K[i * PARTS + b] = column[i];
        }

        // The cost to go
        for (int64_t i = 0; i < n; i++) {
            for (int64_t b = BY_LANE ? i : 0; b < (BY_LANE ? n : PARTS); b += GROUP) {
                V sum[GROUP];
                curve(PF, F, i, b, sum);
                for (int64_t j = 0; j < m; j++) {
                    const V factor = number(Q_u + j * PARTS, i);
                    EACH_OF_GROUP if (b + g < PARTS) sum[g] += K[j * PARTS + b + g] * factor;
                }
                EACH_OF_GROUP {
                    if (!BY_LANE && b + g < PARTS) ((Row *)before)[i * PARTS + b + g] = sum[g];
                    if (BY_LANE && b + g < n) ((Row *)before)[P_AT[i * n + b + g]] = sum[g];
                }
            }
        }
        for (int64_t i = 0; i < n; i++) {
            const int64_t at = P_AT[i * n + i];
            put(number(before, at) + number(damping, 0), before, at);
        }
        for (int64_t i = 0; i < Q_ENTRIES; i++)
            if (Q_AT[i] >= 0) put(number(before, Q_AT[i]) + number(Q, i), before, Q_AT[i]);
        Row *p_new = (Row *)(before + (SHARED - 2 * PARTS * row) * unit), *p_e_new = p_new + PARTS;
        for (int64_t b = 0; b < PARTS; b++) {
            p_new[b] = x[b], p_e_new[b] = e[b];
            for (int64_t j = 0; j < m; j++)
                p_new[b] += Q_u[j * PARTS + b] * k[j], p_e_new[b] += Q_u[j * PARTS + b] * k_e[j];
        }
        V c = number(after, SHARED) + number(R, m), g = number(after, SHARED + 1) + number(R, m + 1), v{};
        for (int64_t i = 0; i < n; i++) {
            g += number(d, i) * number(p_e, i);
            v += number(d, i) * (number(p, i) + number(p_d, i));
        }
        for (int64_t j = 0; j < m; j++) {
            c += k_e[j] * number(e, n + j);
            g += k[j] * number(e, n + j);
            v += k[j] * number(x, n + j);
        }
        put(c, before, SHARED), put(g, before, SHARED + 1);
        put(number(after, SHARED + 2) + T(0.5) * v, before, SHARED + 2);

        for (int64_t i = 0; i < m; i++) {
            for (int64_t j = 0; j < n; j++) put(number(K + i * PARTS, j), gains, i * n + j);
            put(k[i], gains, m * n + i), put(k_e[i], gains, m * (n + 1) + i);
        }
    });
}
