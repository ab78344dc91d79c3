/* Groups of parameters and logs announce themselves, in place of sections of the firmware's linker script. */
#ifndef HOST_GROUPS_H
#define HOST_GROUPS_H
#include "log.h"
#include "param.h"

void host_group(const void *rows, int is_parameter);

#undef PARAM_GROUP_START
#undef PARAM_GROUP_STOP
#undef LOG_GROUP_START
#undef LOG_GROUP_STOP
#define HOST_JOIN_(A, B) A##B
#define HOST_JOIN(A, B) HOST_JOIN_(A, B)
#define HOST_ANNOUNCE(ROWS, IS_PARAMETER) \
    __attribute__((constructor)) static void HOST_JOIN(host_announce_, __COUNTER__)(void) { host_group(ROWS, IS_PARAMETER); }
#define PARAM_GROUP_START(NAME) \
    static struct param_s __params_##NAME[]; \
    HOST_ANNOUNCE(__params_##NAME, 1) \
    static struct param_s __params_##NAME[] = {PARAM_ADD_GROUP(PARAM_GROUP | PARAM_START, NAME, 0x0)
#define PARAM_GROUP_STOP(NAME) PARAM_ADD_GROUP(PARAM_GROUP | PARAM_STOP, stop_##NAME, 0x0)};
#define LOG_GROUP_START(NAME) \
    static const struct log_s __logs_##NAME[]; \
    HOST_ANNOUNCE(__logs_##NAME, 0) \
    static const struct log_s __logs_##NAME[] = {LOG_ADD_GROUP(LOG_GROUP | LOG_START, NAME, 0x0)
#define LOG_GROUP_STOP(NAME) LOG_ADD_GROUP(LOG_GROUP | LOG_STOP, stop_##NAME, 0x0)};
#endif
