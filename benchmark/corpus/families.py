"""The families of parts. Whole families are held out for tests, from simple to complex:

  wedge, spacer, cam, cable_clip              simple
  hinge, motor_mount, knob                    middling
  pillow_block, terminal_block, manifold      complex

Their numbers in the corpus follow the order of this list: new families go to its end.
"""
import bars
import drives
import electrical
import fasteners
import housings
import machined
import pipework
import plates
import turned_parts

TEST = ("wedge", "spacer", "cam", "cable_clip", "hinge", "motor_mount", "knob", "pillow_block", "terminal_block",
        "manifold")

FAMILIES = {
    family.__name__: family
    for family in (plates.plate, plates.l_bracket, plates.u_bracket, plates.z_bracket, plates.t_bracket, plates.gusset,
                   plates.hinge, plates.motor_mount, bars.wedge, bars.extrusion, bars.heat_sink, bars.v_block,
                   bars.rack, bars.carriage, turned_parts.flange, turned_parts.shaft, turned_parts.spacer,
                   turned_parts.bottle, turned_parts.knob, turned_parts.thumb_nut, turned_parts.cap, drives.pulley,
                   drives.gear, drives.splined_shaft, drives.cam, drives.coupling, drives.impeller, fasteners.bolt,
                   fasteners.screw, fasteners.nut, fasteners.stud, fasteners.wrench, pipework.elbow, pipework.tee,
                   pipework.valve_body, pipework.manifold, machined.pillow_block, machined.clevis, machined.lever,
                   machined.crank, machined.handle, machined.casting, housings.open_box, housings.ribbed_housing,
                   housings.brick, housings.cable_clip, housings.battery_holder, electrical.connector,
                   electrical.terminal_block, electrical.plug, electrical.socket, bars.cuboid)
}


def split_of(family):
    return "test" if family in TEST else "train"
