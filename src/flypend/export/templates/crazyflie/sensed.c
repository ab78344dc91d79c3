/* The law flies on an estimator of its own, which begins at the estimates of track_pose and track_rod. */
static flypend_sensors computer;
static flypend_readings readings; /* since the last step of the law; an age below 0 says that nothing was */
static float felt_sum[3];     /* g, accelerations since then, */
static int felt_count;        /* and how many */

static void forget_told(void)
{
    readings.position_age = readings.attitude_age = readings.rod_age = readings.gyro_age = readings.accelerometer_age = -1;
    memset(felt_sum, 0, sizeof felt_sum);
    felt_count = 0;
}

/* Once a step, before what is new is told. */
static void tell_imu(const sensorData_t *sensors)
{
    float *const ages[] = {&readings.position_age, &readings.attitude_age, &readings.rod_age};
    for (int i = 0; i < 3; i++) {
        *ages[i] += (*ages[i] < 0) ? 0 : 0.001f;
    }
    felt_sum[0] += sensors->acc.x;
    felt_sum[1] += sensors->acc.y;
    felt_sum[2] += sensors->acc.z;
    felt_count++;
}

static void tell_pose(const float *position, const float *attitude, float age)
{
    if (age >= 0) {
        memcpy(readings.position, position, sizeof readings.position);
        memcpy(readings.attitude, attitude, sizeof readings.attitude);
        readings.position_age = readings.attitude_age = age;
    }
}

static void tell_rod(const float *from_pivot, float age)
{
    static const float zero[3];
    float rate[3];
    if (age >= 0) {
        flypend_rod(zero, zero, from_pivot, zero, readings.rod, rate);
        readings.rod_age = age;
    }
}

static flypend_status begin_computer(const sensorData_t *sensors, const flypend_rotors *rotors)
{
    static flypend_state now;
    read_state(sensors, &now);
    forget_told();
    return flypend_sensors_restart(&computer, &flypend_default_gains, &params, &now, rotors);
}

static flypend_status step_computer(const sensorData_t *sensors, const flypend_path *path, flypend_rotors *rotors)
{
    readings.gyro[0] = flypend_radians(sensors->gyro.x);
    readings.gyro[1] = flypend_radians(sensors->gyro.y);
    readings.gyro[2] = flypend_radians(sensors->gyro.z);
    readings.gyro_age = 0;
    for (int i = 0; (i < 3) && (felt_count > 0); i++) {
        readings.accelerometer[i] = GRAVITY * felt_sum[i] / (float)felt_count;
        readings.accelerometer_age = 0;
    }
    const flypend_status found = flypend_sensors_step(&computer, &readings, path, &params, rotors);
    forget_told();
    return found;
}
