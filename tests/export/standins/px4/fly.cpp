// Lets Python put messages, run the module, and read what it publishes.
#include "flypend.hpp"

namespace standin
{
hrt_abstime time = 0;
std::map<std::string, double> parameters;

static const field *find(const char *topic_name, const char *name)
{
    for (const field &row : fields) {
        if (!strcmp(row.topic, topic_name) && !strcmp(row.name, name)) {
            return &row;
        }
    }
    return nullptr;
}

static topic *find(const char *name)
{
    for (topic *known : topics) {
        if (!strcmp(known->name, name)) {
            return known;
        }
    }
    return nullptr;
}

template <typename T> static void transfer(char *at, double *value, bool put)
{
    T held;
    memcpy(&held, at, sizeof held);
    if (put) {
        held = static_cast<T>(*value);
        memcpy(at, &held, sizeof held);
    } else {
        *value = static_cast<double>(held);
    }
}

static bool access(const char *topic_name, const char *name, size_t i, double *value, bool put)
{
    const field *row = find(topic_name, name);
    const topic *of = find(topic_name);
    if ((row == nullptr) || (of == nullptr) || (i >= row->count)) {
        return false;
    }
    char *base = static_cast<char *>(of->data) + row->at;
    switch (row->kind) {
    case 'd': transfer<double>(base + 8 * i, value, put); break;
    case 'f': transfer<float>(base + 4 * i, value, put); break;
    case 'Q': transfer<uint64_t>(base + 8 * i, value, put); break;
    case 'I': transfer<uint32_t>(base + 4 * i, value, put); break;
    case 'H': transfer<uint16_t>(base + 2 * i, value, put); break;
    case 'b': transfer<int8_t>(base + i, value, put); break;
    default: transfer<uint8_t>(base + i, value, put); break;
    }
    return true;
}
} // namespace standin

extern "C" {
int flypend_main(int argc, char *argv[]);

void standin_parameter(const char *name, double value) { standin::parameters[name] = value; }
bool standin_put(const char *topic, const char *name, size_t i, double value)
{
    return standin::access(topic, name, i, &value, true);
}
double standin_get(const char *topic, const char *name, size_t i)
{
    double value = -12345;
    standin::access(topic, name, i, &value, false);
    return value;
}
void standin_publish(const char *topic) { standin::find(topic)->generation++; }
unsigned standin_count(const char *topic) { return standin::find(topic)->generation; }
void standin_reset(void)
{
    delete Flypend::_object.object;
    Flypend::_object.object = nullptr;
    Flypend::stopping = false;
    standin::time = 1000000;
    for (standin::topic *known : standin::topics) {
        known->generation = 0;
        memset(known->data, 0, known->size);
    }
}
int standin_start(void) { return flypend_main(0, nullptr); }
void standin_run(uint64_t time)
{
    standin::time = time;
    if (Flypend::_object.object != nullptr) {
        static_cast<px4::ScheduledWorkItem *>(Flypend::_object.object)->Run();
    }
}
void standin_stop(void) { Flypend::stopping = true; }
bool standin_lives(void) { return Flypend::_object.object != nullptr; }
}
