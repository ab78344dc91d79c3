// Stand-in for what the module uses of PX4's platform: time, parameters, topics, modules.
#pragma once
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#ifndef BARE // the cross compiler has no library for C++
#include <map>
#include <string>
#endif

#define MODULE_NAME "flypend"
#define __EXPORT
#define PX4_ERR(...) standin::said(__VA_ARGS__)
#define PX4_WARN(...) standin::said(__VA_ARGS__)
#define PX4_INFO(...) standin::said(__VA_ARGS__)
#define PRINT_MODULE_DESCRIPTION(text)
#define PRINT_MODULE_USAGE_NAME(name, kind)
#define PRINT_MODULE_USAGE_COMMAND(name)
#define PRINT_MODULE_USAGE_DEFAULT_COMMANDS()
enum { PX4_OK = 0, PX4_ERROR = -1 };
enum perf_counter_type { PC_ELAPSED };
using perf_counter_t = void *;
inline perf_counter_t perf_alloc(perf_counter_type, const char *) { return nullptr; }
inline void perf_free(perf_counter_t) {}
inline void perf_begin(perf_counter_t) {}
inline void perf_end(perf_counter_t) {}
inline void perf_print_counter(perf_counter_t) {}

using hrt_abstime = uint64_t;
namespace time_literals
{
constexpr hrt_abstime operator""_ms(unsigned long long time) { return 1000 * time; }
}

namespace standin
{
struct field {
    const char *topic, *name;
    char kind;
    size_t at, count;
};
struct topic {
    const char *name;
    void *data;
    size_t size;
    unsigned generation;
};
extern hrt_abstime time;
#ifndef BARE
extern std::map<std::string, double> parameters;
#endif
template <typename... A> void said(const char *, A...) {}
} // namespace standin

inline hrt_abstime hrt_absolute_time() { return standin::time; }

using param_t = const char *;
#ifdef BARE
param_t param_find(const char *name);
int param_get(param_t name, void *to);
#else
inline param_t param_find(const char *name)
{
    const auto found = standin::parameters.find(name);
    return (found == standin::parameters.end()) ? nullptr : found->first.c_str();
}
template <typename T> int param_get(param_t name, T *to)
{
    if (name == nullptr) {
        return PX4_ERROR;
    }
    *to = static_cast<T>(standin::parameters.at(name));
    return PX4_OK;
}
#endif

template <const char *const &NAME> class ParamFloat
{
public:
    float get() const { return _value; }
    void update() { param_get(param_find(NAME), &_value); }

private:
    float _value{0};
};

class ModuleParams
{
public:
    explicit ModuleParams(ModuleParams *) {}
    virtual ~ModuleParams() = default;

protected:
    virtual void updateParams() {}
};
// (type) name, for each of six.
#define TYPED(...) __VA_ARGS__
#define UNTYPED(...)
#define DECLARED(x) TYPED x;
#define UPDATED(x) UNTYPED x.update();
#define DEFINE_PARAMETERS(a, b, c, d, e, f)                                                                            \
    DECLARED(a) DECLARED(b) DECLARED(c) DECLARED(d) DECLARED(e) DECLARED(f)                                            \
    void updateParams() override { UPDATED(a) UPDATED(b) UPDATED(c) UPDATED(d) UPDATED(e) UPDATED(f) }

template <class T> class ModuleBase
{
public:
    virtual ~ModuleBase() = default;
    virtual int print_status() = 0;
    static int main(int argc, char *argv[]) { return T::task_spawn(argc, argv); }
    struct holder {
        T *object;
        void store(T *next) { object = next; }
    };
    static holder _object;
    static int _task_id;
    static bool stopping;

protected:
    static constexpr int task_id_is_work_queue = -2;
    static bool should_exit() { return stopping; }
    static void exit_and_cleanup()
    {
        delete _object.object;
        _object.object = nullptr;
    }
};
template <class T> typename ModuleBase<T>::holder ModuleBase<T>::_object;
template <class T> int ModuleBase<T>::_task_id;
template <class T> bool ModuleBase<T>::stopping;

namespace px4
{
struct wq_config_t {
    const char *name;
    uint16_t stacksize;
    int8_t relative_priority;
};
class ScheduledWorkItem
{
public:
    ScheduledWorkItem(const char *, const wq_config_t &) {}
    virtual ~ScheduledWorkItem() = default;
    virtual void Run() = 0;
    void ScheduleDelayed(uint32_t) {}
    void ScheduleClear() {}
};
} // namespace px4

#define ORB_ID(name) (&standin::orb_##name)
namespace uORB
{
class Subscription
{
public:
    explicit Subscription(const standin::topic *from) : _from(from) {}
    bool updated() const { return _from->generation != _seen; }
    bool update(void *to) { return updated() && copy(to); }
    bool copy(void *to)
    {
        _seen = _from->generation;
        if (_seen != 0) {
            memcpy(to, _from->data, _from->size);
        }
        return _seen != 0;
    }

private:
    const standin::topic *_from;
    unsigned _seen{0};
};
class SubscriptionCallbackWorkItem : public Subscription
{
public:
    SubscriptionCallbackWorkItem(px4::ScheduledWorkItem *, const standin::topic *from) : Subscription(from) {}
    bool registerCallback() { return true; }
    void unregisterCallback() {}
};
template <typename T> class Publication
{
public:
    explicit Publication(standin::topic *to) : _to(to) {}
    bool publish(const T &message)
    {
        memcpy(_to->data, &message, sizeof message);
        _to->generation++;
        return true;
    }

private:
    standin::topic *_to;
};
} // namespace uORB
