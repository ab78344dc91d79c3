// The kernel of sampled flights: measure, command, hold; one flight per lane.
//
// All flights of a call share the control ticks, so the lanes run in lockstep. The result of a flight does not depend on
// its neighbours. `flypend.flight.sampled` does the same in Python, one flight at a time.
#include "board.hpp"
#include "contact.hpp"
#include "mujoco.hpp"
#include "random.hpp"
#include "recording.hpp"
#include "statuses.hpp"

// Which lanes are in flight, and how and when the flights of the others have ended.
struct Flights {
    M flying;
    V status, end;

    // Those that complete end at the time `last`.
    INLINE void begin(V last) {
        flying = every();
        status = all(COMPLETED);
        end = last;
    }

    INLINE void finish(M where, T how, V time) {
        where &= flying;
        status = where ? all(how) : status;
        end = where ? time : end;
        flying &= ~where;
    }
};

// Whether an entry exceeds the limit or is NaN.
static INLINE M lost(const V *state) {
    M out = none();
    for (int64_t i = 0; i < STATE; i++) out |= ~(size(state[i]) < T(MOST_STATE));
    return out;
}

// Where in the memory that one piece of a flight leaves to the next its parts begin, in vectors.
struct Layout {
    int64_t states, board, ring, gust, sensed, reductions, flights, contact, end = 0;

    INLINE int64_t take(int64_t length) {
        end += length;
        return end - length;
    }

    INLINE Layout() {
        states = take(2 * (1 + STATE + ROTORS));
        board = take(Board::memory_length());
        ring = take(DEPTH * COMMAND);
        gust = take(GUST);
        sensed = take(SENSED);
        reductions = take(Reductions::length());
        flights = take(sizeof(Flights) / sizeof(V));
        contact = take(sizeof(Contact) / sizeof(V));
    }
};

// Bytes of the argument `context` of a flight in pieces.
extern "C" void context_size(int64_t *bytes) { *bytes = Layout().end * int64_t(sizeof(V)); }

