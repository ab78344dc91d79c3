"""The flight computer: what runs once per control period between sensors and rotors."""
