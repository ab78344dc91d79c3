/* The law flies on the estimates of track_pose and track_rod. */
static flypend_board computer;

static flypend_status begin_computer(const sensorData_t *sensors, const flypend_rotors *rotors)
{
    (void)sensors;
    return flypend_board_restart(&computer, &flypend_default_gains, &params, rotors);
}

static flypend_status step_computer(const sensorData_t *sensors, const flypend_path *path, flypend_rotors *rotors)
{
    static flypend_measurement now;
    read_state(sensors, &now);
    return flypend_board_step(&computer, &now, path, &params, rotors);
}
