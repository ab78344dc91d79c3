// The embedded Runge-Kutta method of compile/loops/runge_kutta.cpp on vectors of W lanes, each with its own time and step,
// refilled from a queue; without statuses, samples and reductions.
#include <cmath>
#include <cstdint>
#include <cstring>

typedef double V __attribute__((vector_size(8 * W)));
typedef int64_t M __attribute__((vector_size(8 * W)));

static inline V all(double x) { V v; for (int i = 0; i < W; i++) v[i] = x; return v; }
static inline V root(V x) { V v; for (int i = 0; i < W; i++) v[i] = std::sqrt(x[i]); return v; }
static inline V size(V x) { return x < 0 ? -x : x; }
static inline V least(V a, V b) { return a < b ? a : b; }
static inline V most(V a, V b) { return a > b ? a : b; }
static inline bool any(M m) { int64_t r = 0; for (int i = 0; i < W; i++) r |= m[i]; return r; }

//PROGRAMS
//TABLES

static inline void combine(const double *w, int count, V h, const V *S, const V (*K)[N], V *Y) {
    for (int i = 0; i < N; i++) {
        V sum = w[0] * K[0][i];
        for (int j = 1; j < count; j++) if (w[j] != 0) sum += w[j] * K[j][i];
        Y[i] = S[i] + h * sum;
    }
}

static inline V power(V x, double p) {  // to some per cent, through the bits
    const double one = (double)(0x3FFLL << 52);
    V r;
    for (int i = 0; i < W; i++) {
        int64_t bits; double number = x[i];
        std::memcpy(&bits, &number, 8);
        bits = (int64_t)(((double)bits - one) * p + one);
        std::memcpy(&number, &bits, 8);
        r[i] = number;
    }
    return r;
}

extern "C" void kernel(const double *starts, int64_t runs, double duration, double rtol, double atol, double *final) {
    alignas(64) V S[N], Y[N], K[STAGES + 1][N], P[1], when[1], first[N], drift[3];
    V t = all(0), h = all(0), limit = all(0);
    M active = all(0) != 0;
    int64_t next = 0, left = W, run[W];
    for (int i = 0; i < N; i++) S[i] = K[0][i] = all(0);
    auto load = [&](int lane) {
        if (next < runs) {
            run[lane] = next;
            for (int i = 0; i < N; i++) S[i][lane] = starts[next * N + i];
            t[lane] = h[lane] = limit[lane] = 0; active[lane] = -1; next++;
        } else { active[lane] = 0; left--; }
    };
    auto begin = [&]() {
        M fresh = h <= 0;
        when[0] = t;
        rates(when, S, P, first);
        V a = all(0), b = all(0);
        for (int i = 0; i < N; i++) {
            K[0][i] = fresh ? first[i] : K[0][i];
            V scale = atol + rtol * size(S[i]);
            V x = S[i] / scale, y = K[0][i] / scale;
            a += x * x; b += y * y;
        }
        V step = 0.01 * root(a / most(b, all(1e-10)));
        h = fresh ? most(least(step, all(1e-2)), all(1e-6)) : h;
    };
    for (int lane = 0; lane < W; lane++) load(lane);
    begin();
    while (left > 0) {
        M last = t + 1.0001 * h >= duration;
        V step = last ? duration - t : h;
        for (int s = 1; s < STAGES; s++) {
            combine(A[s], s, step, S, K, Y);
            when[0] = t + C[s] * step;
            rates(when, Y, P, K[s]);
        }
        combine(B, STAGES, step, S, K, Y);
        when[0] = t + step;
        if (FSAL) rates(when, Y, P, K[STAGES]);
        V sums[2] = {all(0), all(0)};
        for (int i = 0; i < N; i++) {
            V scale = 1 / (atol + rtol * most(size(S[i]), size(Y[i])));
            for (int e = 0; e < ESTIMATES; e++) {
                V part = all(0);
                for (int j = 0; j < STAGES + FSAL; j++) if (E[e][j] != 0) part += E[e][j] * K[j][i];
                part *= scale;
                sums[e] += part * part;
            }
        }
        V error;
        if (ESTIMATES == 1) error = step * root(sums[0] / N);
        else { V both = sums[0] + 0.01 * sums[1]; error = both > 0 ? step * sums[0] / root(both * N) : both; }
        M accepted = (error <= 1) & active;
        project(Y, Y, drift);
        if (!FSAL) rates(when, Y, P, K[STAGES]);
        for (int i = 0; i < N; i++) {
            S[i] = accepted ? Y[i] : S[i];
            K[0][i] = accepted ? K[STAGES][i] : K[0][i];
        }
        t = accepted ? (last ? all(duration) : t + step) : t;
        V factor = SAFETY * power(most(error, all(1e-12)), -1.0 / ORDER);
        factor = least(most(factor, all(LEAST_FACTOR)), all(MOST_FACTOR));
        V grown = limit > 0 ? least(factor, all(1)) : factor;
        factor = accepted ? grown : (factor < 1 ? factor : all(LEAST_FACTOR));
        limit = accepted ? all(0) : all(1);
        h = active ? step * factor : h;
        M ended = accepted & (t >= duration);
        if (any(ended)) {
            for (int lane = 0; lane < W; lane++) if (ended[lane]) {
                for (int i = 0; i < N; i++) final[run[lane] * N + i] = S[i][lane];
                load(lane);
            }
            begin();
        }
    }
}
