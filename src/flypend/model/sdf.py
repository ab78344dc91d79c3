"""A vehicle as SDF, the description of Gazebo, which Drake reads too: the links of the URDF on a ball joint."""

from __future__ import annotations

from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from flypend.model.mjcf import numbers
from flypend.model.urdf import about, add_rod, add_vehicle

VERSION = "1.8"  # Gazebo from Edifice on, and Drake; frames attached to links are of 1.7


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
