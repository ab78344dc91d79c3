
/* A swing-up follows a plan, as long as rod and pivot are near it; then, and from elsewhere, the law flies. The plan
 * begins level, heading along x: begun 10 degrees from there, it stays within centimetres; from 15 on it may fall. */
#define PLANNED_TRACE 2.9696f /* 1 + 2 cos 10 deg, of the attitude */
static bool follows_plan;
static float planned_time; /* s */

static flypend_status begin_planned(const sensorData_t *sensors, const flypend_rotors *rotors)
{
    const float *R = pose + POSE_R;
    follows_plan = R[0] + R[4] + R[8] > PLANNED_TRACE;
    planned_time = 0;
    return begin_computer(sensors, rotors);
}

static flypend_status step_planned(const sensorData_t *sensors, const flypend_path *path, flypend_rotors *rotors)
{
    static flypend_measurement now;
    static float here[24];
    if (follows_plan) {
        read_state(sensors, &now);
        memcpy(here, &now, sizeof here);
        for (int i = 0; i < 3; i++) {
            here[i] -= path->x0[i];
            here[3 + i] -= path->x1[i];
        }
        follows_plan = (planned_time < FLYPEND_PLAN_DURATION)
            && (flypend_plan_command(planned_time, here, spinning, rotors->force) == 0);
        if (follows_plan) {
            planned_time += $period;
            return FLYPEND_OK;
        }
        memcpy(rotors->force, spinning, sizeof rotors->force);
        (void)begin_computer(sensors, rotors);
    }
    return step_computer(sensors, path, rotors);
}