// Fly `runs` runs for `ticks` ticks. The arrays are those of `flypend.flight.kernels.sampled`; `plant` holds the numbers
// that all runs share. Returns soon after `stop` is no longer zero.
//
// A flight in pieces is of one group of runs, of which `begun` ticks are flown already. It goes on from its `context`,
// after `impulses` (runs, 6) on vehicle and bob, N s; `sample_ticks` are those of the piece.
extern "C" void kernel(
    const double *starts, const double *parameters, const double *plant, const int64_t *seeds, int64_t runs,
    int64_t ticks, const int64_t *sample_ticks, int64_t sample_count, const int64_t *judged, const int64_t *rows,
    int64_t row_count, double *samples, double *reductions, double *final, double *end, int64_t *status,
    double *clearance, int64_t *part, const int64_t *stop, V *context, int64_t begun, const double *impulses,
    const MujocoMemory *mujoco) {
    const int64_t length = STATE + ROTORS, scheduled = PIECES ? 2 * STRETCHES : 0;
    const Layout at;
    V own[PIECES ? 1 : at.end], *kept = PIECES ? context : own;
    V *states = kept + at.states, *gust = kept + at.gust, *sensed = kept + at.sensed;
    const Board computer{kept + at.board, kept + at.ring};
    const Reductions results(kept + at.reductions);
    Flights own_flights, &flights = PIECES ? *(Flights *)(kept + at.flights) : own_flights;
    Contact own_contact, &contact = PIECES ? *(Contact *)(kept + at.contact) : own_contact;

    V gains[some(GAINS)], measured[1 + MEASURED], wind[6] = {}, draws[some(DRAWS)], values[some(VALUES)];
    V start_draws[some(START_DRAWS)], estimate[STATE];
    V forces[ROTORS], controls[ROTORS], lags[ROTORS];
    V given[some(scheduled + STRETCHES * TIMING + NOISE + WIND + PARAMS)];
    const V *schedule = given, *timings = schedule + scheduled, *noise = timings + STRETCHES * TIMING;
    const V *blowing = noise + NOISE, *params = blowing + WIND;
    for (int64_t i = 0; i < scheduled + STRETCHES * TIMING + NOISE + WIND + PARAMS; i++) given[i] = all(T(plant[i]));
    for (int64_t i = 0; i < DRAWS; i++) draws[i] = V{};

    Mujoco engine{mujoco, forces, controls, lags, false};
    Ticks recorded{sample_ticks, sample_count, judged, rows, row_count, samples, 0};
    const V last = all(T(ticks) * T(PERIOD));
    U seed;
    int64_t first;  // run of the group

    auto run = [&](int64_t lane) WITHIN { return first + lane < runs ? first + lane : runs - 1; };  // the last fills up
    auto state_at = [&](int64_t tick) WITHIN { return states + (tick & 1) * (1 + length) + 1; };  // after the time
    auto time_at = [&](int64_t tick) WITHIN { return all(T(tick) * T(PERIOD)); };

    // The samples of `tick`. Flights that have just `ended` early are judged at their last state, which is that of `end`.
    auto sample = [&](int64_t tick, V *state, M ended, V end) WITHIN {
        bool due = recorded.due(tick);
        M here = ended | (due && recorded.judge_now() ? flights.flying : none());
        if (any(here)) results.add(here, ended ? end : time_at(tick), state, gains, values);
        if (due) recorded.pass(state, length, first, runs);
    };

    auto begin = [&]() WITHIN {
        V *state = state_at(0);
        for (int64_t lane = 0; lane < W; lane++) from_row(starts + run(lane) * length, state, lane, length);
        if (SENSES) {
            normals(seed, U{} + uint64_t(START_TICK), 0, START_DRAWS, start_draws);
            sense_estimate(state, start_draws, estimate);
            sense_begin(state, start_draws, sensed);
        }
        computer.begin(state + STATE, estimate);
        for (int64_t i = 0; i < GUST; i++) gust[i] = V{};
        if (GUST && RANDOM) {
            normals(seed, U{} + uint64_t(GUST_TICK), FIRST_DRAW, END_DRAW, draws);
            copy(draws + GUSTS, gust, GUST_DRAWS);
        }
        for (int64_t i = 0; i < 6; i++) wind[i] = V{};
        if (W == 1 && MUJOCO) engine.begin(first, state);
        results.begin();
        flights.begin(last);
        if (TOUCHES) flights.finish(contact.start(every(), state), COLLIDED, V{});
        sample(0, state, ~flights.flying, V{});
    };

    // Go on from the context: what flies ends later now, and is struck.
    auto resume = [&]() WITHIN {
        flights.end = flights.flying ? last : flights.end;
        V blow[6];
        for (int64_t lane = 0; lane < W; lane++) from_row(impulses + run(lane) * 6, blow, lane, 6);
        if (any(flights.flying)) strike(state_at(begun), blow, state_at(begun));
    };

    // What the flight computer is told of the `state`: the time, and the state itself, measurements or readings.
    auto told = [&](V time, V *state) WITHIN {
        V *result = MEASURES || SENSES ? measured : state - 1;
        if (MEASURES) measure(state, draws, noise, measured + 1);
        if (SENSES) sense(sensed, &time, state, draws, noise, sensed, measured + 1);
        *result = time;
        return result;
    };

    // From `state` to `after`, through the stretches of `tick`.
    auto advance = [&](int64_t tick, const V *state, V *after) WITHIN {
        if (PIECES) copy(state, after, length), state = after;  // all stretches may be empty
        for (int64_t stretch = 0; stretch < STRETCHES; stretch++) {
            int64_t age = int64_t(PIECES ? schedule[2 * stretch][0] : AGES[stretch]);
            int64_t steps = int64_t(PIECES ? schedule[2 * stretch + 1][0] : STEPS[stretch]);
            const V *command = computer.held(tick, age), *timing = timings + stretch * TIMING;
            if (W == 1 && MUJOCO) engine.advance(stretch, steps, command, wind, timing);
            for (int64_t i = 0; i < steps && !MUJOCO; i++) {
                const V *wanted = command;
                if (RATES) rate_loop(command, state + OMEGA, nullptr, forces), wanted = forces;
                world(state, state + STATE, wanted, wind, timing, after, after + STATE);
                state = after;
            }
        }
        if (W == 1 && MUJOCO) engine.show(after);
    };

    auto fly = [&](int64_t tick, V *state, V *after) WITHIN {
        const V time = time_at(tick);
        if (RANDOM) normals(seed, U{} + uint64_t(tick), FIRST_DRAW, END_DRAW, draws);
        const V *command = computer.command(tick, told(time, state), gains, params);
        flights.finish(undefined(command, COMMAND), UNDEFINED, time);
        if (GUST) gusts(gust, draws + GUSTS, blowing, gust, wind);
        advance(tick, state, after);
        if (any(far(after, STATE, T(MOST_STATE)))) flights.finish(lost(after), DIVERGED, time);
        if (TOUCHES) {
            V share;
            M touched = contact.look(flights.flying, state, after, all(T(PERIOD)), share);
            flights.finish(touched, COLLIDED, time + share * T(PERIOD));
        }
        if (any(~flights.flying))
            for (int64_t i = 0; i < length; i++) after[i] = flights.flying ? after[i] : state[i];
    };

    auto store = [&](int64_t lane, int64_t row) WITHIN {
        into_row(state_at(ticks), lane, final + row * STATE, STATE);
        end[row] = flights.end[lane];
        status[row] = int64_t(flights.status[lane]);
        results.store(lane, reductions + row * VALUES);
        if (TOUCHES) contact.store(lane, clearance[row], part[row]);
    };

    for (first = 0; first < (PIECES ? 1 : runs); first += W) {
        for (int64_t lane = 0; lane < W; lane++) {
            from_row(parameters + run(lane) * GAINS, gains, lane, GAINS);
            seed[lane] = uint64_t(seeds[run(lane)]);
        }
        recorded.cursor = 0;
        if (!PIECES || begun == 0) begin();
        if (PIECES) resume();
        V *state = state_at(begun), *after = state_at(begun + 1);
        for (int64_t tick = begun; tick < ticks && any(flights.flying); tick++) {
            if (__atomic_load_n(stop, __ATOMIC_RELAXED)) break;
            M flying = flights.flying;
            fly(tick, state, after);
            sample(tick + 1, after, flying & ~flights.flying, time_at(tick));
            V *before = state;
            state = after, after = before;
        }
        for (int64_t lane = 0; lane < W && first + lane < runs; lane++) store(lane, first + lane);
    }
}
