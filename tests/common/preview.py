"""Reads programs as LinuxCNC's screens do when a file is loaded: by its module `gcode`, in which each probing move ends at its target.

`preview.py LINUXCNC PROGRAM ...`: LINUXCNC is the folder of the unpacked package. Prints a line a program: `ok`, or why it is refused.
"""

import sys

root, *programs = sys.argv[1:]
sys.path.insert(0, f"{root}/usr/lib/python3/dist-packages")

import gcode  # noqa: E402


class Canon:
    """A drawing that draws nothing: what the module asks for, and everything else is accepted."""

    def __init__(self, parameters):
        self.parameter_file = parameters

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 7

    def get_block_delete(self):
        return False

    def check_abort(self):
        return False

    def get_tool(self, _pocket):
        return (-1,) + (0.0,) * 12 + (0,)

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *_arguments, **_named: None


for program in programs:
    parameters = f"{program}.var"
    open(parameters, "w").close()
    result, line = gcode.parse(program, Canon(parameters), "", "")
    print("ok" if result <= gcode.MIN_ERROR else f"line {line}: {gcode.strerror(result)}")
