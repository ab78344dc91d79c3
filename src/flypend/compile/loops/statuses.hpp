// How a flight ends, as in `flypend.compile.llvm.runge_kutta`.
#pragma once

enum { COMPLETED, DIVERGED, SINGULAR, UNDEFINED, TOO_SMALL, TOO_MANY, COLLIDED };
