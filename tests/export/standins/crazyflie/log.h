/* Stand-in: a group of logged variables is a table that ends with an entry without a name. */
#ifndef STANDIN_LOG_H
#define STANDIN_LOG_H

#define LOG_UINT8 1

typedef struct {
    int type;
    const char *name;
    const void *address;
} standin_log;

#define LOG_GROUP_START(NAME) const standin_log standin_log_##NAME[] = {
#define LOG_ADD(TYPE, NAME, ADDRESS) {TYPE, #NAME, ADDRESS},
#define LOG_GROUP_STOP(NAME) {0, 0, 0}};
#endif
