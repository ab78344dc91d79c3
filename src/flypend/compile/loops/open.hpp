// What is left open when this is compiled, and linked when a kernel is made: sizes, the tableau, and the programs.
#pragma once

#include "lanes.hpp"

extern "C" {
// Sizes of the problem.
extern const int64_t N;           // entries of the state s, a multiple of 4
extern const int64_t PARAMETERS;  // of p
extern const int64_t WRENCH;      // of the wrench; 0 without one
extern const int64_t GAUGES;      // of a criterion; 0 without one
extern const int64_t SMOOTH;      // whether the gauges are without cases
extern const int64_t GUARDED;     // whether the law has a margin
extern const int64_t TOUCHES;     // whether the rod can touch anything
extern const double BOUNDS[];     // of the gauges
extern const double MOST_STATE;   // |s| beyond it is lost
extern const double LONGEST;      // s: the rod's motion in between is a cubic

// An embedded Runge-Kutta method of s stages; `flypend.compile.methods` has the arrays, here row by row. Stage s is at
// the end of the step.
extern const int64_t STAGES;      // s
extern const int64_t EXTRA;       // e, additional stages for the dense output
extern const int64_t ESTIMATES;   // of the error: 1, or 2 that Hairer's formula combines
extern const int64_t USES_END;    // whether an estimate needs f at the end
extern const double ORDER;        // of the estimate, plus one
extern const double A[];          // (s, s), 0 on and above the diagonal
extern const double B[], C[];     // (s), (s)
extern const double E[];          // (ESTIMATES, s + 1)
extern const double A_EXTRA[];    // (e, s + 1 + e)
extern const double C_EXTRA[];    // (e)
extern const double DENSE[];      // (s + 1, 4) polynomials of DP5's weights, or (4, s + 1 + e) of DOP853's higher terms

// Programs, for all lanes. Inputs are read before an output is written, so an output may be an input.
void rates(const V *t, const V *s, const V *p, V *s_dot, V *wrench);
void project(const V *s, V *onto, V *drift);  // onto the manifold; the drift (3) before
void onto(const V *s, V *onto);               // the same without the drift
void margin(const V *t, const V *s, const V *p, V *margin);  // > 0 where the law is defined
void gauges(const V *t, const V *s, const V *s_dot, V *gauges, V *first, V *second, V *tolerances);
void values(const V *t, const V *s, const V *s_dot, V *gauges);
void forces(const V *wrench, V *square_and_peak);  // mean square and maximum of the rotor forces
}
