"""A vehicle as URDF, for ROS, Drake, Isaac and PyBullet, and as SDF, for Gazebo: the same links on a ball joint."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from xml.etree.ElementTree import Comment, Element, SubElement, indent, tostring

import numpy as np

from flypend.model.mjcf import drawn_thickness, numbers, rod_moments

# The ring between the two axes of the joint: engines want a mass in every link that moves. As a share of the rod's
# mass and of its moment of inertia, it moves the rod by as much less.
RING = 1e-6
VERSION = "1.8"  # Gazebo from Edifice on, and Drake; frames attached to links are of 1.7


def model_urdf(vehicle: Any) -> str:
    """Return `vehicle` as URDF; see `Vehicle.to_urdf`."""
    name, comment = about(vehicle)
    robot = Element("robot", name=name)
    robot.append(comment)
    add_vehicle(robot, vehicle)
    thin = drawn_thickness(vehicle)
    for k, place in enumerate(vehicle.rotors_from_pivot):
        rotor = SubElement(robot, "link", name=f"rotor{k}")
        _drawn(rotor, "cylinder", (0, 0, 0), radius=repr(20 * thin), length=repr(2 * thin))
        _joint(robot, f"arm{k}", "fixed", ("vehicle", rotor.get("name")), place)
    ring = RING * (vehicle.rod_inertia + vehicle.bob_mass * vehicle.rod_length**2)
    _link(robot, "ring", RING * vehicle.bob_mass, (0, 0, 0), ring * np.eye(3))
    add_rod(robot, vehicle)
    _joint(robot, "pivot_x", "continuous", ("vehicle", "ring"), axis=(1, 0, 0))
    _joint(robot, "pivot_y", "continuous", ("ring", "bob"), axis=(0, 1, 0))
    indent(robot)
    return '<?xml version="1.0"?>\n' + tostring(robot, encoding="unicode") + "\n"


def about(vehicle: Any) -> tuple[str, Any]:
    """Return the name of the model, and an XML comment with what these formats have no word for."""
    low, high = vehicle.rotor_limits
    spins = " ".join(f"{spin:+g}" for spin in vehicle.rotor_spins)
    force, torque = f"pushes along its z with {low:.9g} to {high:.9g} N", f"{vehicle.drag_ratio:.9g} m times that"
    rest = f"time constant {vehicle.rotor_lag:.9g} s; mount: {vehicle.mount}"
    comment = Comment(f" rotor k {force} and turns the vehicle by {torque}, of sign {spins}; {rest} ")
    return "".join(c if c.isalnum() else "_" for c in vehicle.name), comment


def add_vehicle(robot: Element, vehicle: Any) -> Element:
    """Add the link "vehicle" to `robot`, with its origin in the pivot."""
    link = _link(robot, "vehicle", vehicle.mass, 0.0 - vehicle.pivot_offset, vehicle.inertia)
    _drawn(link, "box", 0.0 - vehicle.pivot_offset, size=numbers([4 * drawn_thickness(vehicle)] * 3))
    return link


def add_rod(robot: Element, vehicle: Any) -> Element:
    """Add the link "bob" to `robot`: the rod with its bob, from the pivot along z."""
    (across, along), length, thin = rod_moments(vehicle), vehicle.rod_length, drawn_thickness(vehicle)
    link = _link(robot, "bob", vehicle.bob_mass, (0, 0, length), np.diag([across, across, along]))
    _drawn(link, "cylinder", (0, 0, length / 2), radius=repr(thin), length=repr(length))
    _drawn(link, "sphere", (0, 0, length), radius=repr(4 * thin))
    return link


def _link(robot: Element, name: str, mass: float, center: Any, inertia: Any) -> Element:
    """Add a link to `robot` with its `mass` (kg), `center` (3,) and `inertia` (3, 3) about it, link frame."""
    link = SubElement(robot, "link", name=name)
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "origin", xyz=numbers(center))
    SubElement(inertial, "mass", value=repr(float(mass)))
    I = np.asarray(inertia, dtype=float)
    places = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    SubElement(inertial, "inertia", {name: repr(float(I[place])) for name, place in places.items()})
    return link


def _drawn(link: Element, shape: str, center: Any, **size: str) -> None:
    visual = SubElement(link, "visual")
    SubElement(visual, "origin", xyz=numbers(center))
    SubElement(SubElement(visual, "geometry"), shape, size)


def _joint(
    robot: Element, name: str, kind: str, links: Sequence[Any], place: Any = (0, 0, 0), axis: Any = None
) -> None:
    """Add a joint of this `kind` between two `links`, the parent first, at a `place` (3,), m, about an `axis` (3,)."""
    joint = SubElement(robot, "joint", name=name, type=kind)
    for role, link in zip(("parent", "child"), links, strict=True):
        SubElement(joint, role, link=link)
    SubElement(joint, "origin", xyz=numbers(place))
    if axis is not None:
        SubElement(joint, "axis", xyz=numbers(axis))


def model_sdf(vehicle: Any) -> str:
    """Return `vehicle` as SDF; see `Vehicle.to_sdf`."""
    name, comment = about(vehicle)
    sdf = Element("sdf", version=VERSION)
    model = SubElement(sdf, "model", name=name)
    model.append(comment)
    for link in (add_vehicle(model, vehicle), add_rod(model, vehicle)):
        _in_elements(link)
        for k, visual in enumerate(link.iter("visual")):
            visual.set("name", f"visual{k}")
    for k, place in enumerate(vehicle.rotors_from_pivot):
        rotor = SubElement(model, "frame", name=f"rotor{k}", attached_to="vehicle")
        SubElement(rotor, "pose").text = f"{numbers(place)} 0 0 0"
    pivot = SubElement(model, "joint", name="pivot", type="ball")
    SubElement(pivot, "parent").text, SubElement(pivot, "child").text = "vehicle", "bob"
    indent(sdf)
    return '<?xml version="1.0"?>\n' + tostring(sdf, encoding="unicode") + "\n"


def _in_elements(link: Element) -> None:
    """Turn what URDF says in attributes below `link` into SDF's elements, and origins into poses."""
    for part in [*link.iter()][1:]:
        values, part.attrib = part.attrib, {}
        if part.tag == "origin":
            part.tag, part.text = "pose", f"{values['xyz']} 0 0 0"
        elif "value" in values:
            part.text = values["value"]
        else:
            for name, value in values.items():
                SubElement(part, name).text = value
