"""The firmware of a Crazyflie in the loop: its stabilizer, compiled for this machine, flies the app on our plant."""
