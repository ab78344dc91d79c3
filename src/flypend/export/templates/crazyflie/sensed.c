/* The law flies on an estimator of its own, which begins at the estimates of track_pose and track_rod. */
static flypend_sensors computer;
static flypend_readings told; /* since the last step of the law; an age below 0 says that nothing was */
static float felt_sum[3];     /* g, accelerations since then, */
static int felt_count;        /* and how many */

static void forget_told(void)
{
    told.position_age = told.attitude_age = told.rod_age = told.gyro_age = told.accelerometer_age = -1;
    memset(felt_sum, 0, sizeof felt_sum);
    felt_count = 0;
}

/* Once a step, before what is new is told. */
static void tell_imu(const sensorData_t *sensors)
{
    float *const ages[] = {&told.position_age, &told.attitude_age, &told.rod_age};
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
        memcpy(told.position, position, sizeof told.position);
        memcpy(told.attitude, attitude, sizeof told.attitude);
        told.position_age = told.attitude_age = age;
    }
}

static void tell_rod(const float *from_pivot, float age)
{
    static const float zero[3];
    float rate[3];
    if (age >= 0) {
        flypend_rod(zero, zero, from_pivot, zero, told.rod, rate);
        told.rod_age = age;
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
    told.gyro[0] = flypend_radians(sensors->gyro.x);
    told.gyro[1] = flypend_radians(sensors->gyro.y);
    told.gyro[2] = flypend_radians(sensors->gyro.z);
    told.gyro_age = 0;
    for (int i = 0; (i < 3) && (felt_count > 0); i++) {
        told.accelerometer[i] = GRAVITY * felt_sum[i] / (float)felt_count;
        told.accelerometer_age = 0;
    }
    const flypend_status found = flypend_sensors_step(&computer, &told, path, &params, rotors);
    forget_told();
    return found;
}
