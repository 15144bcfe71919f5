"""Torques of an identified person from Python, without the module: with_ctypes.py RESULTS [LIBRARY]"""

import ctypes
import sys

Doubles = ctypes.POINTER(ctypes.c_double)


class Output(ctypes.Structure):  # as in myoid.h; a place that stays None is not computed
    _fields_ = [("size", ctypes.c_size_t)] + [
        (name, Doubles) for name in ("torque", "torque_low", "torque_high", "force", "force_low", "force_high")
    ]


myoid = ctypes.CDLL(sys.argv[2] if len(sys.argv) > 2 else "libmyoid.so")
for name in ("myoid_open", "myoid_workspace_new"):
    getattr(myoid, name).restype = ctypes.c_void_p
error = ctypes.create_string_buffer(1000)
model = ctypes.c_void_p(myoid.myoid_open(sys.argv[1].encode(), None, error, ctypes.c_size_t(len(error))))
if not model:
    sys.exit(error.value.decode())
workspace = ctypes.c_void_p(myoid.myoid_workspace_new(model))
channels, joints = myoid.myoid_channel_count(model), myoid.myoid_joint_count(model)
envelope, acting = ((ctypes.c_double * channels)(*[0.2] * channels) for _ in range(2))
angle, speed, torque, low, high = ((ctypes.c_double * joints)(*[0.5] * joints) for _ in range(5))
output = Output(ctypes.sizeof(Output), *(ctypes.cast(place, Doubles) for place in (torque, low, high)))
myoid.myoid_follow(model, workspace, envelope, ctypes.c_double(0.001), acting)
if myoid.myoid_evaluate(model, workspace, acting, angle, speed, ctypes.byref(output)) == 0:
    print(f"{torque[0]:.2f} N m ({low[0]:.2f} to {high[0]:.2f})")
