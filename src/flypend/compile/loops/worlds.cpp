// The kernel of environments: worlds in lanes, advanced by actions, observed, judged and begun again.
#include "worlds.hpp"

#include "contact.hpp"
#include "random.hpp"

// Neither the numbers of starts, which are those of the seeds themselves, nor those of another episode are drawn again.
constexpr uint64_t SEEDS_APART = uint64_t(1) << 62, EPISODES_APART = uint64_t(1) << 41;

static INLINE U whole(V number) { return (U)__builtin_convertvector(number, L); }

// Advance the groups of W worlds from number `first`, `count` of them, each by an action; with `fresh`, begin them
// instead. A world that has taken `limit` actions is cut off.
//
// memories       (groups, 2 + MEMORY): actions since the beginning, number of the episode, memory
// seeds          (groups)
// actions, observations, rewards, terminated, truncated   one row per world
// last           (worlds, OBSERVED): the last observation of those that have ended; other rows are left alone
// ends           (worlds, STATE + ROTORS): their last state and rotor forces
// causes         (worlds): the part that has touched, or BY_TASK or LOST
extern "C" void kernel(
    V *memories, const L *seeds, const float *actions, float *observations, float *rewards, bool *terminated,
    bool *truncated, float *last, double *ends, double *causes, int64_t first, int64_t count, int64_t limit, int64_t fresh) {
    V action[ACTIONS], observed[OBSERVED], given[COMMAND], held[COMMAND], forces[ROTORS];
    V before[STATE + ROTORS + NUMBERS];
    V draws[UNIFORMS], begun[MEMORY], start_draws[some(START_DRAWS)], noise[some(DRAWS)];
    V *clock, *episode, *memory, *state, *rotors, touched, cause;
    U seed;
    int64_t world;  // the first of the group

    auto store = [&](auto *rows, V *vectors, int64_t length, M which) WITHIN {
        for (int64_t lane : Set(which)) into_row(vectors, lane, rows + (world + lane) * length, length);
    };
    auto flag = [&](bool *flags, M which) WITHIN { EACH_LANE flags[world + lane] = which[lane] != 0; };
    auto time = [&]() WITHIN { return *clock * T(double(STEPS) * LENGTH); };

    auto look = [&]() WITHIN {
        const V now = time();
        observe(&now, memory, observed);
        for (int64_t i = 0; i < OBSERVED; i++)  // of worlds that are lost, whatever they hold
            observed[i] = most(least(observed[i], all(T(BOUND))), all(T(-BOUND)));
    };

    // Sensors and estimator of an `episode`: the readings of `state` at `tick`, into the `estimate`.
    auto read = [&](U episode, U tick, V now, const V *state, V *estimate) WITHIN {
        normals(seed + SEEDS_APART, episode * EPISODES_APART + tick, 0, DRAWS, noise);
        sense(estimate, &now, state, noise, estimate);
    };

    // Begin anew in the lanes `over`.
    auto start = [&](M over) WITHIN {
        const U number = whole(*episode);
        uniforms(seed, number, UNIFORMS, draws);
        begin(draws, begun);
        if (SENSES) {
            normals(seed + SEEDS_APART, number * EPISODES_APART + uint64_t(START_TICK), 0, START_DRAWS, start_draws);
            first_estimate(begun, start_draws, begun + AT_ESTIMATE);
            read(number, U{}, V{}, begun, begun + AT_ESTIMATE);
        }
        for (int64_t i = 0; i < MEMORY; i++) replace(memory[i], over, begun[i]);
        *clock = over ? V{} : *clock;
        *episode = over ? *episode + 1 : *episode;
    };

    // The command that acts in this `step` of the action: the present one, or one of those in the queue, latest first.
    auto hold = [&](int64_t step) WITHIN {
        const V left = memory[AT_DELAY] - T(step);
        for (int64_t i = 0; i < COMMAND; i++) {
            V acting = given[i];
            for (int64_t age = 0; age < QUEUED; age++)
                acting = left > T(age * STEPS) ? memory[AT_QUEUE + age * COMMAND + i] : acting;
            held[i] = acting;
        }
    };

    // Take the steps of the action; returns which of the worlds that are not `lost` are so then, and which part of them
    // has `touched`.
    auto move = [&](M lost) WITHIN {
        V *queue = memory + AT_QUEUE, share;
        const V *wanted = RATES ? forces : held;
        command(action, given);
        if (TOUCHES) copy(memory + AT_NUMBERS, before + STATE + ROTORS, NUMBERS);
        for (int64_t i = 0; i < STEPS; i++) {
            hold(i);
            if (RATES) rate_loop(held, state + OMEGA, nullptr, forces);
            if (TOUCHES) copy(state, before, STATE + ROTORS);
            step(state, rotors, wanted, memory + AT_WIND, memory + AT_TIMING, memory + AT_NUMBERS, state, rotors);
            Contact contact{};  // distances above 0 are not looked for
            if (TOUCHES) {
                const M touch = contact.look(~lost, before, state, all(T(LENGTH)), share);
                touched = touch ? contact.part : touched;
                lost |= touch;
            }
        }
        for (int64_t age = QUEUED - 1; age > 0; age--)
            copy(queue + (age - 1) * COMMAND, queue + age * COMMAND, COMMAND);
        if (QUEUED) copy(given, queue, COMMAND);
        return lost;
    };

    // Take an action; returns which worlds are over.
    auto advance = [&]() WITHIN {
        for (int64_t lane = 0; lane < W; lane++) from_row(actions + (world + lane) * ACTIONS, action, lane, ACTIONS);
        M lost = undefined(action, ACTIONS);
        for (int64_t i = 0; i < ACTIONS; i++) action[i] = most(least(action[i], all(1)), all(-1));
        touched = all(T(LOST));
        lost = move(lost);
        *clock += 1;
        const V now = time();
        V reward, ended;
        judge(&now, memory, action, &reward, &ended);
        lost |= far(state, STATE + ROTORS, T(BOUND));
        const M done = (ended > 0) | lost, late = (*clock >= T(limit)) & ~done;
        cause = lost ? touched : all(T(BY_TASK));
        reward = lost & ~(size(reward) < INFINITE) ? V{} : reward;
        copy(action, memory + AT_ACTION, ACTIONS);
        if (SENSES) {
            carry(memory + AT_ESTIMATE, action, memory + AT_ESTIMATE);
            read(whole(*episode - 1), whole(*clock), now, state, memory + AT_ESTIMATE);
        }
        store(rewards, &reward, 1, every());
        flag(terminated, done);
        flag(truncated, late);
        look();
        return done | late;
    };

    for (int64_t group = first; group < first + count; group++) {
        world = group * W;
        clock = memories + group * (2 + MEMORY), episode = clock + 1, memory = clock + 2;
        state = memory, rotors = memory + STATE;
        seed = (U)seeds[group];
        if (fresh) *episode = V{};
        const M over = fresh ? every() : advance();
        if (any(over)) {
            if (!fresh) {
                store(last, observed, OBSERVED, over);
                store(ends, state, STATE + ROTORS, over);
                store(causes, &cause, 1, over);
            }
            start(over);
            look();
        }
        store(observations, observed, OBSERVED, every());
    }
}
